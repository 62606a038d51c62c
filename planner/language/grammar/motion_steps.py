"""Make turns, straight moves and patrols of what a rule found. Counter-clockwise is positive."""

from __future__ import annotations

from math import pi
from re import Match

from pydantic import ValidationError

from planner.language.catalogue import say
from planner.language.grammar.numbers import angle_rad, metres, times
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Steps
from planner.language.grammar.place_names import go_to
from planner.language.grammar.step_builders import missing
from planner.plan import Code, GoTo, Move, Patrol, Turn

HOW_FAR = say("grammar.how_far")
_BACKWARD = ("back", "reverse", "后", "倒", "退")
_RIGHT = ("right", "clockwise", "右", "顺")
_HALF_M = 0.5


def turn(found: Match[str], reading: Reading) -> Meaning:
    """Turn by the groups `angle` and `unit`, else a quarter to a side, else about."""
    groups = found.groupdict()
    side = groups.get("side") or groups.get("side2") or ""
    if groups.get("angle"):
        angle = angle_rad(groups["angle"], groups["arc"])
    elif groups.get("whole"):
        angle = 2 * pi
    else:
        quarter = groups.get("quarter") or side
        angle = pi / 2 if quarter and not groups.get("about") else pi
    if angle is None:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    right = side.startswith(_RIGHT)
    return Steps((Turn(angle_rad=-angle if right else angle),))


def move(found: Match[str], reading: Reading) -> Meaning:
    """Move by the groups `length` and `unit`; without a length it is asked for."""
    groups = found.groupdict()
    if not groups.get("length"):
        return missing(HOW_FAR, found[0], reading)
    way = groups.get("way") or groups.get("way2") or ""
    length = metres(groups["length"], groups["unit"])
    if length is None:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    length += _HALF_M if groups.get("half") else 0.0
    try:
        backward = way.startswith(_BACKWARD)
        return Steps((Move(distance_m=-length if backward else length),))
    except ValidationError:
        return Problem(Code.BAD_PLAN, reading.marked.restore(found[0]), what=_TOO_FAR)


_TOO_FAR = say("grammar.too_far")


def turn_and_move(found: Match[str], reading: Reading) -> Meaning:
    """Turn, then move straight: "drive 2 m, 30 degrees left of straight ahead"."""
    turned, moved = turn(found, reading), move(found, reading)
    if isinstance(turned, Steps) and isinstance(moved, Steps):
        return Steps((*turned.steps, *moved.steps))
    return moved if isinstance(turned, Steps) else turned


def patrol(found: Match[str], reading: Reading) -> Meaning:
    """Visit a place of a patrol; places that follow are joined to it."""
    meaning = go_to(found["place"], reading)
    if not isinstance(meaning, Steps):
        return meaning
    places = tuple(step.place for step in meaning.steps if isinstance(step, GoTo))
    often = times(found["times"]) if found.groupdict().get("times") else 1
    return Steps((Patrol(places=places * often),))


def patrol_all(found: Match[str], reading: Reading) -> Meaning:
    """Visit every room."""
    rooms = tuple(entry.id for entry in reading.vocabulary.entries if entry.kind == "room")
    if not rooms:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Patrol(places=rooms[:20]),))


def in_all(found: Match[str], reading: Reading) -> Meaning | None:
    """Read "in every room" as the round, where it opens an order and more follows."""
    return patrol_all(found, reading) if reading.opens else None


def wander(found: Match[str], reading: Reading) -> Meaning:
    """Ask where to, where somebody wants the robot to roam or patrol no place at all."""
    return missing(WHERE, found[0], reading)


WHERE = say("grammar.which_places")
