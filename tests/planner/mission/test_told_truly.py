"""What is told is what was: scripted goals with a model that answers, and random ones by law."""

from __future__ import annotations

import os
from dataclasses import dataclass
from itertools import product
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.mission.state import Mission
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    Code,
    Decide,
    Find,
    GoalState,
    GoTo,
    Look,
    Patrol,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    Wait,
    say_same,
)
from planner.skills.skill_state import LookState
from tests.laws import at_least
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.lockstep import rethinking
from tests.planner.mission.telling import NOTHING, Telling, thing, untruths

NAMES = {place: target.name for place, target in FACTS.targets.items()}
ROOMS = {"kitchen": (4.0, 0.0), "hall": (0.0, 0.0)}
ASKS = {
    "person": ("is there anybody?", "有人吗？"),
    "cup": ("is there a cup?", "有没有杯子？"),
}
DINNER = Say(text="dinner is ready")
HOW = {"there": True, "gone": False}


@dataclass(frozen=True)
class Goal:
    """Hold one scripted goal: its thoughts, and what is true of it."""

    name: str
    thoughts: tuple[Any, ...]
    truth: tuple[Any, ...]
    looked_for: bool | None = None
    """Whether what is asked for is there; None: nothing is asked for."""
    shut: bool = False
    replies: tuple[str, ...] = ()


def plan(*steps: Step) -> StepPlan:
    return StepPlan(steps=steps)


def looks() -> list[Goal]:
    """Return questions about a room (lines 3, 25, 46), half with a failed drive or a question."""
    goals: list[Goal] = []
    for (room, at), (label, words), language, there, more in product(
        ROOMS.items(), ASKS.items(), (0, 1), HOW, ("alone", "driven", "asked", "shut")
    ):
        beside = (at[0] - 0.7, at[1] + 0.3 * language)
        truth = (thing(label, *beside, room),) if HOW[there] else ()
        look = Look(question=words[language], place=room)
        shut = more == "shut"
        steps: tuple[Step, ...] = (Ask(question="may I?"), look) if more == "asked" else (look,)
        if more == "driven":
            steps = (GoTo(place="dock"), look)
        if shut:  # on the way, so that the look itself is done
            steps = (GoTo(place="dock"), look)
        second = plan(look) if shut else plan(DINNER)
        name = f"{label} {room} {language} {there} {more}"
        goals.append(Goal(name, (plan(*steps), second), truth, HOW[there], shut, ("by all means",)))
    return goals


def tours() -> list[Goal]:
    """Return patrols that tell what they saw (24), and answers by what a look showed (47)."""
    goals: list[Goal] = []
    for (label, words), language, there, shut, tells in product(
        ASKS.items(), (0, 1), HOW, (True, False), (True, False)
    ):
        truth = (thing(label, 3.4, 0.2, "kitchen"),) if HOW[there] else ()
        look = Look(question=words[language], place="kitchen")
        tour = plan(Patrol(places=("hall", "kitchen")), Decide(question="what did you see?"))
        if shut:
            tour = plan(GoTo(place="dock"), *tour.steps)
        end = AnswerPlan(text=NOTHING) if tells else plan(Say(text="I have looked"))
        again = plan(look, Decide(question="and now?"))
        thoughts = (tour, again, end) if not shut else (tour, again, end, end)
        goals.append(Goal(f"tour {label} {language} {there} {shut} {tells}", thoughts, truth,
                          HOW[there], shut))  # fmt: skip
    return goals


def errands() -> list[Goal]:
    """Return words that are brought somewhere, whether one gets there or not (29, 34, 45)."""
    goals: list[Goal] = []
    for place, text, shut, asks in product(
        ("kitchen", "hall", "dock"),
        ("dinner is ready", "饭好了", "come, please!"),
        (True, False),
        (True, False),
    ):
        question: tuple[Step, ...] = (Ask(question="tea or coffee?"),) if asks else ()
        there = (GoTo(place=place), *question, Say(text=text), GoTo(place="kitchen"))
        goals.append(
            Goal(f"errand {place} {text} {shut} {asks}",
                 (plan(*there), plan(*question, Say(text=text))), (), None, shut, ("green tea",))
        )  # fmt: skip
    return goals


def conditions() -> list[Goal]:
    """Return plans that hang on what is ahead (47): what a model reads is told, not obeyed."""
    goals: list[Goal] = []
    for words, (label, at), shut, goes in product(
        ("is the door open?", "前面的门开着吗？", "is there a cup?"),
        (("cup", (0.8, 0.1)), ("person", (0.9, -0.1))),
        (True, False),
        (True, False),
    ):
        look = plan(Look(question=words), Decide(question=words))
        then = plan(GoTo(place="kitchen")) if goes else plan(Say(text="the door is shut"))
        truth = (thing(label, *at, "hall"),)
        first = plan(GoTo(place="dock"), *look.steps) if shut else look
        thoughts = (first, look, then) if shut else (first, then)
        looked_for = label == "cup" if "cup" in words else None
        goals.append(Goal(f"if {words} {label} {shut} {goes}", thoughts, truth, looked_for, shut))
    return goals


GOALS = {"looks": looks(), "tours": tours(), "errands": errands(), "conditions": conditions()}
MANNERS = ("honest", "denies", "describes", "down")
EACH = 1 if os.environ.get("ENUMERATE") == "all" else len(MANNERS)
"""A model of each manner is asked about one of so many goals; `make enumerate` asks all of all."""


def told(mission: Mission) -> Bilingual:
    return outcome_of(mission).message


def played(goal: Goal, manner: str, **more: Any) -> tuple[Telling, Mission]:
    """Play one goal: a drive that is to fail goes to the dock, or else wherever it goes first."""
    world = Telling(truth=goal.truth, replies=list(goal.replies), **more)
    world.model.manner = manner
    if goal.shut:
        first = next(s for s in goal.thoughts[0].steps if isinstance(s, GoTo))
        world.shut((FACTS.targets[first.place].pose,))
    return world, world.play(*goal.thoughts)


@pytest.mark.parametrize(
    ("steps", "code", "en"),
    [
        ((GoTo(place="kitchen"),), Code.ARRIVED, "Arrived: kitchen."),
        ((GoTo(place="kitchen"), ReturnHome()), Code.ARRIVED, "Arrived: kitchen, then dock."),
        ((GoTo(place="kitchen"), DINNER), Code.ARRIVED,
         "Arrived: kitchen. I said “dinner is ready”."),
        ((DINNER,), Code.DONE, "I said “dinner is ready”."),
        ((Wait(seconds=0.2), GoTo(place="hall")), Code.ARRIVED,
         "I waited 0.2 seconds. Arrived: hall."),
        ((Patrol(places=("kitchen", "hall")),), Code.ARRIVED,
         "Visited one after the other: kitchen, hall."),
    ],
)  # fmt: skip
def test_each_step_is_accounted_for(steps: tuple[Step, ...], code: Code, en: str) -> None:
    world = rethinking(plan(*steps))
    mission = world.run_until(world.give(None), GoalState.SUCCEEDED)
    assert (outcome_of(mission).code, told(mission).en) == (code, en)


@pytest.mark.parametrize("manner", MANNERS)
@pytest.mark.parametrize("kind", GOALS)
def test_no_scripted_goal_tells_anything_untrue(kind: str, manner: str) -> None:
    """Wrong: a yes told where nothing is, none told where something is, or a law broken."""
    wrong: list[str] = []
    for goal in GOALS[kind][MANNERS.index(manner) % EACH :: EACH]:
        world, mission = played(goal, manner)
        said = told(mission)
        wrong += [f"{goal.name}: {each}" for each in untruths(mission, NAMES)]
        looked = [s for s in mission.steps if s.kind == "look"]
        if goal.looked_for is None:
            continue
        assert looked, goal.name
        yes = "Yes, I see" in said.en or "I think so" in said.en
        if yes is not goal.looked_for:
            wrong.append(f"{goal.name}: {said.en}")
        around = looked[-1].place is not None
        if manner != "down" and bool(world.model.asked[-1].views) is not around:
            wrong.append(f"{goal.name}: one picture alone was shown")
    assert wrong == []


def kitchen(label: str = "person") -> Goal:
    look = Look(question=ASKS[label][0], place="kitchen")
    return Goal(label, (plan(look),), (thing(label, 3.2, 0.2, "kitchen"),), True)


def test_what_the_detector_saw_is_told_and_a_model_adds_to_it() -> None:
    world, mission = played(kitchen(), "honest")
    assert told(mission).en == ("Yes, I see a person in the kitchen: Somebody or something.")
    assert told(mission).zh == ("有，在kitchen看到一个人。")
    (asked,) = world.model.asked
    names = [view.direction.en for view in asked.views]
    assert names[0] == "ahead"
    assert len(set(names)) == len(names) == 6, "one of each direction, none twice"
    assert len({view.picture.seq for view in asked.views}) == 6


def test_a_model_s_no_takes_no_yes_of_the_detector_back() -> None:
    _, mission = played(kitchen(), "denies")
    assert told(mission).en == (
        "Yes, I see a person in the kitchen. But at a second look I am less sure: "
        "Only a wall and an armchair."
    )


def test_a_model_s_yes_is_told_where_the_detector_missed_it() -> None:
    missed = kitchen().truth[0].id
    _, mission = played(kitchen(), "honest", unseen=(missed,))
    assert told(mission).en == ("I think so, but I am not sure: Somebody or something.")


def test_where_the_pictures_are_gone_the_newest_goes_and_is_named() -> None:
    world, mission = played(kitchen(), "honest", forgets=True)
    (asked,) = world.model.asked
    assert asked.views == ()
    assert asked.direction is not None
    assert asked.direction.en != "ahead", "the robot faces the last direction then"
    assert told(mission).en == (
        "Yes, I see a person in the kitchen. But at a second look I am less sure: "
        f"Only a wall and an armchair. I could look {asked.direction.en} only."
    )


def test_a_look_ahead_sends_one_picture_and_says_so() -> None:
    look = plan(Look(question="is there a cup?"))
    world, mission = played(Goal("ahead", (look,), (thing("cup", 0.8, 0.0, "hall"),)), "honest")
    (asked,) = world.model.asked
    assert (asked.views, asked.direction) == ((), Bilingual(en="ahead", zh="前方"))
    assert told(mission).en.startswith("Yes, I see a cup: ")


def test_a_place_that_was_not_reached_was_not_looked_at() -> None:
    """Before, it was told that nothing of the kind is there."""
    world = Telling(truth=kitchen().truth)
    world.way = lambda _: "no_route"
    mission = world.play(*kitchen().thoughts)
    assert (mission.state, mission.reason) == (GoalState.FAILED, "no_route")
    assert told(mission).en == "I found no way to the kitchen."
    assert world.model.asked == []


def test_a_brain_s_denial_stands_beside_what_the_detector_saw() -> None:
    thoughts = (
        plan(*kitchen().thoughts[0].steps, Decide(question="and?")),
        AnswerPlan(text=say_same("Nobody is there.")),
    )
    _, mission = played(Goal("denied", thoughts, kitchen().truth), "honest")
    assert outcome_of(mission).code is Code.ANSWERED
    assert told(mission).en.startswith("Yes, I see a person in the kitchen: ")
    assert told(mission).en.endswith("Nobody is there.")


def faced(mission: Mission) -> tuple[float, ...]:
    return mission.skill_state.faced if isinstance(mission.skill_state, LookState) else ()


@pytest.mark.parametrize("gone_after", [1, 3])
def test_after_a_crash_the_directions_before_it_are_missing_and_it_is_said(gone_after: int) -> None:
    world = Telling(truth=kitchen().truth)
    world.thoughts = list(kitchen().thoughts)
    goal = world.give(None)
    while len(faced(world.goal(goal))) < gone_after:
        world.see(0.2)
    world.crash()
    while world.goal(goal).outcome is None:
        world.see(0.2)
    (asked,) = world.model.asked
    assert asked.views == ()
    assert "less sure" in told(world.goal(goal)).en


places = st.sampled_from([*sorted(ROOMS), "dock"])
words = st.text("abcdef 你好!", min_size=1, max_size=12).filter(lambda text: text.strip() != "")
steps = st.one_of(
    places.map(lambda place: GoTo(place=place)),
    places.map(lambda place: GoTo(place=place)),
    st.builds(lambda w, p: Look(question=w, place=p),
              st.sampled_from([each for pair in ASKS.values() for each in pair]),
              st.sampled_from([None, "kitchen", "hall"])),
    words.map(lambda text: Say(text=text)),
    words.map(lambda text: Ask(question=text)),
    st.builds(lambda o, p: Find(object=o, place=p), st.sampled_from(["cup", "person"]),
              st.sampled_from(["kitchen", "hall"])),
)  # fmt: skip
plans = st.lists(steps, min_size=1, max_size=4).map(lambda all_: plan(*all_))
ends = plans | st.just(AnswerPlan(text=NOTHING)) | st.none()


@at_least(40)
@given(
    first=plans,
    others=st.lists(ends, max_size=3),
    decides=st.booleans(),
    there=st.lists(st.tuples(st.sampled_from(sorted(ASKS)), st.sampled_from(sorted(ROOMS))),
                   max_size=2, unique=True),
    missed=st.booleans(),
    shut=st.lists(st.booleans(), min_size=1, max_size=8),
    replies=st.lists(words, max_size=3),
    manner=st.sampled_from(["honest", "denies", "affirms", "describes", "down"]),
    forgets=st.booleans(),
)  # fmt: skip
def test_no_goal_tells_what_was_not(
    first: StepPlan,
    others: list[Any],
    decides: bool,
    there: list[tuple[str, str]],
    missed: bool,
    shut: list[bool],
    replies: list[str],
    manner: str,
    forgets: bool,
) -> None:
    truth = tuple(thing(label, ROOMS[room][0] - 0.6, 0.4, room) for label, room in there)
    unseen = tuple(one.id for one in truth) if missed else ()
    world = Telling(truth=truth, unseen=unseen, replies=list(replies), forgets=forgets)
    world.model.manner = manner
    world.way = lambda ask: "no_route" if shut[ask.ticket % len(shut)] else None
    start = plan(*first.steps, Decide(question="and?")) if decides else first
    mission = world.play(start, *others, limit_s=2000.0)
    assert untruths(mission, NAMES) == []
    for language in ("en", "zh"):
        text = getattr(told(mission), language)
        yes = ("Yes, I see", "有，")[language == "zh"]
        saw = any(s.said is not None and getattr(s.said, language).startswith(yes)
                  for s in mission.steps if s.kind == "look")  # fmt: skip
        assert not saw or yes in text
