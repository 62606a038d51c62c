"""Make steps of what a rule about driving found: places, ways, waits, turns, moves and patrols.

One way for all tongues. Counter-clockwise is positive.
"""

from __future__ import annotations

import re
from dataclasses import replace
from math import pi
from re import Match

from pydantic import ValidationError

from planner.language.catalogue import say as message_of
from planner.language.grammar.clauses import FIRST_QUOTE
from planner.language.grammar.noun_phrases import go_to, several_of, up_to
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Reading, Steps
from planner.language.grammar.step_builders import ASIDE, look, missing, one_at_a_time
from planner.language.numbers import angle_rad, metres, seconds, times
from planner.plan import (
    Code,
    ComeBack,
    Explore,
    GoTo,
    MoveStraight,
    Patrol,
    ReturnHome,
    Say,
    StandAt,
    Turn,
    Wait,
)

HOW_FAR = message_of("grammar.how_far")
_BACKWARD = ("back", "reverse", "后", "倒", "退")
_RIGHT = ("right", "clockwise", "右", "顺")
_HALF_M = 0.5
_TOO_FAR = message_of("grammar.too_far")
_HOME = ("home", "家", "家里")
"""The one place of a map that has just begun: as the object of "explore", all of it."""
WHERE = message_of("grammar.which_places")


def drive_to(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `place` as a place to drive to, or as a thing to drive up to."""
    meaning = go_to(found["place"], reading)
    if isinstance(meaning, Steps):
        return meaning
    if ASIDE.search(found["place"]):
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    many = several_of(found["place"], reading)
    if many is not None:
        return one_at_a_time(many[0], many[1], reading)
    return up_to(found["place"], reading) or meaning


def set_out(found: Match[str], reading: Reading) -> Meaning | None:
    """Read "from the kitchen" as the first place, where it opens an order and more follows.

    Alone, "leave from the kitchen" orders no drive to the kitchen.
    """
    return go_to(found["place"], reading) if reading.opens else None


def drive_into(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `place` as a room: nothing drives into a sofa."""
    meaning = go_to(found["place"], reading)
    goals = meaning.steps if isinstance(meaning, Steps) else ()
    rooms = all(
        isinstance(goal, GoTo) and reading.vocabulary.by_id[goal.place].kind == "room"
        for goal in goals
    )
    return meaning if rooms else reading.problem(Code.NOT_UNDERSTOOD, found[0])


def route(found: Match[str], reading: Reading) -> Meaning:
    """Read the groups `start` and `place` as two places, one after the other."""
    start, place = go_to(found["start"], reading), go_to(found["place"], reading)
    if isinstance(start, Steps) and isinstance(place, Steps):
        return Steps((*start.steps, *place.steps))
    return place if isinstance(start, Steps) else start


def next_place(found: Match[str], reading: Reading) -> Meaning | None:
    """Read a bare place after a go-to clause as the next place; elsewhere offer it."""
    phrase = found["place"]
    meaning = go_to(phrase, reading)
    again = re.match(r"(?:back )?(?:to|into) ", phrase)
    if again and reading.going:
        return go_to(phrase[again.end() :], reading)
    if reading.scene.kind == "look" and isinstance(meaning, Steps):
        return look(phrase, phrase, reading)
    if reading.going and isinstance(meaning, Steps):
        goals = tuple(step.place for step in meaning.steps if isinstance(step, GoTo))
        patrols = reading.scene.kind == "patrol" and goals
        return Steps((Patrol(places=goals, look=reading.scene.toured),)) if patrols else meaning
    named = reading.going and phrase.startswith(("the ", "my ", "our "))
    return meaning if named else None


def come_back(_found: Match[str], _reading: Reading) -> Meaning:
    """Read the way back to where the goal was accepted."""
    return Steps((ComeBack(),))


def home(_found: Match[str], _reading: Reading) -> Meaning:
    """Read the way to the site's home."""
    return Steps((ReturnHome(),))


def stand(_found: Match[str], reading: Reading) -> Meaning | None:
    """Read "and stay there" after a go-to: arriving does that."""
    return Steps(()) if reading.going else None


def wait(found: Match[str], reading: Reading) -> Meaning:
    """Read the groups `number` and `unit` as a time to stand still."""
    span_s = seconds(found["number"], found["unit"])
    if not span_s:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    try:
        return Steps((Wait(seconds=span_s),))
    except ValidationError:
        return reading.problem(Code.BAD_PLAN, found[0])


def say(found: Match[str], reading: Reading) -> Meaning:
    """Read the group `quote` or `words` as words to say."""
    groups = found.groupdict()
    if groups.get("quote"):
        words = reading.quotes[ord(found["quote"]) - FIRST_QUOTE].strip()
    else:
        words = reading.marked.restore(found["words"])
    if not 1 <= len(words) <= 500:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Say(text=words),))


def say_often(found: Match[str], reading: Reading) -> Meaning:
    """Say the same words a few times: 喊三遍开饭了."""
    said = say(found, reading)
    often = times(found["often"])
    return replace(said, steps=said.steps * often) if isinstance(said, Steps) else said


_STANDS = {
    "before": re.compile(r"before|in front|opposite|away|from|前|对面|离"),
    "behind": re.compile(r"behind|back of|other side|后"),
    "facing": re.compile(r"fac|look|turn|toward|面|朝|对|向"),
}
_IT = frozenset({"it", "them", "它"})
_DOOR = re.compile(r"(?:the |a )?door|门")


def _only_door(phrase: str, reading: Reading) -> str | None:
    """Return the place that "the door" means, where exactly one is a door."""
    if _DOOR.fullmatch(phrase) is None:
        return None
    entries = (entry for entry in reading.vocabulary.entries if entry.kind == "place")
    doors = [e.id for e in entries if any(n.endswith((" door", "门")) for n in e.spellings)]
    return doors[0] if len(doors) == 1 else None


def stand_at(found: Match[str], reading: Reading) -> Meaning | None:
    """Read the groups `place`, `side` and `length` as a side of a place or thing to stand at."""
    groups = found.groupdict()
    side = groups.get("side") or groups.get("side2") or ""
    which = next((name for name, words in _STANDS.items() if words.search(side)), "beside")
    length = groups.get("length")
    far_m = metres(length, groups["unit"]) if length else None
    if length and far_m is None:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    if far_m is not None and groups.get("half"):
        far_m += _HALF_M
    phrase = groups["place"]
    there = reading.scene.place if phrase in _IT else _only_door(phrase, reading)
    goal = Steps((GoTo(place=there),)) if there is not None else go_to(phrase, reading)
    step = goal.steps[0] if isinstance(goal, Steps) else None
    if isinstance(step, GoTo):
        if reading.vocabulary.by_id[step.place].kind == "room":
            return reading.problem(Code.NOT_UNDERSTOOD, found[0])
        aim = {"place": step.place}
    else:
        thing = up_to(phrase, reading)
        if thing is None or thing.thing is None:
            return goal
        aim = {"object": thing.thing}
    try:
        return Steps((StandAt.model_validate({**aim, "side": which, "distance_m": far_m}),))
    except ValidationError:
        return ClauseProblem(Code.BAD_PLAN, reading.marked.restore(found[0]), what=_TOO_FAR)


def turn(found: Match[str], reading: Reading) -> Meaning:
    """Turn by the groups `angle` and `unit`, by `turns`, else a quarter to a side, else about."""
    groups = found.groupdict()
    side = groups.get("side") or groups.get("side2") or ""
    if groups.get("angle"):
        angle = angle_rad(groups["angle"], groups["arc"])
    elif groups.get("turns"):
        return Steps((Turn(angle_rad=2 * pi),) * times(groups["turns"]))
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
        return Steps((MoveStraight(distance_m=-length if backward else length),))
    except ValidationError:
        return ClauseProblem(Code.BAD_PLAN, reading.marked.restore(found[0]), what=_TOO_FAR)


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
    return Steps((Patrol(places=places * often, look=_watches(found)),), seen=_watches(found))


_WATCHES = re.compile(r"\b(?:patrol|rounds?|check|inspect)\b|巡|检查|看看")


def _watches(found: Match[str]) -> bool:
    """Tell whether a round is one to look: "patrol", and not "visit" or "drive through"."""
    return _WATCHES.search(found[0]) is not None


def patrol_all(found: Match[str], reading: Reading) -> Meaning:
    """Visit every room."""
    rooms = tuple(entry.id for entry in reading.vocabulary.entries if entry.kind == "room")
    if not rooms:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Patrol(places=rooms[:20], look=_watches(found)),), seen=_watches(found))


def at_stops(_found: Match[str], reading: Reading) -> Meaning | None:
    """Read "look at every stop", "tell me what you saw" behind a round that looks by itself."""
    return Steps((), seen=True) if reading.scene.toured else None


def in_all(found: Match[str], reading: Reading) -> Meaning | None:
    """Read "in every room" as the round, where it opens an order and more follows."""
    return patrol_all(found, reading) if reading.opens else None


def explore(found: Match[str], reading: Reading) -> Meaning | None:
    """Read an order to drive over what is not mapped yet, where a map is being made."""
    place = found.groupdict().get("place")
    whole = place is None or reading.marked.restore(place) in _HOME
    return Steps((Explore(),)) if reading.maps and whole else None


def map_alone(found: Match[str], reading: Reading) -> Meaning | None:
    """Read an order that can only mean this: where no map is being made, it is refused."""
    return explore(found, replace(reading, maps=True))


def wander(found: Match[str], reading: Reading) -> Meaning:
    """Ask where to, where somebody wants the robot to roam or patrol no place at all."""
    return missing(WHERE, found[0], reading)
