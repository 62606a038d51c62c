"""Notice what happens around the robot: somebody comes, the battery runs low, a goal fails.

Pure: told facts and the time, answers which events begin now. Each event has a latch. It is set off
by what was seen twice in a row, and armed again only after that was gone for a while: somebody who
stays in the room comes in once. What can't be seen now (blind eyes, no battery gauge) neither sets
off nor arms anything. At the start nothing is armed, so that what is there already did not come.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from planner.plan.timing import WorldEvent

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
