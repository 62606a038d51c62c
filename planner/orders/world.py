"""Read the missions and the robot for what standing orders must know: may one fire, what happened.

Pure questions about the newest word of bridge, eyes and lidar, and what follows from it: somebody
comes, the battery runs low, a goal fails. Each event has a latch. It is set off by what was seen
twice in a row, and armed again only after that was gone for a while: somebody who stays in the room
comes in once. What can't be seen now (blind eyes, no battery gauge) neither sets off nor arms
anything. At the start nothing is armed, so that what is there already did not come.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot
from typing import TYPE_CHECKING

from planner.bridge_client.bridge_status import cannot_move, standing
from planner.mission.standing_goals import is_of_order
from planner.mission.state import ORDER_SOURCE, Mission, MissionState
from planner.orders.scheduler import BRIDGE_SILENT
from planner.plan import GoalState, PauseReason
from planner.plan.timing import WorldEvent

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.navigation import ObstacleReport

AWAY_S = 120.0
"""Nobody was seen for so long: who comes now has come in."""
STILL_S = 60.0
"""Nothing moved for so long."""
EMPTY_S = 10.0
"""At the start: nobody there for so long, and whoever comes is new."""
SIGHTINGS = 2
"""Looks in a row that show a person; one alone may be a mistake."""
STIRS = 3
"""Scans in a row with something that moves, likewise."""
LOW, HIGH = 0.20, 0.30
"""Of the battery's charge: low from below the one on, until above the other."""


@dataclass(frozen=True, slots=True)
class WorldFacts:
    """Hold what the planner knows now. None: it can't know."""

    look: int | None = None
    """The number of the newest look; None while nothing is seen."""
    person: bool = False
    """That look shows a person."""
    scan: int | None = None
    """The number of the newest scan that was searched for what moves; None while driving."""
    moves: bool = False
    battery: float | None = None
    at_home: bool | None = None
    done: int = 0
    """Goals of persons that have succeeded so far."""
    failed: int = 0


@dataclass(frozen=True, slots=True)
class Latch:
    """Hold one event's memory."""

    armed: bool = False
    clear_s: float | None = None
    """Since when nothing of it was seen, without a break."""
    row: int = 0
    """Sightings in a row."""
    newest: int | None = None
    """Of looks, or scans."""
    untouched: bool = True
    """Nothing of it was seen since the start."""


@dataclass(frozen=True, slots=True)
class Watch:
    """Hold all that is remembered between two calls."""

    person: Latch = Latch()
    movement: Latch = Latch()
    battery_low: bool | None = None
    at_home: bool | None = None
    done: int | None = None
    failed: int | None = None


def notice(watch: Watch, facts: WorldFacts, now_s: float) -> tuple[Watch, tuple[WorldEvent, ...]]:
    """Return what is remembered from now on, and the events that begin now."""
    happened: list[WorldEvent] = []
    person, came = _latch(watch.person, facts.look, facts.person, now_s, SIGHTINGS, AWAY_S)
    if came:
        happened.append(WorldEvent.PERSON_SEEN)
    movement, stirs = _latch(watch.movement, facts.scan, facts.moves, now_s, STIRS, STILL_S)
    if stirs:
        happened.append(WorldEvent.MOVEMENT)
    low = _is_low(watch.battery_low, facts.battery)
    if low and not watch.battery_low:
        happened.append(WorldEvent.BATTERY_LOW)
    home = facts.at_home if facts.at_home is not None else watch.at_home
    if home and watch.at_home is False:
        happened.append(WorldEvent.ARRIVED_HOME)
    if watch.done is not None and facts.done > watch.done:
        happened.append(WorldEvent.GOAL_DONE)
    if watch.failed is not None and facts.failed > watch.failed:
        happened.append(WorldEvent.GOAL_FAILED)
    changed = Watch(person, movement, low, home, facts.done, facts.failed)
    return changed, tuple(happened)


def _latch(
    latch: Latch, number: int | None, there: bool, now_s: float, enough: int, away_s: float
) -> tuple[Latch, bool]:
    """Return an event's memory after a look or scan, and whether it begins now."""
    if number is None:  # nothing can be told: being away is not counted on
        return replace(latch, clear_s=None, row=0), False
    if number == latch.newest:
        return latch, False
    if not there:
        clear_s = latch.clear_s if latch.clear_s is not None else now_s
        armed = latch.armed or now_s - clear_s >= (EMPTY_S if latch.untouched else away_s)
        return Latch(armed, clear_s, 0, number, latch.untouched), False
    row = latch.row + 1
    begins = latch.armed and row >= enough
    return Latch(latch.armed and not begins, None, row, number, untouched=False), begins


def _is_low(before: bool | None, battery: float | None) -> bool | None:
    if battery is None:
        return before
    if before:
        return not battery >= HIGH
    return battery < LOW


FRESH_S = 1.0
"""A status older than this says nothing of now."""
HOME_M = 0.8
PERSON = "person"
_BY_PERSON = frozenset(
    {PauseReason.OPERATOR.value, PauseReason.STOP.value, PauseReason.TELEOP.value}
)


def hindrance(book: MissionState, now_s: float) -> str | None:
    """Return why no standing order may fire now (a stable code), or None."""
    status = book.status
    if status is None or not now_s - book.status_s <= FRESH_S:
        return BRIDGE_SILENT
    if (cause := cannot_move(status)) is not None:
        return "fault" if cause.startswith("fault") else cause
    if status.held is not None:
        return "held"
    return "paused" if _is_paused(book) else None


def _is_paused(book: MissionState) -> bool:
    """Tell whether a person paused the robot, and gave no order since."""
    missions = book.missions.values()
    paused = [m for m in missions if m.state is GoalState.PAUSED and m.reason in _BY_PERSON]
    if not paused:
        return False
    last = max(paused, key=lambda m: m.updated_unix_s)
    given = (m.created_unix_s for m in missions if m is not last and not is_of_order(m))
    return not max(given, default=float("-inf")) > last.updated_unix_s


def facts_now(
    book: MissionState, report: ObstacleReport | None, now_s: float, done: int, failed: int
) -> WorldFacts:
    """Return what the planner knows of the world now."""
    status = book.status
    fresh = status is not None and now_s - book.status_s <= FRESH_S
    sight = book.sight
    seeing = sight.blind is None and sight.look is not None
    look = sight.look if seeing else None
    still = fresh and status is not None and standing(status) and book.running is None
    scan = report if still and report is not None else None
    return WorldFacts(
        look=look.seq if look is not None else None,
        person=look is not None and any(d.label == PERSON for d in look.detections),
        scan=scan.version if scan is not None else None,
        moves=scan is not None and bool(scan.movers),
        battery=status.drive.battery if fresh and status is not None else None,
        at_home=_is_home(book) if fresh else None,
        done=done,
        failed=failed,
    )


def _is_home(book: MissionState) -> bool | None:
    status, home = book.status, book.facts.targets.get(book.facts.home)
    pose = status.base_in_map if status is not None else None
    if status is None or pose is None or home is None:
        return None
    near = hypot(pose.x_m - home.pose.x_m, pose.y_m - home.pose.y_m) <= HOME_M
    return near and standing(status)


def lacks(book: MissionState, event: WorldEvent, report: ObstacleReport | None) -> str | None:
    """Return why an event can't be noticed by this robot (a code of the problems), or None."""
    if event is WorldEvent.PERSON_SEEN and book.sight.blind in ("no_camera", "no_detector"):
        return book.sight.blind
    if event is WorldEvent.PERSON_SEEN and book.eyes.classes and PERSON not in book.eyes.classes:
        return "no_detector"
    if event is WorldEvent.MOVEMENT and report is None:
        return "no_lidar"
    gauge = book.status is not None and book.status.drive.battery is None
    return "no_gauge" if event is WorldEvent.BATTERY_LOW and gauge else None


def count_ended(
    missions: dict[str, Mission], known: frozenset[str]
) -> tuple[frozenset[str], int, int]:
    """Return the goals that have ended, and how many of persons' goals did and failed anew."""
    ended = {i: m for i, m in missions.items() if m.has_ended}
    fresh = [m for i, m in ended.items() if i not in known and not is_of_order(m) and m.steps]
    done = sum(m.state is GoalState.SUCCEEDED for m in fresh)
    failed = sum(m.state is GoalState.FAILED for m in fresh)
    return frozenset(ended), done, failed


def highest_number(missions: Iterable[Mission]) -> int:
    """Return the highest number of the standing orders that gave these goals; 0: none did.

    Tables of older programs have forgotten the numbers of removed orders; the journal hasn't.
    """
    given = (m.source.removeprefix(f"{ORDER_SOURCE}o") for m in missions if is_of_order(m))
    return max((int(number) for number in given if number.isdecimal()), default=0)
