"""Make steps of what a template about driving found: places, ways, waits, turns, moves and patrols.

One way for all tongues. Counter-clockwise is positive.
"""

from __future__ import annotations

import re
from dataclasses import replace
from math import copysign, pi

from pydantic import ValidationError

from planner.language.catalogue import say as message_of
from planner.language.grammar.compound_forms import read_hour
from planner.language.grammar.noun_phrases import go_to, several_of, up_to
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Reading, Steps
from planner.language.grammar.quotes import FIRST_QUOTE
from planner.language.grammar.small_talk import topic_of
from planner.language.grammar.step_builders import (
    ASIDE,
    HOW_LONG,
    WHERE_ARE_YOU,
    WHERE_TO,
    look,
    missing,
    one_at_a_time,
)
from planner.language.numbers import times
from planner.language.stop import is_stop
from planner.language.templates.template_file import TemplateFind
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
    WaitFor,
)

HOW_FAR = message_of("grammar.how_far")
_TOO_FAR = message_of("grammar.too_far")
_HOME = ("home", "家", "家里")
"""The one place of a map that has just begun: as the object of "explore", all of it."""
WHERE = message_of("grammar.which_places")


def drive_to(found: TemplateFind, reading: Reading) -> Meaning:
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


def set_out(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read "from the kitchen" as the first place, where it opens an order and more follows.

    Alone, "leave from the kitchen" orders no drive to the kitchen.
    """
    return go_to(found["place"], reading) if reading.opens else None


def drive_into(found: TemplateFind, reading: Reading) -> Meaning:
    """Read the group `place` as a room: nothing drives into a sofa."""
    meaning = go_to(found["place"], reading)
    goals = meaning.steps if isinstance(meaning, Steps) else ()
    rooms = all(
        isinstance(goal, GoTo) and reading.vocabulary.by_id[goal.place].kind == "room"
        for goal in goals
    )
    return meaning if rooms else reading.problem(Code.NOT_UNDERSTOOD, found[0])


def route(found: TemplateFind, reading: Reading) -> Meaning:
    """Read the groups `start` and `place` as two places, one after the other."""
    start, place = go_to(found["start"], reading), go_to(found["place"], reading)
    if isinstance(start, Steps) and isinstance(place, Steps):
        return Steps((*start.steps, *place.steps))
    return place if isinstance(start, Steps) else start


def next_place(found: TemplateFind, reading: Reading) -> Meaning | None:
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


def come_back(_found: TemplateFind, _reading: Reading) -> Meaning:
    """Read the way back to where the goal was accepted."""
    return Steps((ComeBack(),))


def home(_found: TemplateFind, _reading: Reading) -> Meaning:
    """Read the way to the site's home."""
    return Steps((ReturnHome(),))


def stand(_found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read "and stay there" after a go-to: arriving does that."""
    return Steps(()) if reading.going else None


def wait(found: TemplateFind, reading: Reading) -> Meaning:
    """Read a time to stand still."""
    if not found.amounts["duration"]:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    try:
        return Steps((Wait(seconds=found.amounts["duration"]),))
    except ValidationError:
        return reading.problem(Code.BAD_PLAN, found[0])


def wait_for(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read who, which word or which hour is waited for; a stop word stops, whoever says it."""
    word, time = found["word"], read_hour(found["time"]) if found["time"] else None
    if found["who"]:
        return Steps((WaitFor(object=found["who"]),))
    if word and " " not in word and len(word) <= 12 and not is_stop(word):
        return Steps((WaitFor(word=reading.marked.restore(word)),))
    return Steps((WaitFor(time=time),)) if time else None


_NOT_SAID = re.compile(
    r"(?:it|that|this|so|them)$|how (?:many|much)\b|which\b|what(?! an?\b)"
    r"|.*(?:什么|哪|几|怎么|多少|谁|啥|[吗呢]$)|一下|一说"
)
"""What names words without giving them: "say it", "say how many there are"."""


def say(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read a quotation or plain words as what is to be said."""
    if found["quote"]:
        words = reading.quotes[ord(found["quote"]) - FIRST_QUOTE].strip()
    else:
        words = reading.marked.restore(found["words"])
        if _NOT_SAID.match(words) or topic_of(words) is not None:
            return None
    if not 1 <= len(words) <= 500:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Say(text=words),))


def say_hello(_found: TemplateFind, _reading: Reading) -> Meaning:
    """Greet those who are there."""
    return Steps((Say(text="你好"),))


def say_often(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Say the same words a few times: 喊三遍开饭了."""
    said = say(found, reading)
    often = times(found["often"])
    return replace(said, steps=said.steps * often) if isinstance(said, Steps) else said


_ASKED = {
    "where_are_you": WHERE_ARE_YOU,
    "where_to": WHERE_TO,
    "how_long": HOW_LONG,
    "which_places": WHERE,
}


def ask(found: TemplateFind, reading: Reading) -> Meaning:
    """Ask back for what an order leaves open, and offer no place that it names."""
    return replace(missing(_ASKED[found["what"]], found[0], reading), places=())


def stay_at(found: TemplateFind, reading: Reading) -> Meaning:
    """Go where it is to wait, without a time: arriving does that."""
    return go_to(found["place"], reading)


_IT = frozenset({"it", "them", "它"})
_DOOR = re.compile(r"(?:the |a )?door|门")


def _only_door(phrase: str, reading: Reading) -> str | None:
    """Return the place that "the door" means, where exactly one is a door."""
    if _DOOR.fullmatch(phrase) is None:
        return None
    entries = (entry for entry in reading.vocabulary.entries if entry.kind == "place")
    doors = [e.id for e in entries if any(n.endswith((" door", "门")) for n in e.spellings)]
    return doors[0] if len(doors) == 1 else None


def stand_at(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read the groups `place`, `side` and `length` as a side of a place or thing to stand at."""
    phrase = found["place"]
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
        return Steps(
            (
                StandAt.model_validate(
                    {**aim, "side": found["side"], "distance_m": found.amounts.get("length")}
                ),
            )
        )
    except ValidationError:
        return ClauseProblem(Code.BAD_PLAN, reading.marked.restore(found[0]), what=_TOO_FAR)


_TURNS_RAD = {"left": pi / 2, "right": -pi / 2, "around": pi, "back_right": -pi, "full": 2 * pi}
_MOST_TURNED_RAD = 4 * pi


def turn(found: TemplateFind, reading: Reading) -> Meaning:
    """Turn by an amount, else a quarter to a side, half about or once round."""
    whole, angle = _TURNS_RAD[found["side"]], found.amounts.get("angle")
    if angle is not None and not angle <= _MOST_TURNED_RAD:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    turned = Turn(angle_rad=whole if angle is None else copysign(angle, whole))
    return Steps((turned,) * round(found.amounts.get("times", 1.0)))


def move(found: TemplateFind, reading: Reading) -> Meaning:
    """Move by a length; without one it is asked for."""
    length = found.amounts.get("length")
    if length is None:
        return missing(HOW_FAR, found[0], reading)
    try:
        far = -length if found["way"] == "backward" else length
        return Steps((MoveStraight(distance_m=far),))
    except ValidationError:
        return ClauseProblem(Code.BAD_PLAN, reading.marked.restore(found[0]), what=_TOO_FAR)


def turn_and_move(found: TemplateFind, reading: Reading) -> Meaning:
    """Turn, then move straight: "drive 2 m, 30 degrees left of straight ahead"."""
    turned, moved = turn(found, reading), move(found, reading)
    if isinstance(turned, Steps) and isinstance(moved, Steps):
        return Steps((*turned.steps, *moved.steps))
    return moved if isinstance(turned, Steps) else turned


def patrol(found: TemplateFind, reading: Reading) -> Meaning:
    """Visit a place of a patrol; places that follow are joined to it."""
    meaning = go_to(found["place"], reading)
    if not isinstance(meaning, Steps):
        return meaning
    places = tuple(step.place for step in meaning.steps if isinstance(step, GoTo))
    often = round(found.amounts.get("times", 1.0))
    return Steps((Patrol(places=places * often, look=_watches(found)),), seen=_watches(found))


_WATCHES = re.compile(r"\b(?:patrol|rounds?|check|inspect)\b|巡|检查|看看")


def _watches(found: TemplateFind) -> bool:
    """Tell whether a round is one to look: "patrol", and not "visit" or "drive through"."""
    return _WATCHES.search(found[0]) is not None


def patrol_all(found: TemplateFind, reading: Reading) -> Meaning:
    """Visit every room."""
    rooms = tuple(entry.id for entry in reading.vocabulary.entries if entry.kind == "room")
    if not rooms:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return Steps((Patrol(places=rooms[:20], look=_watches(found)),), seen=_watches(found))


def at_stops(_found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read "look at every stop", "tell me what you saw" behind a round that looks by itself."""
    return Steps((), seen=True) if reading.scene.toured else None


def in_all(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read "in every room" as the round, where it opens an order and more follows."""
    return patrol_all(found, reading) if reading.opens else None


def explore(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read an order to drive over what is not mapped yet, where a map is being made."""
    place = found["place"]
    whole = not place or reading.marked.restore(place) in _HOME
    return Steps((Explore(),)) if reading.maps and whole else None


def map_alone(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read an order that can only mean this: where no map is being made, it is refused."""
    return explore(found, replace(reading, maps=True))


def unread_way(found: TemplateFind, reading: Reading) -> Meaning:
    """Understand nothing of a clause, and offer no place that it names."""
    return replace(reading.problem(Code.NOT_UNDERSTOOD, found[0]), places=())
