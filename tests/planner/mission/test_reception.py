"""Check what a sentence is to the missions, and that no sentence clears a hold by accident."""

from __future__ import annotations

import os
import random
from dataclasses import replace
from typing import Any

import pytest

from planner.bridge_client.bridge_status import standing
from planner.language.catalogue import message
from planner.language.grammar import Context, plan
from planner.language.reading import ChangeReading
from planner.language.sentence import language_of, parse
from planner.mission import request_keys
from planner.mission.effects import AskBrain, ClearHold
from planner.mission.errors import IdempotencyConflict, QueueFull
from planner.mission.events import Cancel, Confirm, Planned, Reply, Submitted
from planner.mission.reception import AnswerReception, Reception, is_active, receive, receive_answer
from planner.mission.reducer import advance
from planner.mission.request_keys import Repeats
from planner.mission.state import MAX_OPEN, GoalKey, Mission, MissionState
from planner.plan import ChangedOrder, Code, GoalState, Language, Outcome, Vocabulary
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.lockstep import Together, driving, go
from wire import HeldReason

SEQUENCES = int(os.environ.get("HOLD_SEQUENCES", "150"))
"""10 000 of them take some minutes: HOLD_SEQUENCES=10000."""
NO_PLAN = (
    *("emergency brake", "what is this?", "hello there", "frobnicate the widget", "who are you"),
    *("don't go to the kitchen", "if it rains, go to the kitchen", "never mind the cat", "hm"),
    *(
        "why did you stop",
        "you are funny",
        "is it raining",
        "别过来",
        "你好",
        "今天天气怎么样",
        "不要去厨房",
    ),
    *("停止任務", "幫我停下來", "stop the mission", "brake!", "go to the moon", "where are you"),
    *(
        "go to",
        "kitchen or bedroom?",
        "sing a song about trains",
        "what are you doing",
        "make me tea",
    ),
    *(
        "去哪里了",
        "算了吧你",
        "请问几点了",
        "cancel the goal",
        "slow down",
        "慢点",
        "wait a moment",
    ),
)


def given(text: str, goal_id: str = "g") -> Submitted:
    return Submitted(goal_id, text, language_of(text))


def hear(
    book: MissionState, text: str, goal_id: str, now_s: float
) -> tuple[MissionState, list[object]]:
    """Take one sentence as the planner's door does, and think about it with the offline brain."""
    heard = receive(book, parse(text), given(text, goal_id), now_s)
    book, first = advance(book, heard.given, now_s)
    effects: list[object] = list(first)
    for effect in first:
        if isinstance(effect, AskBrain):
            made = plan(effect.text, WORDS, Context(language=effect.language))
            book, more = advance(book, Planned(effect.id, made), now_s + 0.1)
            effects += more
    return book, effects


WORDS = Vocabulary(entries=())


def test_no_sentence_without_a_plan_clears_a_hold(world: Together) -> None:
    """Two at once neither: all are given under one hold, in any order, some twice."""
    world.bridge.hold(HeldReason.STOP)
    world.run(0.2)
    start, now_s = world.book, world.now_s
    assert start.status is not None
    assert start.status.held is not None
    rng = random.Random(18)
    for _ in range(SEQUENCES):
        book = start
        for number in range(rng.randrange(1, 9)):
            text = rng.choice(NO_PLAN)
            book, effects = hear(book, text, f"g{number}", now_s + number)
            assert not any(isinstance(effect, ClearHold) for effect in effects), text
            assert book.pardoned is None, text


def test_a_plan_that_is_accepted_clears_the_hold_it_was_given_under(world: Together) -> None:
    world.bridge.hold(HeldReason.STOP)
    world.run(0.2)
    goal = world.give(go("kitchen"))
    assert world.cleared == [goal]


def test_a_hold_that_came_after_the_words_stays(world: Together) -> None:
    goal = world.give(None)
    world.bridge.hold(HeldReason.STOP)
    world.run(0.2)
    world.event(Planned(goal, go("kitchen")))
    world.run(5.0)
    assert world.cleared == []
    assert world.book.running is None


@pytest.mark.parametrize(
    "text",
    ["uh robot there is a child please stop", "emergency brake", "別過來", "停止任務", "幫我停下來",
     "stop the mission", "no no no", "wait wait", "don't come any closer", "careful"],
)  # fmt: skip
def test_while_it_drives_a_stop_word_stops_first(world: Together, text: str) -> None:
    driving(world)
    heard = receive(world.book, parse(text), given(text), world.now_s)
    assert heard.stops


def test_the_same_words_do_nothing_to_a_robot_that_has_nothing_to_do(world: Together) -> None:
    text = "uh robot there is a child please stop"
    assert not is_active(world.book, world.now_s)
    assert not receive(world.book, parse(text), given(text), world.now_s).stops
    assert is_active(world.book, world.now_s + 2.0), "nobody knows any more whether it moves"


def test_what_waits_or_is_thought_about_counts_as_about_to_move(world: Together) -> None:
    world.give(None)
    assert is_active(world.book, world.now_s)


def test_a_doubtful_stop_that_is_an_order_after_all_waits_for_a_yes(world: Together) -> None:
    driving(world)
    first = world.book.running
    text = "hold on, go to the hall"
    heard = receive(world.book, parse(text), given(text, "second"), world.now_s)
    assert heard.stops
    assert heard.given.doubtful_stop
    world.plans["second"] = go("hall")
    world.event(heard.given)
    mission = world.goal("second")
    assert (mission.state, mission.reason) == (GoalState.AWAITING_CONFIRMATION, "doubtful_stop")
    assert outcome_of(mission).message.en.startswith("I am stopping.")
    assert world.goal(str(first)).state is GoalState.PAUSED
    world.run(2.0)
    assert world.book.status is not None
    assert standing(world.book.status)
    world.event(Confirm("second"))
    world.act()
    world.run_until("second", GoalState.SUCCEEDED)


def test_a_doubtful_stop_of_which_no_plan_is_made_is_a_stop(world: Together) -> None:
    driving(world)
    text = "there is a child, for heaven's sake stand still"
    heard = receive(world.book, parse(text), given(text, "second"), world.now_s)
    world.plans["second"] = None
    world.event(heard.given)
    refused = Outcome(code=Code.NOT_UNDERSTOOD, message=message(Code.NOT_UNDERSTOOD, part="x"))
    world.event(Planned("second", None, refused))
    mission = world.goal("second")
    assert mission.state is GoalState.SUCCEEDED
    assert outcome_of(mission).code is Code.STOPPED


def test_with_all_places_taken_a_doubtful_stop_still_stops(world: Together) -> None:
    driving(world)
    for _ in range(MAX_OPEN):
        world.give(None)
    heard = receive(world.book, parse("careful, brake"), given("x"), world.now_s)
    assert heard.stops
    assert heard.given.stop
    heard = receive(world.book, parse("go to the hall"), given("x"), world.now_s)
    assert isinstance(heard.refused, QueueFull)


@pytest.mark.parametrize("held", [True, False])
def test_nothing_claims_to_stand_while_the_robot_drives(world: Together, held: bool) -> None:
    """What is told of a sentence that makes no plan names the goal that goes on, if one does."""
    if not held:
        driving(world)
    goal = world.give(None)
    refused = plan("frobnicate the widget", WORDS, Context())
    world.event(Planned(goal, refused))
    outcome = outcome_of(world.goal(goal))
    assert ("keep driving" in outcome.message.en) is not held
    assert ("行驶" in outcome.message.zh) is not held
    assert "stay where I am" not in outcome.message.en


def _book_of(state: GoalState) -> MissionState:
    mission = Mission(id="g1", order=1, text="go to the kitchen", language=Language.EN, state=state,
                      created_unix_s=0.0, updated_unix_s=0.0)  # fmt: skip
    return MissionState(FACTS, missions={"g1": mission})


@pytest.mark.parametrize(
    ("text", "state", "expected"),
    [
        ("yes", GoalState.AWAITING_CONFIRMATION, AnswerReception(command=Reply("g1", "yes"))),
        ("the red one", GoalState.NEEDS_CLARIFICATION,
         AnswerReception(command=Reply("g1", "the red one"))),
        ("stop", GoalState.AWAITING_CONFIRMATION, AnswerReception(stops=True)),
        ("stop", GoalState.SUCCEEDED, AnswerReception(stops=True)),
        ("where are you", GoalState.AWAITING_CONFIRMATION,
         AnswerReception(sentence="where are you")),
        ("go on", GoalState.AWAITING_CONFIRMATION, AnswerReception(command=Reply("g1", "go on"))),
        ("go on", GoalState.NEEDS_CLARIFICATION, AnswerReception(sentence="go on")),
        ("forget it", GoalState.AWAITING_CONFIRMATION, AnswerReception(command=Cancel("g1"))),
        ("forget that, go to the bedroom", GoalState.AWAITING_CONFIRMATION,
         AnswerReception(command=Cancel("g1"), sentence="forget that, go to the bedroom",
                         lean=ChangeReading(ChangedOrder(words="go to the bedroom"),
                                            corrects=True))),
        ("forget that, stop", GoalState.AWAITING_CONFIRMATION,
         AnswerReception(stops=True, command=Cancel("g1"))),
    ],
)  # fmt: skip
def test_what_words_do_that_come_as_an_answer(
    text: str, state: GoalState, expected: AnswerReception
) -> None:
    assert receive_answer(_book_of(state), parse(text), "g1", 1.0) == expected


@pytest.mark.parametrize("text", ["no", "No, thanks.", "不要", "不用，谢谢"])
def test_a_no_answers_the_goal_that_it_names_and_no_other(text: str) -> None:
    book = _book_of(GoalState.AWAITING_CONFIRMATION)
    other = book.missions["g1"].model_copy(update={"id": "g2", "order": 2})
    book.missions["g2"] = other
    heard = receive_answer(book, parse(text), "g1", 1.0)
    assert heard in (
        AnswerReception(command=Reply("g1", text)), AnswerReception(command=Cancel("g1")),
    )  # fmt: skip


def test_a_goal_that_asks_nothing_takes_no_answer() -> None:
    heard = receive_answer(_book_of(GoalState.SUCCEEDED), parse("yes"), "g1", 1.0)
    assert heard.refused is not None
    assert heard.refused.code == "bad_state"
    assert heard.command is None


GO = "go to the kitchen"
FULL = MissionState(
    FACTS,
    missions={
        f"g{i}": Mission(id=f"g{i}", order=i, text="x", language=Language.EN,
                         state=GoalState.QUEUED, created_unix_s=0.0, updated_unix_s=0.0)
        for i in range(MAX_OPEN)
    },
)  # fmt: skip


def received(book: MissionState, order: Submitted, key: str | None, repeats: Repeats) -> Reception:
    return receive(book, parse(order.text), order, 0.0, key=key, repeats=repeats)


def before(order: Submitted, key: str = "k") -> Repeats:
    """Return the memory of one request that was taken in."""
    repeats = Repeats()
    repeats.remember(received(MissionState(FACTS), order, key, repeats).request)
    return repeats


@pytest.mark.parametrize("book", [MissionState(FACTS), FULL], ids=["room", "full"])
def test_the_same_key_and_request_are_the_same_goal_however_full_it_is(book: MissionState) -> None:
    heard = received(book, given(GO, "g-2"), "k", before(given(GO, "g-1")))
    assert (heard.repeats, heard.refused, heard.request) == ("g-1", None, None)


@pytest.mark.parametrize(
    "changes", [{"text": f"{GO} "}, {"language": Language.ZH}, {"confirm": True}, {"replace": True}]
)
def test_the_same_key_with_another_request_is_refused(changes: dict[str, Any]) -> None:
    other = replace(given(GO, "g-2"), **changes)
    heard = received(FULL, other, "k", before(given(GO, "g-1")))
    assert isinstance(heard.refused, IdempotencyConflict)


@pytest.mark.parametrize("key", [None, "other"])
def test_without_that_key_a_request_is_another_and_needs_room(key: str | None) -> None:
    repeats = before(given(GO, "g-1"))
    heard = received(MissionState(FACTS), given(GO, "g-2"), key, repeats)
    assert (heard.repeats, heard.refused) == (None, None)
    assert (heard.request is None) == (key is None)
    assert isinstance(received(FULL, given(GO, "g-2"), key, repeats).refused, QueueFull)


@pytest.mark.parametrize("text", ["stop", "停", "emergency brake"])
def test_a_stop_is_no_repetition_is_never_refused_and_needs_no_room(text: str) -> None:
    running = replace(FULL, running="g0")
    heard = received(running, given(text, "g-2"), "k", before(given(GO, "g-1")))
    assert heard.stops
    assert (heard.refused, heard.repeats, heard.request) == (None, None, None)


def test_what_is_said_to_the_planner_itself_needs_no_room() -> None:
    assert received(FULL, given("where are you", "g-2"), None, Repeats()).refused is None


def test_a_request_that_was_not_taken_may_come_anew_and_the_oldest_are_forgotten_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(request_keys, "MAX_KEYS", 2)
    known = Repeats([GoalKey("a", "body", "g0")])
    for key in ("b", "c"):
        known.remember(GoalKey(key, "body", key))
    known.remember(None)
    assert [known.find(key) is not None for key in ("a", "b", "c", None)] == [
        False,
        True,
        True,
        False,
    ]
    known.forget(GoalKey("c", "body", "c"))
    known.forget(None)
    assert known.find("c") is None
