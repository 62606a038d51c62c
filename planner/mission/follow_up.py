"""Say what a sentence makes of the orders before it: "again", "no, the study", 还有厨房.

Pure; worked out once for a sentence, by its reception. What it changes is read by
``planner.language.changes``, put into the newest order's steps by ``planner.plan.apply``, and
planned by the built-in brain alone: a model reads what was said. Law: nothing is leant on that is
older than ``LEANS_S``, and where it is in doubt what is meant, nothing is changed. "Come back"
leads to where the order before was given, where that is beyond doubt.
"""

from __future__ import annotations

import re
from dataclasses import replace
from math import hypot, pi
from typing import TYPE_CHECKING

from planner.language.changes.antecedents import complete_person, fits, thing_of
from planner.language.changes.reader import read_changes
from planner.language.commands import HereCommand, Intent, Replace, intent_of
from planner.language.folding import has_chinese
from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.clauses import read_clauses
from planner.language.motion_guard.mentioned_names import find_places
from planner.language.object_names import resolve
from planner.language.person_names import is_given_name, people_named
from planner.language.reading import ChangeReading
from planner.language.schedule import OrderCommand
from planner.language.stop import is_stop
from planner.mission.open_questions import find_choice, find_offered_plan
from planner.mission.outcomes import moves
from planner.mission.state import ORDER_SOURCE, GivenOrder, Mission, MissionState, goal_to_end
from planner.plan import (
    Change,
    ChangedOrder,
    Code,
    Edit,
    GoalState,
    LastOrder,
    Patrol,
    apply,
    places_of,
    steps_of,
)
from planner.skills.viewpoints import room_of

if TYPE_CHECKING:
    from planner.language.sentence import SaidSentence


_THERE = re.compile(r"\bthere\b|那[里儿边]")
_SPOKEN = frozenset({GoalState.PLANNING, GoalState.NEEDS_CLARIFICATION})
_ROUNDS = frozenset({Edit.LEAVE_OUT, Edit.FIRST})
_CORRECTS = frozenset({Edit.INSTEAD, Edit.OTHER})
_CLAUSE_END = re.compile(r"[,，;；.。!！](?!$)")
_ARTICLE = re.compile(r"^(?:the|my|our|your|an?|some|any) ", re.IGNORECASE)


def lean_of(book: MissionState, said: SaidSentence, now_unix_s: float) -> ChangeReading | None:
    """Return how a sentence leans on the goals before it; None: on none, or in doubt."""
    text, intent, orders = said.text, said.intent, last_orders(book, now_unix_s)
    last, names = next(iter(orders), None), book.facts.names
    asked = next(reversed(book.goals_in(GoalState.NEEDS_CLARIFICATION)), None)
    if isinstance(intent, Replace):
        return _take_back(book, intent, orders, text)
    opens = intent is None or (isinstance(intent, HereCommand) and asked is last)
    chosen = find_choice(asked, text) if asked is not None and intent is None else None
    if chosen is not None:
        offered = find_offered_plan(asked, text) if asked is not None else None
        steps = () if offered is None else offered.steps
        return ChangeReading(ChangedOrder(steps=steps, words="" if steps else chosen))
    for change in read_changes(text, names):
        if not opens and change.act not in _ROUNDS:
            continue  # 别去卧室了 ends the round only where it is not one
        lean = _lean(book, change, orders, text)
        if lean is not None:
            return lean
    return None


def _take_back(
    book: MissionState, intent: Replace, orders: tuple[Mission, ...], text: str
) -> ChangeReading:
    """Return how "forget that, …" leans on the order before it."""
    names = book.facts.names
    changed: ChangedOrder | None = None
    for each in read_changes(text, names):
        lean = _lean(book, each, orders, text) if not each.rest else None
        if lean is not None and intent.now:
            return lean
        if lean is not None:  # "… instead" ends what runs once it is understood
            return replace(lean, ends=False, first=False, replaces=True)
    for each in read_changes(intent.rest, names):
        there = Change(Edit.INSTEAD, each.place, each.inner) if each.act is Edit.WHERE else each
        lean = _lean(book, there, orders, intent.rest) if there.act is Edit.INSTEAD else None
        changed = changed or (lean.changed if lean is not None else None)
    changed = changed or ChangedOrder(words=intent.rest)
    now = intent.now
    return ChangeReading(changed, ends=now, first=now, replaces=not now, corrects=True)


def _lean(
    book: MissionState, change: Change, orders: tuple[Mission, ...], text: str
) -> ChangeReading | None:
    """Return what one change makes of the newest order; None where it makes nothing of it."""
    last, corrects = next(iter(orders), None), change.act in _CORRECTS
    if change.rest:
        if not _is_order(change.rest) or not _is_over_there(book, change, last):
            return None
        changed = ChangedOrder(words=change.rest)
        return ChangeReading(changed, ends=corrects, first=True, corrects=corrects)
    if change.who and last is not None and not _fits(change.who, last):
        return None
    order = _last_order(book, last)
    if change.act in _ROUNDS and not _may_change_round(book, change, last):
        return None
    completes = change.act is Edit.WHERE and last is not None and not last.steps
    words = (
        complete_person(change, last, book.facts.names) if completes and last is not None else None
    )
    steps = apply(order, change) if words is None else ()
    if not steps and words is None:
        return None
    thinks = last is not None and last.state is GoalState.PLANNING and not last.steps
    changed = ChangedOrder(words=text) if thinks else ChangedOrder(steps=steps, words=words or "")
    if change.act is Edit.ALSO:
        wider = change.place is not None and isinstance(steps[0], Patrol)
        ends = wider and _is_under_way(book, last)
        return ChangeReading(changed, ends=ends, first=True)
    place = corrects and change.place is not None and not change.who
    ends = place or change.act is Edit.OTHER or (
        change.act in _ROUNDS | {Edit.INSTEAD, Edit.WHERE, Edit.OTHER_SIDE}
        and _is_under_way(book, last)
    )  # fmt: skip
    rounds = change.act in _ROUNDS
    return ChangeReading(changed, ends, first=ends, corrects=corrects, keeps_round=rounds)


def _is_order(rest: str) -> bool:
    """Tell whether the rest of a sentence is no command to the planner itself."""
    intent: Intent | None = intent_of(rest)
    return intent is None or isinstance(intent, OrderCommand) or is_stop(rest)


def _is_over_there(book: MissionState, change: Change, last: Mission | None) -> bool:
    """Tell whether a place that is to be done with first is of the order before.

    "When you're done in the kitchen, …" waits for what is done there, and for nothing else.
    """
    if change.act is not Edit.ALSO or change.denied is None:
        return True
    steps = last.steps if last is not None else ()
    gone = {place for step in steps for place in places_of(step)}
    return change.denied in gone | {room_of(book.facts, place) for place in gone}


def _fits(who: str, last: Mission) -> bool:
    """Tell whether a pronoun can mean the person, or the thing, of an order."""
    person = person_of(last)
    return person is None or who == "it" or fits(who, person)


def _may_change_round(book: MissionState, change: Change, last: Mission | None) -> bool:
    """Tell whether the newest order goes on; a denial sets nothing in motion that stands."""
    if last is None or book.running not in (None, last.id):
        return False
    return last.state is not GoalState.PAUSED or change.kind == "skip"


def newest_order(book: MissionState, besides: str, now_s: float) -> LastOrder | None:
    """Return what is known of the newest order besides a goal; None where there is none."""
    orders = last_orders(book, now_s + book.wall_offset_s)
    last = next((each for each in orders if each.id != besides and each.steps), None)
    return None if last is None else _last_order(book, last)


def _last_order(book: MissionState, last: Mission | None) -> LastOrder:
    """Return what is known of the newest order."""
    names = book.facts.names
    if last is None:
        return LastOrder((), names=names)
    ahead = last.steps[last.step :]
    parted = not last.has_ended and last.speed_share == 1.0 and not any(s.depth for s in ahead)
    code = last.outcome.code if last.outcome is not None else None
    spoken = (last.order_text, *last.questions, *last.replies)
    return LastOrder(
        steps_of(last.steps),
        ahead=steps_of(ahead) if parted else (),  # a slow round would go on fast
        ended=last.has_ended,
        found=code is Code.FOUND or last.state is GoalState.SUCCEEDED,
        person=person_of(last),
        thing=thing_of(last),
        spoken=frozenset(each.id for text in spoken for each in find_places(text, names)),
        looked=frozenset(room for step in ahead for room in step.rooms),
        turned_rad=_turned_rad(book, last),
        names=names,
        seen_as=_ask_whether_there,
    )


def person_of(last: Mission) -> str | None:
    """Return the one person whom an order is for; None of none, and of several."""
    named = {step.object for step in last.steps if step.object and is_given_name(step.object)}
    spoken = people_named(last.order_text)
    people = named or set(spoken)
    return people.pop() if len(people) == 1 and len(spoken) <= 1 else None


def _turned_rad(book: MissionState, last: GivenOrder) -> float:
    """Return how far a turn under way has come; 0 where that is unknown."""
    here = book.pose
    if here is None or last.accepted_at is None:
        return 0.0
    return abs((here.yaw_rad - last.accepted_at[2] + pi) % (2.0 * pi) - pi)


def _ask_whether_there(thing: str) -> str | None:
    """Return the question whether a thing or somebody is there; None of one who is called."""
    kind = resolve(thing)
    if kind is None or is_given_name(thing):
        return None
    if has_chinese(thing):
        return f"看看有没有{thing}"
    if kind[0] == "person":
        return "see if anybody is there"
    noun = _ARTICLE.sub("", thing)
    some = "are any" if noun.endswith("s") else f"is a{'n' if noun[0] in 'aeiou' else ''}"
    return f"see if there {some} {noun}"


def _is_under_way(book: MissionState, last: Mission | None) -> bool:
    """Tell whether the goal that would be ended is the newest order itself."""
    return last is not None and not last.has_ended and goal_to_end(book) == last.id


def denies_way(book: MissionState, text: str, now_unix_s: float) -> bool:
    """Tell whether a sentence says of a place that the robot is on its way to that it is wrong.

    What follows behind a mark, "not the bedroom, he's reading in the study", changes nothing of it.
    """
    last = next(iter(last_orders(book, now_unix_s)), None)
    if last is None:
        return False
    names = book.facts.names
    whole = read_changes(text, names)
    first = _CLAUSE_END.split(text.strip(), maxsplit=1)[0]
    denied = {each.place for each in whole if each.act is Edit.LEAVE_OUT and each.denied}
    if not denied and first != text and not any(each.act is Edit.INSTEAD for each in whole):
        parts = read_changes(first, names)
        denied = {each.place for each in parts if each.act is Edit.LEAVE_OUT and not each.tells}
    return not _places_ahead(last).isdisjoint(denied)


def denied_goal(book: MissionState, order: str, now_unix_s: float) -> str | None:
    """Return the newest open order on whose way a sentence says not to go; None: on none.

    "Don't go in there" is that of the place that was spoken of last.
    """
    names = book.facts.names
    denied = " | ".join(c.text for c in read_clauses(order, names) if c.mood is ClauseMood.DENIED)
    places = {each.id for each in find_places(denied, names)}
    orders = last_orders(book, now_unix_s)
    if not places and _THERE.search(denied):
        return next((m.id for m in orders if _places_ahead(m)), None)
    return next((m.id for m in orders if not places.isdisjoint(_places_ahead(m))), None)


def _places_ahead(last: Mission) -> set[str]:
    ahead = last.steps[last.step :] if not last.has_ended else ()
    return {place for step in ahead for place in places_of(step)}


def last_orders(book: MissionState, now_unix_s: float) -> tuple[Mission, ...]:
    """Return the goals that were orders, the newest first, without those of long ago."""
    orders = (m for m in book.missions.values() if _is_order_of(m))
    recent = (m for m in orders if now_unix_s - m.created_unix_s <= LEANS_S)
    return tuple(sorted(recent, key=lambda m: -m.order))


def _is_order_of(mission: Mission) -> bool:
    """Tell whether a goal had steps that the robot can do, or is thought or asked about."""
    plan = mission.plan
    if mission.steps and mission.state is not GoalState.REFUSED:
        return True
    lost = plan is not None and plan.code is Code.NOT_UNDERSTOOD
    return mission.state in _SPOKEN and not lost


LEANS_S = 1800.0
"""Half an hour: after it, "again" means nothing that a person could be held to."""
AWAY_M, DRIVEN_M = 1.0, 0.1
"""An order that is over, drove nothing and was given here was done here: one before is meant."""
OLD_POSE_S = 1.0
"""A status older than this says nothing of where the robot is."""
Point = tuple[float, float, float]
"""x [m], y [m], yaw [rad] in ``map``."""


def departure_of(book: MissionState, now_s: float) -> Point | None:
    """Return where the robot stood when the order was given that led it away from there."""
    here = book.pose
    if here is None or not now_s - book.status_s <= OLD_POSE_S:
        return None
    now_unix_s = now_s + book.wall_offset_s
    for order in sorted(book.missions.values(), key=lambda m: -m.order):
        by_schedule = order.source.startswith(ORDER_SOURCE)
        if not order.steps or order.state is GoalState.REFUSED or by_schedule:
            continue
        begin = order.accepted_at
        if begin is None or order.map_id != book.facts.map_id:
            return None
        if not now_unix_s - order.created_unix_s <= LEANS_S:
            return None
        near = hypot(here.x_m - begin[0], here.y_m - begin[1]) <= AWAY_M
        if not (near and order.has_ended and order.metres <= DRIVEN_M):
            return begin
    return None


def way_back_of(mission: Mission) -> Point | None:
    """Return where a goal's ``come_back`` leads: one that moves nowhere before leans on departure.

    Else it is where the goal was accepted.
    """
    first = next((step for step in mission.steps if moves(step)), None)
    if first is not None and first.kind == "come_back" and mission.departed_at is not None:
        return mission.departed_at
    return mission.accepted_at
