"""Check the breaker's hysteresis, and that falling back is seen and typed."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain import (
    BadPlan,
    BrainDown,
    FallbackBrain,
    OfflineBrain,
    OutOfBudget,
    ScriptedBrain,
    ThinkRequest,
    ThinkResult,
    mind_of,
)
from planner.brain.circuit_breaker import FIRST_REST_S, HEALS, LONGEST_REST_S, TRIPS, Breaker
from planner.brain.model_error_codes import REASONS, reason
from planner.brain.streamed_draft import Draft, Hear
from planner.language.catalogue import message
from planner.plan import Code, GoTo, Refuse, StepPlan, Vocabulary, Wait, say_same

BY_MODEL = StepPlan(steps=(Wait(seconds=1.0),))
BY_GRAMMAR = StepPlan(steps=(GoTo(place="kitchen"),))
DOWN = BrainDown("gone", why="timeout")


class Clock:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


def ask(brain: FallbackBrain, home: Vocabulary, text: str = "go to the kitchen") -> ThinkResult:
    return asyncio.run(brain.think(ThinkRequest(text=text, vocabulary=home)))


@pytest.mark.parametrize(
    ("reply", "why"), [(DOWN, "timeout"), ("not json", "bad_plan"), (BrainDown("x"), "unavailable")]
)
def test_a_model_that_fails_is_replaced_and_named(
    reply: str | Exception, why: str, home: Vocabulary
) -> None:
    brain = FallbackBrain(ScriptedBrain([reply]), OfflineBrain())
    thought = ask(brain, home)
    assert thought.plan == BY_GRAMMAR
    tag = thought.brain
    assert (tag.name, tag.fallback_from, tag.fallback_reason) == ("offline", "scripted", why)
    assert tag.fallback_message == REASONS[why]
    assert brain.last_failure == why


@pytest.mark.parametrize(("reply", "kind"), [(DOWN, BrainDown), ("not json", BadPlan)])
def test_what_neither_understands_ends_typed(
    reply: str | Exception, kind: type[Exception], home: Vocabulary
) -> None:
    with pytest.raises(kind) as failed:
        ask(FallbackBrain(ScriptedBrain([reply]), OfflineBrain()), home, "colourless green ideas")
    assert isinstance(failed.value, BrainDown | BadPlan)
    assert failed.value.brain is not None
    assert failed.value.brain.fallback_from == "scripted"


def test_a_refusal_by_the_model_is_no_failure(home: Vocabulary) -> None:
    no = Refuse(code=Code.EMPTY_GOAL, reason=message(Code.EMPTY_GOAL, example="x"))
    thought = ask(FallbackBrain(ScriptedBrain([no]), OfflineBrain()), home)
    assert thought.plan == no


@pytest.mark.parametrize("text", ["", " \n", "\x00", "a" * 5000, "???"])
def test_no_model_is_asked_to_read_what_is_no_text(text: str, home: Vocabulary) -> None:
    model = ScriptedBrain([BY_MODEL])
    assert ask(FallbackBrain(model, OfflineBrain()), home, text).plan.kind == "refuse"
    assert model.asked == []


def test_a_failing_model_is_rested_visibly_and_heals(home: Vocabulary) -> None:
    clock = Clock()
    model = ScriptedBrain([DOWN] * TRIPS + [BY_MODEL])
    brain = FallbackBrain(model, OfflineBrain(), clock)
    assert (mind_of(brain).breaker, mind_of(brain).last_error) == ("closed", None)
    for _ in range(TRIPS):
        ask(brain, home)
    assert ask(brain, home).brain.fallback_reason == "resting"
    assert len(model.asked) == TRIPS
    clock.now_s += 5.0
    mind = mind_of(brain)
    assert (mind.name, mind.breaker, mind.rests_s) == ("scripted", "open", FIRST_REST_S - 5.0)
    assert mind.last_error is not None
    assert (mind.last_error.code, mind.last_error.message) == ("timeout", REASONS["timeout"])
    clock.now_s += FIRST_REST_S
    for _ in range(HEALS):
        assert not brain.breaker.is_closed
        assert mind_of(brain).breaker == "on_trial"
        assert ask(brain, home).plan == BY_MODEL
    assert brain.breaker.is_closed
    assert (mind_of(brain).breaker, mind_of(brain).last_error) == ("closed", None)


def test_a_thought_that_waits_for_a_load_is_shown_while_it_waits(home: Vocabulary) -> None:
    shown = []

    class Cold(ScriptedBrain):
        async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
            assert hear is not None
            for loads in (True, False):
                hear(Draft(text="…", loads=loads))
                shown.append(mind_of(brain).loads)
            hear(Draft(text="…", loads=True))
            return await super().think(request, hear)

    brain = FallbackBrain(Cold([BY_MODEL]), OfflineBrain())
    request = ThinkRequest(text="go to the kitchen", vocabulary=home)
    asyncio.run(brain.think(request, lambda _: None))
    assert shown == [True, False]
    assert not mind_of(brain).loads, "a thought that has ended waits for nothing"


def test_without_a_model_there_is_no_breaker_to_show() -> None:
    mind = mind_of(OfflineBrain())
    assert (mind.name, mind.breaker, mind.rests_s, mind.last_error) == ("offline", None, 0.0, None)


def test_a_wrong_key_rests_at_once(home: Vocabulary) -> None:
    model = ScriptedBrain([BrainDown("401", why="bad_key")])
    brain = FallbackBrain(model, OfflineBrain(), Clock())
    assert ask(brain, home).brain.fallback_reason == "bad_key"
    assert ask(brain, home).brain.fallback_reason == "resting"
    assert len(model.asked) == 1


def test_a_spent_budget_is_told_in_its_own_words_and_is_no_failure(home: Vocabulary) -> None:
    said = say_same("400 of 400 calls")
    model = ScriptedBrain([OutOfBudget("calls", said)] * (2 * TRIPS) + [BY_MODEL])
    brain = FallbackBrain(model, OfflineBrain(), Clock())
    for _ in range(2 * TRIPS - 1):
        thought = ask(brain, home)
        assert thought.plan == BY_GRAMMAR
        assert thought.brain.fallback_reason == "out_of_budget"
        assert thought.brain.fallback_message == said
    with pytest.raises(OutOfBudget) as spent:
        ask(brain, home, "colourless green ideas")
    assert (spent.value.said, brain.breaker.is_closed) == (said, True)
    assert spent.value.brain is not None
    assert ask(brain, home).plan == BY_MODEL


def test_bad_plans_rest_nobody(home: Vocabulary) -> None:
    model = ScriptedBrain(["no"])
    brain = FallbackBrain(model, OfflineBrain(), Clock())
    for _ in range(2 * TRIPS):
        assert ask(brain, home).brain.fallback_reason == "bad_plan"
    assert len(model.asked) == 2 * TRIPS


async def test_one_trial_at_a_time_and_a_cancelled_one_says_nothing(home: Vocabulary) -> None:
    clock = Clock()
    model = ScriptedBrain([], hangs=True)
    brain = FallbackBrain(model, OfflineBrain(), clock)
    brain.breaker.note_failure(clock.now_s, hopeless=True)
    clock.now_s += FIRST_REST_S
    request = ThinkRequest(text="go to the kitchen", vocabulary=home)
    trial = asyncio.create_task(brain.think(request))
    await asyncio.sleep(0)
    assert (await brain.think(request)).brain.fallback_reason == "resting"
    trial.cancel()
    await asyncio.gather(trial, return_exceptions=True)
    assert brain.breaker.lets(clock.now_s)


_EVENTS = st.lists(
    st.tuples(st.sampled_from(["ask_ok", "ask_bad", "drop", "late"]), st.floats(0.0, 400.0)),
    max_size=60,
)


@given(_EVENTS)
def test_the_breaker_never_sticks_and_rests_within_bounds(events: list[tuple[str, float]]) -> None:
    breaker, now_s = Breaker(), 0.0
    for what, pause_s in events:
        now_s += pause_s
        assert 0.0 <= breaker.rests_s(now_s) <= LONGEST_REST_S
        if what == "late":
            breaker.note_failure(now_s)
        elif breaker.lets(now_s):
            if what == "ask_bad":
                breaker.note_failure(now_s)
            else:
                {"ask_ok": breaker.note_success, "drop": breaker.note_cancel}[what]()
    now_s += LONGEST_REST_S
    for _ in range(HEALS):
        assert breaker.lets(now_s)
        breaker.note_success()
    assert breaker.is_closed


def test_every_reason_speaks_both_languages() -> None:
    for code, said in REASONS.items():
        assert said.en.endswith(".")
        assert said.zh.endswith("。")
        assert reason(code) == said
    assert reason("never heard of") == REASONS["unavailable"]
