"""How long an order lasts: a search until it finds, somebody followed until a word, a wait."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.grammar import Context, plan
from planner.plan import (
    EVERY_KIND,
    MAX_FOLLOW_S,
    Ask,
    Find,
    Follow,
    GoTo,
    Refuse,
    Say,
    Step,
    StepPlan,
    WaitFor,
)

if TYPE_CHECKING:
    from planner.plan import Vocabulary

WHOLE = Context(runnable=EVERY_KIND)


def steps(text: str, home: Vocabulary) -> tuple[Step, ...] | None:
    made = plan(text, home, WHOLE)
    return made.steps if isinstance(made, StepPlan) else None


@pytest.mark.parametrize("found", ["until you find {}", "until you've found {}", "till you see {}"])
@pytest.mark.parametrize(
    "search",
    ["keep looking", "keep going round", "go from room to room", "search every room",
     "look everywhere", "please keep on driving around", "wander through the house"],
)  # fmt: skip
@pytest.mark.parametrize("what", ["the dog", "my backpack", "Anna"])
def test_a_search_until_it_finds_is_the_search_through_the_rooms(
    home: Vocabulary, search: str, found: str, what: str
) -> None:
    searched = steps(f"find {what}", home)
    assert searched is not None
    assert steps(f"{search} {found.format(what)}", home) == searched


def test_it_is_held_to_a_place_and_goes_on_with_what_is_told(home: Vocabulary) -> None:
    there = steps("look in the kitchen until you find the cup", home)
    assert there == (GoTo(place="kitchen"), Find(object="cup", place="kitchen"))
    told = steps("look everywhere until you find Dad, then tell him dinner is ready", home)
    assert told is not None
    assert told[-1] == Say(text="Dad, dinner is ready")
    assert steps("keep looking for the cat until you find her", home) == (Find(object="cat"),)


@pytest.mark.parametrize(
    "text",
    [
        "keep looking until you find something",
        "keep looking until you find no more cups",
        "keep looking until you find two cups",
        "look for the ball until you find the cat",
        "keep going until you see the dog",
        "keep looking until it gets dark",
    ],
)
def test_what_ends_no_search_is_refused(home: Vocabulary, text: str) -> None:
    made = plan(text, home, WHOLE)
    assert isinstance(made, Refuse)
    assert made.code.value == "conditional"


@pytest.mark.parametrize("until", ["until", "till"])
@pytest.mark.parametrize(
    "word", ["say stop", "say that's enough", "tell you to stop", "say so", "shout halt"]
)
def test_somebody_is_followed_until_a_word_that_stops(
    home: Vocabulary, until: str, word: str
) -> None:
    """The plan says for how long that is at most."""
    made = steps(f"follow me {until} I {word}", home)
    assert made is not None
    assert made[-1] == Follow(object="person", seconds=MAX_FOLLOW_S)


@pytest.mark.parametrize(
    "text",
    ["follow me until I say banana", "follow Tom until he leaves", "follow me until it rains"],
)
def test_what_does_not_stop_it_is_not_read(home: Vocabulary, text: str) -> None:
    assert steps(text, home) is None


COMING = (
    "wait {at} until {who} comes in",
    "stand {at} till {who} gets here",
    "wait {at} for {who}",
    "stay {at} until {who} arrives",
)


@pytest.mark.parametrize("coming", COMING)
@pytest.mark.parametrize("at", ["in the hallway", "by the front door"])
@pytest.mark.parametrize(
    ("who", "called"), [("Tom", "Tom"), ("my sister", "Sister"), ("the postman", "Postman")]
)
def test_who_is_waited_for_by_name_is_anybody_and_hears_the_name(
    home: Vocabulary, coming: str, at: str, who: str, called: str
) -> None:
    place = "hallway" if "hallway" in at else "front_door"
    begun = (GoTo(place=place), WaitFor(object="person"))
    said = coming.format(at=at, who=who)
    assert steps(f"{said}, then say hello", home) == (*begun, Say(text=f"{called}, hello"))
    asked = steps(f"{said} and then ask them if they want tea", home)
    assert asked == (*begun, Ask(question=f"{called}, do you want tea?"))


@pytest.mark.parametrize("order", ["go to the bedroom", "come back", "turn around", "follow me"])
def test_what_moves_hangs_on_nobody_by_name(home: Vocabulary, order: str) -> None:
    """It may be somebody else who comes."""
    made = plan(f"wait in the hallway until Tom comes, then {order}", home, WHOLE)
    assert isinstance(made, Refuse)
    anybody = steps(f"wait in the hallway until somebody comes, then {order}", home)
    assert order == "follow me" or (anybody is not None and len(anybody) == 3)


@pytest.mark.parametrize(
    "until", ["it gets dark", "dinner is ready", "Tom is asleep", "the cat comes"]
)
def test_what_no_eye_tells_is_waited_for_in_vain(home: Vocabulary, until: str) -> None:
    made = plan(f"wait in the hallway until {until}", home, WHOLE)
    assert isinstance(made, Refuse)
    assert until in made.reason.en


@pytest.mark.parametrize("wait", ["wait for me", "wait there for us", "wait for me to come"])
def test_who_speaks_is_waited_for_where_the_robot_was_sent(home: Vocabulary, wait: str) -> None:
    """Without a place before it, it is asked how long: who speaks is there already."""
    sent = steps(f"go to the kitchen and {wait}", home)
    assert sent == (GoTo(place="kitchen"), WaitFor(object="person"))
    assert steps(wait, home) is None
