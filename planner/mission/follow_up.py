"""Say what a sentence means that leans on the goal before it: "again", "no, the study", 还有厨房.

"Come back" alone leads to where the order before was given: its departure, kept with each goal.

Pure. The words of the newest order are taken up, with another place in them where one is named; a
place alone is gone to. Law: nothing is leant on that is older than ``LEANS_S``, and where it is not
beyond doubt which place or which order is meant, the sentence stays as it was said, for a brain to
ask about. What comes of it is an order like any other, and every guard reads it as the person's.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from planner.language.commands import (
    AppendCommand,
    HereCommand,
    Intent,
    LeaningCommand,
    LeaveOutCommand,
    OtherPlaceCommand,
    OutcomeCommand,
    RepeatCommand,
    Replace,
    intent_of,
)
from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, place_alone, plain
from planner.mission.antecedents import name_antecedents
from planner.mission.left_out import excludes_way, is_destination_denied, leave_out, put_first
from planner.mission.open_questions import find_choice
from planner.mission.outcomes import moves
from planner.mission.place_words import (
    find_place,
    name_place,
    names_of,
    put_place,
    room_of,
    write_drive,
)
from planner.mission.pronouns import name_pronouns
from planner.mission.short_follow_up import ShortFollowUp, read_short_follow_up
from planner.mission.state import ORDER_SOURCE, goal_to_end
from planner.mission.whereabouts import search_of_place
from planner.plan import ChangedOrder, Code, GoalState

if TYPE_CHECKING:
    from planner.language.utterance import Utterance
    from planner.mission.state import Mission, MissionState
    from planner.site.site_view import SiteView

LEANS_S = 1800.0
"""Half an hour: after it, "again" means nothing that a person could be held to."""
AWAY_M, DRIVEN_M = 1.0, 0.1
"""An order that is over, drove nothing and was given here was done here: one before is meant."""
OLD_POSE_S = 1.0
"""A status older than this says nothing of where the robot is."""
Point = tuple[float, float, float]
"""x [m], y [m], yaw [rad] in ``map``."""
_LOOKS = frozenset({"count", "find", "look"})
_LOOKS_ZH = re.compile(r"也.{0,4}[看瞅瞧查找数]")
"""Asks to look at one more place, whatever else was done at the place before."""
_DRIVES = frozenset({"go_to", "come_back", "return_home", "turn", "move", "wait"})
_HERE = re.compile(r" ?\b(?:right )?(?:over )?(?:in )?here\b|(?:在)?(?:这里|这儿|这边)面?")
_SPOKEN = frozenset({GoalState.PLANNING, GoalState.NEEDS_CLARIFICATION})
_HEDGE = re.compile(
    r"^(?:it|he|she|they) (?:should|must|might|could|may|has to) be (?=(?:in|at|on) )"
    r"|^(?:它|他|她)?(?:应该|可能|好像|大概|也许|多半)(?:是)?(?:在|放在)?|^是在?(?=.{1,6}$)",
    re.IGNORECASE,
)
"""A guess about where something is, said of a place that takes another's place."""
_ASIDE = re.compile(
    r"^(?:by|near|beside|next to|on) |(?:旁边|边上|附近|那边|那里|那儿|这边|上面?|里面?)$",
    re.IGNORECASE,
)
"""Beside a place that takes another's place: the last order says at which side of it."""
_ORDERS = re.compile(
    r"(?:please )?(?:go|drive|come|move|head|return|turn|look|find|search|count|follow|patrol|wait"
    r"|visit|check|say|tell|ask|take|bring|get|see|stop|have a look|pop)\b"
    r"|[去到回来找看数转跟等说告问巡走开带拿停]"
)


def meaning_of(book: MissionState, text: str, now_unix_s: float) -> str:
    """Return the order that a sentence is, in words that lean on nothing."""
    intent: Intent | None = intent_of(text)
    last = last_order(book, now_unix_s)
    short = find_short_follow_up(book, text, now_unix_s)
    if short is not None:
        return short.order
    if (intent is None or isinstance(intent, OutcomeCommand)) and last is not None:
        orders = last_orders(book, now_unix_s)
        named = name_antecedents(text, orders, book.facts, names_of(book.facts))
        return named or name_pronouns(text, last, book.facts)
    if isinstance(intent, LeaveOutCommand) or not isinstance(intent, LeaningCommand | Replace):
        return text
    if isinstance(intent, RepeatCommand):
        return _repeat_order(last.order_text, intent.times) if last is not None else text
    if isinstance(intent, OtherPlaceCommand):
        return _other_place(book.facts, last) or text
    rest = _innermost(intent.rest)
    names = names_of(book.facts)
    if isinstance(intent, AppendCommand) and not _is_over_there(book.facts, text, rest, last):
        return text
    place = find_place(book.facts, rest) or place_alone(_ASIDE.sub("", rest), names)
    if place is None:
        takes_back = isinstance(intent, Replace) and not intent.corrects
        if not (takes_back or _ORDERS.match(plain(rest))):
            return text
        named = name_antecedents(rest, last_orders(book, now_unix_s), book.facts, names)
        return named or rest
    return _order_at(book.facts, text, intent, place, last) or text


def _is_over_there(facts: SiteView, text: str, rest: str, last: Mission | None) -> bool:
    """Tell whether the places named before an addition are of the order before it.

    "When you're done in the kitchen, …" waits for what is done there, and for nothing else.
    """
    names = names_of(facts)
    at = plain(text).find(plain(rest))
    before = {each.id for each in find_places(plain(text)[:at], names)} if at > 0 else set()
    steps = last.steps if last is not None else ()
    gone = {place for step in steps for place in (step.place, *step.places) if place}
    return before <= gone | {room for place in gone if (room := room_of(facts, place))}


def _order_at(
    facts: SiteView,
    text: str,
    intent: LeaningCommand | Replace,
    place: str,
    last: Mission | None,
) -> str | None:
    """Return what a sentence that names one place wants there; None where that is in doubt."""
    rest = _innermost(intent.rest) if isinstance(intent, AppendCommand | Replace) else ""
    looked = last is not None and any(step.kind in _LOOKS for step in last.steps)
    if _LOOKS_ZH.search(plain(text)) and not looked:
        return f"{write_drive(facts, place, rest)}看看"
    if last is None:
        return write_drive(facts, place, rest)
    again = put_place(facts, last.order_text, place, rest)
    if again is None and isinstance(intent, AppendCommand) and intent.asks:
        again = _look_there(facts, last, place, rest)
    if again is None and isinstance(intent, Replace) and intent.corrects:
        again = search_of_place(last, place, facts)
        if again is None and any(step.kind not in _DRIVES for step in last.steps):
            return None  # a bare drive would leave out what was to be done there
    return again or write_drive(facts, place, rest)


def find_short_follow_up(book: MissionState, text: str, now_unix_s: float) -> ShortFollowUp | None:
    """Return what a few words make of the newest order; None where they are more, or less."""
    intent, last = intent_of(text), last_order(book, now_unix_s)
    waiting = [m for m in book.missions.values() if m.state is GoalState.NEEDS_CLARIFICATION]
    asked = max(waiting, key=lambda m: m.order, default=None)
    chosen = find_choice(asked, text) if asked is not None and intent is None else None
    if chosen is not None:
        return ShortFollowUp(chosen)
    without = change_round(book, text, now_unix_s)
    if without is not None:
        return ShortFollowUp(without, ends=True)
    wider = _widen_patrol(book, last, intent) if isinstance(intent, AppendCommand) else None
    if wider is not None:
        return ShortFollowUp(wider, ends=True)
    open_to = (AppendCommand, RepeatCommand, Replace, *((HereCommand,) if asked is last else ()))
    if last is None or not (intent is None or isinstance(intent, open_to)):
        return None
    here = book.status.base_in_map if book.status is not None else None
    return read_short_follow_up(text, last, book.facts, names_of(book.facts), here)


def _widen_patrol(book: MissionState, last: Mission | None, added: AppendCommand) -> str | None:
    """Return a patrol that runs with one more place; None where something else, or more, runs."""
    place = place_alone(added.rest, names_of(book.facts))
    ahead = last.steps[last.step :] if last is not None and not last.has_ended else ()
    if place is None or last is None or [step.kind for step in ahead] != ["patrol"]:
        return None
    if ahead[0].depth or place in ahead[0].places or last.speed_share != 1.0:
        return None
    order = last.order_text
    chinese = has_chinese(order)
    stops = (*ahead[0].places, place)
    names = [name_place(book.facts, stop, chinese, order) for stop in stops]
    return f"巡逻{'、'.join(names)}" if chinese else f"patrol the {' and the '.join(names)}"


def change_round(book: MissionState, text: str, now_unix_s: float) -> str | None:
    """Return the order that runs without the place that a sentence leaves out, or puts first."""
    last = last_order(book, now_unix_s)
    if last is None or book.running not in (None, last.id):
        return None
    if last.state is GoalState.PAUSED and not isinstance(intent_of(text), LeaveOutCommand):
        return None  # "it isn't in there" sets nothing in motion that stands
    return leave_out(text, last, book.facts) or put_first(text, last, book.facts)


def denies_way(book: MissionState, text: str, now_unix_s: float) -> bool:
    """Tell whether a sentence says of a place that the robot is on its way to that it is wrong."""
    last = last_order(book, now_unix_s)
    return last is not None and is_destination_denied(text, last, book.facts)


def denied_goal(book: MissionState, text: str, now_unix_s: float) -> str | None:
    """Return the newest open order on whose way a sentence says not to go; None: on none.

    "Don't go in there" is that of the place that was spoken of last.
    """
    said = meaning_of(book, text, now_unix_s)
    denied = (m.id for m in last_orders(book, now_unix_s) if excludes_way(said, m, book.facts))
    return next(denied, None)


@dataclass(frozen=True, slots=True)
class Lean:
    """Hold how a sentence leans on the goals before it, as its reception found."""

    changed: ChangedOrder
    """What it makes of the newest order."""
    ends: bool = False
    """It ends what runs."""
    first: bool = False
    """It is done right after what runs, or in its place."""
    replaces: bool = False
    """It ends what runs once it is understood."""
    corrects: bool = False
    """It puts something else in the place of what was ordered or asked."""


def lean_of(book: MissionState, said: Utterance, now_unix_s: float) -> Lean | None:
    """Return how a sentence leans on the goals before it; None: on none, or in doubt."""
    text, intent = said.text, said.intent
    short = find_short_follow_up(book, text, now_unix_s)
    if short is not None:
        ends = short.ends and _is_under_way(book, now_unix_s)
        return Lean(ChangedOrder(words=short.order), ends, first=ends or short.joins)
    if not (intent is None or isinstance(intent, LeaningCommand | Replace)):
        return None
    meant = meaning_of(book, text, now_unix_s)
    if meant == text:
        return None
    ends = isinstance(intent, OtherPlaceCommand | LeaveOutCommand) or (
        isinstance(intent, Replace) and intent.now
    )
    return Lean(
        ChangedOrder(words=meant),
        ends,
        first=ends or isinstance(intent, AppendCommand),
        replaces=isinstance(intent, Replace) and not ends,
        corrects=isinstance(intent, Replace | OtherPlaceCommand),
    )


def _is_under_way(book: MissionState, now_unix_s: float) -> bool:
    """Tell whether the goal that would be ended is the newest order itself."""
    last = last_order(book, now_unix_s)
    return last is not None and not last.has_ended and goal_to_end(book) == last.id


def last_order(book: MissionState, now_unix_s: float) -> Mission | None:
    """Return the newest goal that was an order; None where it is long ago."""
    return next(iter(last_orders(book, now_unix_s)), None)


def last_orders(book: MissionState, now_unix_s: float) -> tuple[Mission, ...]:
    """Return the goals that were orders, the newest first, without those of long ago."""
    orders = (m for m in book.missions.values() if _was_taken(m) or _was_read(m))
    recent = (m for m in orders if now_unix_s - m.created_unix_s <= LEANS_S)
    return tuple(sorted(recent, key=lambda m: -m.order))


def _was_taken(mission: Mission) -> bool:
    """Tell whether a goal had steps that the robot can do."""
    return bool(mission.steps) and mission.state is not GoalState.REFUSED


def _was_read(mission: Mission) -> bool:
    """Tell whether a goal without steps is an order that a brain thinks or asks about."""
    plan = mission.plan
    lost = plan is not None and plan.code is Code.NOT_UNDERSTOOD
    return mission.state in _SPOKEN and not lost


def _repeat_order(order: str, times: int) -> str:
    """Return an order, or so many rounds of it."""
    if times == 1:
        return order
    ends = order.rstrip(" .!,;。！，；")
    return f"{ends}{times}次" if has_chinese(order) else f"{ends} {times} times"


def _innermost(rest: str) -> str:
    """Return the order in "no, not the kitchen, the study", without "it should be"."""
    inner = intent_of(rest)
    if isinstance(inner, Replace | AppendCommand):
        return _innermost(inner.rest)
    return _HEDGE.sub("", rest)


def _look_there(facts: SiteView, last: Mission, place: str, said: str) -> str | None:
    """Return what the last order looked for, asked of one place; None where it looked for nothing.

    "And in the study?" after chairs were counted in two rooms, or here, wants them counted there.
    """
    step = next((step for step in reversed(last.steps) if step.kind in _LOOKS), None)
    if step is None:
        return None
    chinese, thing = has_chinese(last.order_text), step.object or ""
    name = name_place(facts, place, chinese, said)
    match step.kind:
        case "count":
            return f"数一下{name}的{thing}" if chinese else f"count the {thing} in the {name}"
        case "find":
            return f"去{name}找{thing}" if chinese else f"look for the {thing} in the {name}"
    asked = _HERE.sub("", plain(step.text or last.order_text)).strip(" ?？.。")
    if find_places(asked, names_of(facts)):
        return f"去{name}看看" if chinese else f"look around the {name}"
    return f"{name}{asked}" if chinese else f"{asked} in the {name}"


def _other_place(facts: SiteView, last: Mission | None) -> str | None:
    """Return the last order with the place that it was not about; None where that is in doubt."""
    if last is None:
        return None
    spoken = (last.order_text, *last.questions, *last.replies)
    named = {each.id for text in spoken for each in find_places(text, names_of(facts))}
    gone = {place for step in last.steps for place in (step.place, *step.places) if place}
    left = named - gone
    if len(left) != 1 or len(named) != 2:
        return None
    return write_drive(facts, left.pop(), last.order_text)


def find_robot(book: MissionState) -> Point | None:
    """Return where the bridge's newest status says that the robot stands."""
    pose = book.status.base_in_map if book.status is not None else None
    return (pose.x_m, pose.y_m, pose.yaw_rad) if pose is not None else None


def departure_of(book: MissionState, now_s: float) -> Point | None:
    """Return where the robot stood when the order was given that led it away from there."""
    here = find_robot(book)
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
        near = hypot(here[0] - begin[0], here[1] - begin[1]) <= AWAY_M
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
