"""Laws of a change: the named slot alone differs, and what has no such slot changes nothing."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from planner.plan import (
    Bilingual,
    Change,
    ComeBack,
    Count,
    Edit,
    Entry,
    Find,
    GoTo,
    LastOrder,
    Look,
    MoveStraight,
    Patrol,
    Repeat,
    Say,
    Step,
    StepPlan,
    Turn,
    Vocabulary,
    Wait,
    apply,
    plan_record,
    steps_of,
)

ROOMS = ("kitchen", "study", "bedroom", "hallway")
NAMES = Vocabulary(
    entries=tuple(
        Entry(id=room, kind="room", name=Bilingual(en=room, zh=f"{room}间")) for room in ROOMS
    )
)
places = st.sampled_from(ROOMS)
metres = st.floats(0.1, 5.0)
flat: st.SearchStrategy[Any] = st.one_of(
    st.builds(GoTo, place=places),
    st.builds(Find, object=st.just("cup"), place=st.none() | places),
    st.builds(Count, object=st.just("cup"), place=st.none() | places),
    st.builds(Look, question=st.just("is it there?"), place=st.none() | places),
    st.builds(Say, text=st.just("tea is ready")),
    st.builds(Turn, angle_rad=st.floats(-3.0, 3.0)),
    st.builds(MoveStraight, distance_m=metres),
    st.builds(Patrol, places=st.lists(places, min_size=1, max_size=4, unique=True).map(tuple)),
    st.builds(Wait, seconds=metres),
    st.just(ComeBack()),
)
orders = st.lists(flat, min_size=0, max_size=5).map(tuple)
changes = st.builds(
    Change,
    act=st.sampled_from(Edit),
    place=st.none() | places,
    denied=st.none() | places,
    thing=st.none() | st.just("bottle"),
    words=st.none() | st.just("lunch is ready"),
    kind=st.sampled_from(["", "count", "find", "look", "say", "closer", "skip"]),
    times=st.integers(1, 3),
    way=st.sampled_from([1.0, -1.0]),
    amount=st.none() | metres,
    side=st.sampled_from([None, 1.0, -1.0]),
    asks=st.booleans(),
    tells=st.booleans(),
    tries=st.booleans(),
)


def last_of(steps: tuple[Step, ...], *, ended: bool = False) -> LastOrder:
    """Return the newest order of these steps, none of them done yet."""
    return LastOrder(steps, ahead=() if ended else steps, ended=ended, names=NAMES)


def without_places(step: Step) -> dict[str, Any]:
    return step.model_dump(exclude={"place", "places"})


@given(orders, changes, st.booleans())
@example((Find(object="cup"),), Change(act=Edit.ALSO, thing="bottle", kind="look"), False)
@example((Find(object="cup"),), Change(act=Edit.LIKE), False)
def test_a_change_is_pure_and_makes_valid_steps(
    steps: tuple[Step, ...], change: Change, ended: bool
) -> None:
    last = last_of(steps, ended=ended)
    made = apply(last, change)
    assert made == apply(last, change)
    assert last.steps == steps
    assert StepPlan.model_validate({"steps": [each.model_dump() for each in made]}).steps == made


@given(orders)
def test_again_is_the_same_and_twice_is_the_same_twice(steps: tuple[Step, ...]) -> None:
    last = last_of(steps)
    assert apply(last, Change(Edit.AGAIN)) == steps
    twice = (Repeat(steps=steps, times=2),) if steps else ()
    assert apply(last, Change(Edit.AGAIN, times=2)) == twice


@given(st.lists(flat, min_size=1, max_size=5).map(tuple), places)
def test_another_place_changes_places_alone(steps: tuple[Step, ...], place: str) -> None:
    """Law: where an order names one place, the same steps come out, at the other place."""
    named = {each for step in steps for each in (getattr(step, "place", None),
                                                 *getattr(step, "places", ())) if each}  # fmt: skip
    made = apply(last_of(steps), Change(Edit.INSTEAD, place=place))
    if len(named) != 1 or place in named:
        return
    assert [without_places(each) for each in made] == [without_places(each) for each in steps]
    assert all(getattr(each, "place", place) in (place, None) for each in made)


@given(st.lists(places, min_size=2, max_size=4, unique=True).map(tuple), places, st.booleans())
def test_a_round_loses_one_place_and_keeps_the_order_of_the_rest(
    stops: tuple[str, ...], place: str, patrols: bool
) -> None:
    steps: tuple[Step, ...] = (
        (Patrol(places=stops),) if patrols else tuple(GoTo(place=each) for each in stops)
    )
    left = tuple(each for each in stops if each != place)
    made = apply(last_of(steps), Change(Edit.LEAVE_OUT, place=place))
    first = apply(last_of(steps), Change(Edit.FIRST, place=place))
    if place not in stops:
        assert (made, first) == ((), ())
        return
    assert places_of_round(made) == left
    if place != stops[0]:
        assert places_of_round(first) == (place, *left)
    assert apply(last_of(steps, ended=True), Change(Edit.LEAVE_OUT, place=place)) == ()


def places_of_round(steps: tuple[Step, ...]) -> tuple[str, ...]:
    patrol = steps[0]
    if isinstance(patrol, Patrol):
        return patrol.places
    return tuple(each.place for each in steps if isinstance(each, GoTo))


@given(st.floats(0.1, 3.0), st.sampled_from([1.0, -1.0]), st.sampled_from([1.0, -1.0]), metres)
def test_a_motion_goes_on_the_way_it_went(much: float, on: float, way: float, more: float) -> None:
    drive = last_of((MoveStraight(distance_m=on * much),))
    [made] = apply(drive, Change(Edit.MORE, way=way, amount=more, turns=False))
    assert made == MoveStraight(distance_m=on * way * more)
    assert apply(drive, Change(Edit.MORE, amount=more, turns=True)) == ()
    assert apply(drive, Change(Edit.OTHER_SIDE)) == ()


@given(orders)
def test_nothing_of_a_finished_round_is_changed(steps: tuple[Step, ...]) -> None:
    for act in (Edit.LEAVE_OUT, Edit.FIRST):
        assert apply(last_of(steps, ended=True), Change(act, place="study")) == ()


@given(orders)
def test_steps_are_read_back_from_their_records(steps: tuple[Step, ...]) -> None:
    made = StepPlan(steps=(*steps, *((Repeat(steps=steps, times=2),) if steps else ())))
    assert steps_of(plan_record(made).steps) == made.steps


@pytest.mark.parametrize("act", Edit)
def test_an_order_without_steps_has_no_slot(act: Edit) -> None:
    assert apply(last_of(()), Change(act)) == ()
