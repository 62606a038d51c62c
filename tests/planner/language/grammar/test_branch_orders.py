"""The orders of a branch in full: where else to look, "in there", whom to tell; and "unless"."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Ask, Find, GoTo, If, Look, Refuse, Say, StepPlan

if TYPE_CHECKING:
    from planner.plan import Vocabulary

WHOLE = Context(runnable=EVERY_KIND)


def branch(text: str, home: Vocabulary) -> If:
    made = plan(text, home, WHOLE)
    assert isinstance(made, StepPlan), made
    assert len(made.steps) == 1
    assert isinstance(made.steps[0], If)
    return made.steps[0]


@pytest.mark.parametrize(
    "search",
    ["look for my book in the study", "find my book in the study", "search the study for my book",
     "is my book in the study?", "check if my book is in the study"],
)  # fmt: skip
@pytest.mark.parametrize(
    "lacks",
    [" and if it's not there ", ". If not, ", ", if you don't find it there ", ", if it isn't ",
     "; if you can't see it, "],
)  # fmt: skip
@pytest.mark.parametrize(
    "other",
    ["try the bedroom", "look in the bedroom", "check the bedroom", "have a look in the bedroom",
     "just try the bedroom instead"],
)  # fmt: skip
def test_what_is_not_there_is_searched_in_the_other_place(
    home: Vocabulary, search: str, lacks: str, other: str
) -> None:
    made = branch(f"{search.rstrip('?')}{lacks}{other}", home)
    assert isinstance(made.when, Look)
    assert made.when.place == "study"
    assert made.then == ()
    assert made.otherwise == (GoTo(place="bedroom"), Find(object="book", place="bedroom"))


def test_a_look_tells_of_somebody_as_well_as_a_search(home: Vocabulary) -> None:
    asked = "look for Anna in the study, if she isn't there"
    for other in ("try the bedroom", "the bedroom"):
        searched = branch(f"{asked}, {other}", home).otherwise
        assert searched == (GoTo(place="bedroom"), Find(object="Anna", place="bedroom"))
    looked = branch(f"{asked} look in the bedroom", home).otherwise
    assert looked == (GoTo(place="bedroom"), Look(question="look in the bedroom", place="bedroom"))


def test_where_it_is_the_other_place_is_only_looked_at(home: Vocabulary) -> None:
    made = branch("if the book is in the study check the bedroom", home)
    assert made.then[0] == GoTo(place="bedroom")
    assert isinstance(made.then[1], Look)
    assert made.otherwise == ()


def test_never_mind_takes_back_nothing_behind_a_condition(home: Vocabulary) -> None:
    plain = branch("look for Tom in the study, if he isn't there come back", home)
    assert (
        branch("look for Tom in the study, if he isn't there, never mind, come back", home) == plain
    )
    assert branch("look for Tom in the study, if not, don't worry, just come back", home) == plain
    made = plan("go to the kitchen, never mind, come back", home, WHOLE)
    assert not (isinstance(made, StepPlan) and GoTo(place="kitchen") in made.steps)


CONDITIONS = (
    ("somebody is in the {}", "nobody is in the {}"),
    ("there's someone in the {}", "there's no one in the {}"),
    ("the cat is in the {}", "the cat is not in the {}"),
    ("the cat's lying in the {}", "the cat isn't in the {}"),
)


@pytest.mark.parametrize(("holds", "lacks"), CONDITIONS)
@pytest.mark.parametrize("order", ["go to the study", "say hello", "come back", "turn around"])
def test_unless_is_if_not(home: Vocabulary, holds: str, lacks: str, order: str) -> None:
    """Before the order and behind it, of the other place or of the same."""
    for place in ("study", "kitchen"):
        unless, flat = holds.format(place), lacks.format(place)
        denied = branch(f"{order} unless {unless}", home)
        assert denied.then == ()
        for same in (f"unless {unless}, {order}", f"{order} if {flat}"):
            other = branch(same, home)
            assert (other.then, other.otherwise) == ((), denied.otherwise)
            assert isinstance(other.when, Look)
            assert isinstance(denied.when, Look)
            assert other.when.place == denied.when.place


def test_there_is_where_the_order_drives_to(home: Vocabulary) -> None:
    said = branch("go to the study unless there's someone in there", home)
    assert isinstance(said.when, Look)
    assert said.when.place == "study"
    assert said.otherwise == (GoTo(place="study"),)
    back = branch("go to the study unless somebody's in there, in which case come back", home)
    assert back.otherwise == said.otherwise
    assert len(back.then) == 1


@pytest.mark.parametrize(
    "state", ["somebody is sleeping", "Mum is asleep", "my son's still up", "I tell you otherwise"]
)
def test_a_state_that_no_eye_tells_is_refused(home: Vocabulary, state: str) -> None:
    for text in (f"unless {state}, go to the study", f"if {state}, go to the study"):
        made = plan(text, home, WHOLE)
        assert isinstance(made, Refuse)


def test_how_somebody_is_there_says_no_more_than_that_they_are(home: Vocabulary) -> None:
    asked = "ask her whether she wants tea, if not come back"
    plain = branch(f"if Grandma is on the sofa {asked}", home)
    assert branch(f"if Grandma's sitting on the sofa {asked}", home) == plain
    assert plain.then == (Ask(question="Grandma, do you want tea?"),)


@pytest.mark.parametrize("left", ["", " left", " lying around"])
@pytest.mark.parametrize(
    "tell", ["go and tell Jonas", "tell Jonas", "let Jonas know", "please inform Jonas about it"]
)
def test_who_is_to_know_is_told_the_condition(home: Vocabulary, left: str, tell: str) -> None:
    made = branch(f"if there are any cups{left} on the desk {tell}", home)
    assert made.then == (
        Find(object="person"),
        Say(text=f"Jonas, there are cups{left} on the desk"),
    )


def test_the_speaker_is_told_by_the_look_itself(home: Vocabulary) -> None:
    made = plan("if you see any bottles in the kitchen let me know", home, WHOLE)
    assert isinstance(made, StepPlan)
    assert [step.kind for step in made.steps] == ["look"]


@pytest.mark.parametrize(
    "things",
    ["there are {} cups on the desk", "you see {} cups on the desk", "{} cups are on the desk"],
)
@pytest.mark.parametrize(
    "count", ["two", "both", "all the", "more", "only two", "fewer than six", "at least 3", "many"]
)
def test_how_many_there_must_be_no_look_answers(home: Vocabulary, things: str, count: str) -> None:
    """Its yes says that there is one."""
    for text in (
        f"if {things.format(count)}, come back",
        f"come back unless {things.format(count)}",
    ):
        made = plan(text, home, WHOLE)
        assert isinstance(made, Refuse), text


@pytest.mark.parametrize("words", ["come to dinner", "wait in the hall"])
def test_what_they_are_asked_to_do_is_said_as_a_plea(home: Vocabulary, words: str) -> None:
    asked = branch(f"if there's somebody in the study, ask them to {words}", home)
    assert asked == branch(f"if there's somebody in the study, tell them to {words}", home)
    assert asked.then == (Say(text=f"please {words}"),)


def test_somebody_behind_nobody_is_the_other_branch(home: Vocabulary) -> None:
    both = branch("if nobody is in the study, go home. If somebody is, say hello", home)
    plain = branch("if somebody is in the study, say hello, otherwise go home", home)
    assert (both.then, both.otherwise) == (plain.then, plain.otherwise)


@pytest.mark.parametrize("more", ["", " again"])
def test_to_wait_until_one_is_back_is_to_wait_for_somebody(home: Vocabulary, more: str) -> None:
    waits = plan("wait for somebody", home, WHOLE)
    assert isinstance(waits, StepPlan)
    assert plan(f"wait here until I'm back{more}", home, WHOLE) == waits
    assert plan("stay here till I come back", home, WHOLE) == waits
