"""An order for all rooms but some is one for the others; what is left out is never driven to."""

from __future__ import annotations

from itertools import chain

from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Patrol, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
ALL = sampled_from(("check every room", "patrol the house", "go through all the rooms"))
EXCEPT = sampled_from(
    (
        " except {}", " but not {}", ", but skip {}", " apart from {}", ", you can skip {}",
        " except for {}", ", but leave {} out", ", but don't go into {}",
    )
)  # fmt: skip
ROOMS = sampled_from(("kitchen", "study", "bedroom"))
OPEN = sampled_from((" if it's dark", " until I call you", " unless I say so", " or something"))
BEHIND = sampled_from(("", ", someone's asleep", ", then go home", " and tell me what you see"))


def _driven_to(text: str, home: Vocabulary) -> set[str] | None:
    made = plan(text, home, WHOLE)
    if not isinstance(made, StepPlan):
        return None
    patrols = (step.places for step in made.steps if isinstance(step, Patrol))
    return {*chain(*patrols), *(getattr(step, "place", None) or "" for step in made.steps)}


@given(ALL, EXCEPT, ROOMS, BEHIND)
def test_all_rooms_but_one_are_the_others(
    home: Vocabulary, order: str, exception: str, room: str, behind: str
) -> None:
    text = order + exception.format(f"the {room}") + behind
    places = _driven_to(text, home)
    assert places is not None, text
    rooms = {entry.id for entry in home.entries if entry.kind == "room"}
    assert places - {""} == rooms - {room}, text


@given(ALL, EXCEPT, ROOMS, OPEN)
def test_an_exception_that_hangs_on_something_drives_nowhere(
    home: Vocabulary, order: str, exception: str, room: str, more: str
) -> None:
    assert _driven_to(order + exception.format(f"the {room}") + more, home) is None


@given(ALL, EXCEPT, ROOMS)
def test_a_room_that_is_left_out_and_named_drives_nowhere(
    home: Vocabulary, order: str, exception: str, room: str
) -> None:
    text = f"go to the {room}, {order}{exception.format(f'the {room}')}"
    assert _driven_to(text, home) is None, text


@given(ALL, EXCEPT)
def test_an_exception_that_is_no_room_stays_a_denial(
    home: Vocabulary, order: str, exception: str
) -> None:
    assert _driven_to(order + exception.format("the sofa"), home) is None


@given(sampled_from(("count the chairs in", "look in", "how many cups are there in")))
def test_a_clause_behind_a_list_of_places_takes_none_from_it(home: Vocabulary, order: str) -> None:
    listed = f"{order} the kitchen and the study"
    alone, told = (plan(text, home, WHOLE) for text in (listed, f"{listed}, we have eight guests"))
    assert isinstance(alone, StepPlan)
    assert isinstance(told, StepPlan)
    assert [s.kind for s in told.steps] == [s.kind for s in alone.steps]
