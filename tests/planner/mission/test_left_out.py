"""What runs goes on without a place that is left out; else a denial stops as it did before."""

from dataclasses import replace
from typing import Any

import pytest

from planner.language.sentence import parse
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.mission.state import MissionState
from planner.plan import ComeBack, Find, GoalState, GoTo, Language, Look, Patrol, Say
from tests.planner.mission.leaning import (
    FACTS,
    NOW_S,
    changed_by,
    means,
    order_done,
    order_under_way,
)


def run(text: str, *steps: Any) -> MissionState:
    """Return the book while the robot is at this order."""
    book = order_under_way(text, *steps)
    runs = book.missions["g0"].model_copy(update={"state": GoalState.RUNNING})
    return replace(book, missions={"g0": runs}, running="g0")


ROUND = (
    GoTo(place="kitchen"), Look(question="see if anyone is there", place="kitchen"),
    GoTo(place="bedroom"), Look(question="see if anyone is there", place="bedroom"),
    GoTo(place="study"), Look(question="see if anyone is there", place="study"),
)  # fmt: skip
LOOKING = run("go round and see if anyone is there", *ROUND)
ROUND_ZH = (
    *(
        each if isinstance(each, GoTo) else Look(question="看看有没有人", place=each.place)
        for each in ROUND
    ),
    ComeBack(),
)
LOOKING_ZH = run("转一圈看看有没有人", *ROUND_ZH)
PATROL = run("patrol", Patrol(places=("kitchen", "bedroom", "study"), look=True))
SEEKING = run("go find my cup", Find(object="cup"))
ONE = run("go to the bedroom", GoTo(place="bedroom"))
TELLING = order_under_way(
    "greet all", GoTo(place="kitchen"), GoTo(place="bedroom"), Say(text="Hello")
)
WORDS = ("not the bedroom", "skip the bedroom", "don't go into the bedroom, Anna's asleep",
         "you can leave out the bedroom", "never mind the bedroom")  # fmt: skip
WORDS_ZH = (
    "卧室就别进了，孩子睡着呢",
    "卧室就别进了，大刘在换衣服",
    "卧室别进去",
    "别去卧室了",
    "卧室不用看了",
)


def steps_after(book: MissionState, said: str) -> tuple[Any, ...]:
    """Return the steps that a sentence makes of what runs."""
    changed = changed_by(book, said)
    return changed.steps if changed is not None else ()


def looks_for_a_cup(steps: tuple[Any, ...]) -> set[str | None]:
    """Return the rooms in which steps ask for a cup."""
    asked = "see if there is a cup"
    return {each.place for each in steps if isinstance(each, Look) and each.question == asked}


ROOMS = {place.id for place in FACTS.targets.values() if place.room}


def takes(book: MissionState, text: str) -> bool:
    """Tell whether a sentence ends what runs, for an order without a stop."""
    heard = receive(book, parse(text), Submitted("new", text, Language.EN), NOW_S)
    return heard.takes_back == "g0" and not heard.stops


@pytest.mark.parametrize("said", WORDS)
def test_the_rest_of_a_round_goes_on(said: str) -> None:
    assert steps_after(LOOKING, said) == (*ROUND[:2], *ROUND[4:])
    assert means(PATROL, said, "patrol the kitchen and the study")
    assert looks_for_a_cup(steps_after(SEEKING, said)) == ROOMS - {"bedroom"}
    assert all(takes(book, said) for book in (LOOKING, PATROL, SEEKING))


@pytest.mark.parametrize("said", WORDS_ZH)
def test_so_it_does_in_chinese(said: str) -> None:
    assert steps_after(LOOKING_ZH, said) == (*ROUND_ZH[:2], *ROUND_ZH[4:])
    assert takes(LOOKING_ZH, said)


@pytest.mark.parametrize("book", [ONE, TELLING, order_done("round", *ROUND)])
@pytest.mark.parametrize("said", [*WORDS, *WORDS_ZH])
def test_who_goes_to_that_place_alone_or_does_more_is_not_sent_elsewhere(
    book: MissionState, said: str
) -> None:
    assert changed_by(book, said) is None


@pytest.mark.parametrize("said", ["don't go into the bedroom", "卧室别进去"])
def test_a_denial_that_leaves_nothing_out_stops_first(said: str) -> None:
    assert receive(ONE, parse(said), Submitted("new", said, Language.EN), NOW_S).stops


@pytest.mark.parametrize(
    "said",
    ["not the bedroom or the study", "don't go into the bedroom or the study",
     "not the bedroom if she sleeps", "not the garden"],
)  # fmt: skip
def test_two_places_a_condition_and_an_unknown_place_leave_none_out(said: str) -> None:
    assert changed_by(LOOKING, said) is None


def test_a_slow_round_is_not_made_a_fast_one() -> None:
    slow = LOOKING.missions["g0"].model_copy(update={"speed_share": 0.5})
    book = replace(LOOKING, missions={"g0": slow})
    assert changed_by(book, "skip the bedroom") is None


@pytest.mark.parametrize("said", ["don't go into the bedroom", "卧室别进去"])
def test_a_denial_sets_nothing_in_motion_that_stands(said: str) -> None:
    paused = order_under_way("go round and see if anyone is there", *ROUND)
    assert paused.missions["g0"].state is GoalState.PAUSED
    assert changed_by(paused, said) is None


@pytest.mark.parametrize(
    "said", ["do the bedroom first", "start with the bedroom, please", "the bedroom first"]
)
def test_a_place_of_the_round_comes_first(said: str) -> None:
    assert steps_after(LOOKING, said) == (*ROUND[2:4], *ROUND[:2], *ROUND[4:])
    assert means(PATROL, said, ("patrol the bedroom and the kitchen and the study"))
    assert takes(LOOKING, said)
    assert steps_after(TELLING, said) != steps_after(LOOKING, said)


@pytest.mark.parametrize("said", ["先去卧室", "先看卧室吧", "从卧室开始"])
def test_so_it_comes_first_in_chinese(said: str) -> None:
    assert steps_after(LOOKING_ZH, said) == (*ROUND_ZH[2:4], *ROUND_ZH[:2], *ROUND_ZH[4:])
    assert changed_by(ONE, said) is None


@pytest.mark.parametrize(
    "said", ["it's not in the bedroom, I've just looked", "it isn't in the bedroom either"]
)
def test_where_it_is_not_nobody_looks_for_it(said: str) -> None:
    assert looks_for_a_cup(steps_after(SEEKING, said)) == ROOMS - {"bedroom"}
    drives = run("go", GoTo(place="kitchen"), GoTo(place="bedroom"))
    assert changed_by(drives, said) is None


@pytest.mark.parametrize(
    "said", ["not the bedroom", "no, not the bedroom", "I didn't say the bedroom", "不是卧室",
             "I never said the bedroom",
             "我说的不是卧室"],
)  # fmt: skip
def test_who_is_on_the_way_to_a_wrong_place_stops(said: str) -> None:
    assert receive(ONE, parse(said), Submitted("new", said, Language.EN), NOW_S).stops
    other = run("go to the study", GoTo(place="study"))
    heard = receive(other, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert heard.stops is parse(said).may_mean_stop


@pytest.mark.parametrize(
    ("book", "text"),
    [
        (run("go to the bedroom", GoTo(place="bedroom")), "not the bedroom, he's in the study"),
        (run("去卧室看看姥爷", GoTo(place="bedroom")), "不是卧室，他在书房看报呢"),
        (run("去卧室看看姥爷", GoTo(place="bedroom")), "不是卧室，在书房"),
    ],
)
def test_a_wrong_destination_stops_whatever_is_said_behind_it(
    book: MissionState, text: str
) -> None:
    heard = receive(book, parse(text), Submitted("new", text, Language.EN), NOW_S)
    assert heard.stops or heard.takes_back == "g0"
