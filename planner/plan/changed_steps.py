"""Change the newest order as a sentence asks: ``apply(last, change) -> steps``. Pure, one table.

Laws: the result differs from the newest order's steps in the slot that the change names alone;
where the order has no such slot, or more than one thing could be meant, there are no steps, and
nothing is changed. Steps come out, never a sentence: no language is known here.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi, radians
from types import MappingProxyType

from planner.plan.change import Change, Edit, LastOrder
from planner.plan.goal import places_of
from planner.plan.slots import (
    SEEKS,
    names_place,
    places_in,
    places_inside,
    put_name,
    put_place,
    put_words,
    room_of,
    sought_thing,
)
from planner.plan.steps import (
    Count,
    Find,
    GoTo,
    GoToObject,
    Look,
    MoveStraight,
    Patrol,
    Recall,
    Repeat,
    Step,
    Turn,
)
from planner.plan.tree import list_nodes

BIT_RAD, BIT_M = radians(30.0), 0.2
"""Of "a bit more" of a turn and of a straight drive, as for "turn left a bit"."""
LOOKS = frozenset({"count", "find", "look"})
_DRIVES = frozenset({"go_to", "come_back", "return_home", "turn", "move", "wait", "stand_at"})
_SPEAKS = frozenset({"say", "ask"})
_FACES = frozenset({"go_to_object", "stand_at"})
"""After these the robot faces what it came for, so that "closer" is straight ahead."""

Steps = tuple[Step, ...]


def apply(last: LastOrder, change: Change) -> Steps:
    """Return the newest order's steps with this change; none where it has no such slot."""
    return _ACTS[change.act](last, change) or ()


def _repeat(last: LastOrder, change: Change) -> Steps | None:
    steps = last.steps
    kinds = {node.step.kind for node in list_nodes(steps)}
    match change.kind:
        case "say":
            steps = steps[-1:] if steps and steps[-1].kind == "say" else ()
            return steps * change.times
        case "count" | "look" if not kinds & (LOOKS if change.kind == "look" else {"count"}):
            return None
        case "tell" if not (kinds & _SPEAKS and last.person):
            return None
    return (Repeat(steps=steps, times=change.times),) if steps and change.times > 1 else steps


def _also(last: LastOrder, change: Change) -> Steps | None:
    looked = [step for step in last.steps if step.kind in LOOKS]
    place = change.place
    if place is None:
        besides = _look_besides(last, looked[-1], change) if change.thing and looked else None
        return besides or _put_person_or_words(last, change)
    if (wider := _widen_patrol(last, place)) is not None:
        return wider
    if change.words is not None and not looked:
        return (GoTo(place=place), Look(question=change.words, place=place))
    same = _put_place(last, place, change.inner)
    if same is None and change.asks and looked:
        same = (GoTo(place=place), _at(last, looked[-1], place))
    return same or (GoTo(place=change.inner or place),)


def _put_person_or_words(last: LastOrder, change: Change) -> Steps | None:
    if change.person is not None:
        return put_name(last.steps, last.person, change.person)
    return put_words(last.steps, last.person, change.words) if change.words is not None else None


def _widen_patrol(last: LastOrder, place: str) -> Steps | None:
    """Return a patrol that goes on with one more place; None where something else goes on."""
    patrol = last.ahead[0] if len(last.ahead) == 1 else None
    if not isinstance(patrol, Patrol) or place in patrol.places:
        return None
    return (patrol.model_copy(update={"places": (*patrol.places, place)}),)


def _instead(last: LastOrder, change: Change) -> Steps | None:
    if change.place is None:
        thing = change.thing and put_name(last.steps, last.thing, change.thing)
        return thing or _put_person_or_words(last, change)
    if change.who:
        return _correct_whereabouts(last, change)
    if change.inner is not None and change.inner not in places_inside(last.names, change.place):
        return None
    put = _put_place(last, change.place, change.inner)
    if put is None and not all(step.kind in _DRIVES for step in last.steps):
        return _narrow(last, change.place)  # a bare drive would leave out what was to be done there
    return put or (GoTo(place=change.inner or change.place),)


def _correct_whereabouts(last: LastOrder, change: Change) -> Steps | None:
    """Return the order at the place where its person or thing is said to be instead."""
    before = places_in(last.steps)
    seeks_thing = (
        change.who == "it" and last.person is None and sought_thing(last.steps) is not None
    )
    place = change.place
    known = seeks_thing or (change.who != "it" and last.person is not None)
    if place is None or place in before or len(before) > 1 or not known:
        return None
    if change.denied is not None and before and change.denied not in before:
        return None
    if before:
        return _put_place(last, place)
    seek = Find(object=last.person or "", place=place)
    return _narrow(last, place) or ((GoTo(place=place), seek, *last.steps) if last.person else None)


def _take_other_place(last: LastOrder, change: Change) -> Steps | None:
    left = last.spoken - places_in(last.steps)
    return _put_place(last, next(iter(left))) if len(left) == 1 == len(last.spoken) - 1 else None


def _narrow_search(last: LastOrder, change: Change) -> Steps | None:
    """Return the search of the place that is said, or of all; None where no search is open."""
    seeks = [step for step in last.steps if isinstance(step, Find)]
    placed = any(places_of(step) for step in last.steps)
    missed = change.missed or not (last.ended and last.found)
    if last.person is not None and seeks and not placed and not last.ended:
        return _narrow(last, change.place) if change.place and change.who != "it" else None
    thing = sought_thing(last.steps)
    if thing is None or (change.who not in ("", "it") and last.person is None):
        return None
    if change.place is None:
        return (Find(object=thing),)
    if (change.tells and not missed) or (change.kind == "then" and not last.ended):
        return None
    if not (change.tries or change.tells) and placed:
        return None
    place = change.inner or change.place
    if change.inner is not None and change.inner not in places_inside(last.names, change.place):
        return None
    return (GoTo(place=place), Find(object=thing, place=place))


def _narrow(last: LastOrder, place: str | None) -> Steps | None:
    """Return the order with its search at one place."""
    if place is None or not any(isinstance(step, Find) for step in last.steps):
        return None
    if len({node.step.kind for node in list_nodes(last.steps)} - _SPEAKS - SEEKS) > 0:
        return None
    found: list[Step] = []
    for step in last.steps:
        if isinstance(step, Find):
            found += [GoTo(place=place), step.model_copy(update={"place": place})]
        elif step.kind in _SPEAKS:
            found.append(step)
    return tuple(found)


def _leave_out(last: LastOrder, change: Change) -> Steps | None:
    place = change.place
    whole = _rooms_sought(last) or _round_of(last)
    if place is None or whole is None:
        return None
    looked = any(step.kind in LOOKS for _, steps in whole for step in steps)
    gone = {place, *places_inside(last.names, place)}
    left = [(stop, steps) for stop, steps in whole if stop not in gone]
    if not left or len(left) == len(whole) or (change.tells and not looked):
        return None
    return _join(last, left)


def _first(last: LastOrder, change: Change) -> Steps | None:
    whole = _round_of(last)
    if whole is None or change.place not in [stop for stop, _ in whole[1:]]:
        return None
    return _join(last, sorted(whole, key=lambda stop: stop[0] != change.place))


_Stops = list[tuple[str, Steps]]
"""Places, each with what is done there."""


def _way_home(last: LastOrder) -> Steps:
    ends = last.ahead[-1].kind if len(last.ahead) > 1 else ""
    return last.ahead[-1:] if ends in ("come_back", "return_home") else ()


def _round_of(last: LastOrder) -> _Stops | None:
    """Return the places of a round that goes on, each with its steps; None of anything else."""
    ahead = last.ahead[: len(last.ahead) - len(_way_home(last))]
    if len(ahead) == 1 and isinstance(ahead[0], Patrol):
        return [(place, (ahead[0],)) for place in ahead[0].places]
    stops: dict[str, Steps] = {}
    for step in ahead:
        if not isinstance(step, GoTo | Look) or step.place is None:
            return None
        stops[step.place] = (*stops.get(step.place, ()), step)
    questions = {step.question for step in ahead if isinstance(step, Look)}
    several = len(questions) > 1 or any(names_place(last.names, each) for each in questions)
    looks = [any(step.kind == "look" for step in steps) for steps in stops.values()]
    return None if len(stops) < 2 or several or len(set(looks)) > 1 else list(stops.items())


def _rooms_sought(last: LastOrder) -> _Stops | None:
    """Return the rooms in which a search of the whole home has not looked, with a look in each."""
    ahead = last.ahead[: len(last.ahead) - len(_way_home(last))]
    search = ahead[0] if len(ahead) == 1 else None
    asked = last.seen_as(search.object) if isinstance(search, Find) and not search.place else None
    if asked is None:
        return None
    rooms = (
        each.id for each in last.names.entries if each.kind == "room" and each.id not in last.looked
    )
    return [(room, (GoTo(place=room), Look(question=asked, place=room))) for room in rooms]


def _join(last: LastOrder, stops: _Stops) -> Steps:
    """Return a round of these stops, and its way home."""
    if isinstance(only := stops[0][1][0], Patrol):
        steps: Steps = (only.model_copy(update={"places": tuple(stop for stop, _ in stops)}),)
    else:
        steps = tuple(step for _, each in stops for step in each)
    return (*steps, *_way_home(last))


def _go_on_a_bit(last: LastOrder, change: Change) -> Steps | None:
    step = last.steps[-1] if last.steps else None
    if change.kind == "closer" and step is not None and step.kind in _FACES:
        return (MoveStraight(distance_m=BIT_M),)
    if len(last.steps) != 1 or not isinstance(step, Turn | MoveStraight):
        return None
    turns = isinstance(step, Turn)
    on = 1.0 if (step.angle_rad if isinstance(step, Turn) else step.distance_m) > 0.0 else -1.0
    if change.turns not in (None, turns) or (change.side or on) != on:
        return None
    if change.kind in ("closer", "forth") and (turns or on != (1.0 if change.way > 0.0 else -1.0)):
        return None
    much = change.amount if change.amount is not None else BIT_RAD if turns else BIT_M
    way = on * change.way * much
    return (Turn(angle_rad=way) if turns else MoveStraight(distance_m=way),)


def _other_side(last: LastOrder, change: Change) -> Steps | None:
    step = last.steps[0] if len(last.steps) == 1 else None
    if not isinstance(step, Turn) or step.angle_rad == 0.0:
        return None
    side = -1.0 if step.angle_rad > 0.0 else 1.0
    if change.side not in (None, side):
        return None  # the side that it turns to already
    wanted = abs(step.angle_rad)
    come = wanted if last.ended else min(last.turned_rad, wanted)
    return (Turn(angle_rad=side * (wanted + come if wanted < pi else wanted)),)


def _ask_what_was_seen(last: LastOrder, change: Change) -> Steps | None:
    kinds = {node.step.kind for node in list_nodes(last.steps)}
    looked = bool(kinds & (LOOKS | {"patrol", "follow"}))
    if change.words is not None:  # "see anyone?"
        asked = None if change.words == "anything" else change.words
        return (Recall(object=asked),) if looked and (last.ended or change.tells) else None
    if last.thing is None or not (looked or change.place is not None):
        return None
    return (Recall(object=last.thing, place=change.place),)


def _like(last: LastOrder, change: Change) -> Steps | None:
    thing = sought_thing(last.steps)
    return (Look(question=change.words.format(thing)),) if thing and change.words else None


def _the_one(last: LastOrder, change: Change) -> Steps | None:
    thing = sought_thing(last.steps)
    return (GoToObject(object=thing, place=change.place),) if thing else None


_ACTS: MappingProxyType[Edit, Callable[[LastOrder, Change], Steps | None]] = MappingProxyType(
    {
        Edit.AGAIN: _repeat,
        Edit.ALSO: _also,
        Edit.INSTEAD: _instead,
        Edit.OTHER: _take_other_place,
        Edit.WHERE: _narrow_search,
        Edit.LEAVE_OUT: _leave_out,
        Edit.FIRST: _first,
        Edit.MORE: _go_on_a_bit,
        Edit.OTHER_SIDE: _other_side,
        Edit.SEEN: _ask_what_was_seen,
        Edit.LIKE: _like,
        Edit.THE_ONE: _the_one,
    }
)


def _put_place(last: LastOrder, place: str, inner: str | None = None) -> Steps | None:
    """Return the order at another place; None where it names none, or several.

    "Go to the bedroom and see if the cat is on the bed" names one: the bed, and the room it is in.
    """
    gone = places_in(last.steps)
    whole = {each for each in gone if not gone - {each, room_of(last.names, each)}}
    put = inner or place
    around = room_of(last.names, put)
    if not whole or put in gone or (around is None and (len(gone) == 2 or inner is not None)):
        return None  # of a bed, another room makes no order
    old = whole.pop()
    moved = {old: put} | dict.fromkeys(gone - {old}, around or put)
    return put_place(last.steps, last.names, moved)


def _look_besides(last: LastOrder, looked: Step, change: Change) -> Steps | None:
    """Return the same look for another thing, where the order before looked."""
    places, thing = places_in(last.steps), change.thing or ""
    if len(places) > 1:
        return None
    place = next(iter(places), None)
    asked, kind = last.seen_as(thing), change.kind or looked.kind
    step: Step
    if kind == "count":
        step = Count(object=thing, place=place)
    elif kind == "find":
        step = Find(object=thing, place=place)
    elif asked is not None:
        step = Look(question=asked, place=place)
    else:
        return None  # no question of a look asks for it
    return (GoTo(place=place), step) if place is not None else (step,)


def _at(last: LastOrder, looked: Step, place: str) -> Step:
    """Return a look at a place, with the question that it asks of it."""
    if isinstance(looked, Look):
        [looked] = put_place((looked,), last.names, dict.fromkeys(places_of(looked), place))
    return looked.model_copy(update={"place": place})
