"""Own the robot's answers without looking: itself, the clock, a joke, and its limits.

How each language asks for a topic stands in ``templates/topics.toml``. No network, no model.
"""

from __future__ import annotations

import re
import tomllib
from datetime import datetime
from enum import Enum
from pathlib import Path

from planner.language.catalogue import say
from planner.plan import Bilingual


class Topic(Enum):
    """Name what a person may ask the robot to tell."""

    WHERE = "where"
    PLACES = "places"
    HELP = "help"
    HELLO = "hello"
    THANKS = "thanks"
    BYE = "bye"
    NAME = "name"
    SELF = "self"
    TEAM = "team"
    MAKER = "maker"
    AGE = "age"
    MOOD = "mood"
    JOKE = "joke"
    TIME = "time"
    DAY = "day"
    MONTH_DAY = "month_day"
    WEATHER = "weather"
    FACES = "faces"
    LANGUAGES = "languages"
    HANDS = "hands"


_OURS = Path(__file__).parents[1] / "templates" / "topics.toml"
_TABLE = tomllib.loads(_OURS.read_text(encoding="utf-8"))
_CLOCK = (Topic.TIME, Topic.DAY, Topic.MONTH_DAY)
_OF_ITSELF = frozenset({Topic.HELP, Topic.FACES, Topic.LANGUAGES, Topic.HANDS, Topic.NAME})
"""What may be asked beside a word about the person who asks."""
_NO_CLOCK = say("talk.no_clock")


def _whole(rows: dict[str, list[str]]) -> re.Pattern[str]:
    return re.compile("|".join(f"(?P<{topic}>{'|'.join(row)})" for topic, row in rows.items()))


CLAUSES = tuple(_whole(_TABLE["clause"][language]) for language in ("en", "zh"))
"""What a whole clause asks or says, tried before what may be told in a phrase of it."""
_EN_TOPIC, _ZH_TOPIC = (_whole(_TABLE["phrase"][language]) for language in ("en", "zh"))


_ASKED = re.compile(
    r"^(?:what is|what are|check|do you (?:know|have)|have you got|"
    r"(?:do you )?(?:want to )?tell me|"
    r"tell us|"
    r"i want to know|can you tell me|any|i would like to (?:know|hear)) "
)


_CUT = re.compile(r"\s*[?.!,;:。？！，；]+\s*")
_OPENS = re.compile(r"^(?:(?:so|well|and|but|ok|okay|then|hey|oh|right|那么?|哎|诶|喂)[ ,]*)+")
_ASIDE = re.compile(
    r"(?:i(?:'m| am|'ve| have)?|we(?:'re| are|'ve| have)?|my|it's just|just) (?!.*\b(?:go|come"
    r"|find|look|tell|want you|need you)\b)"
    r"[a-z' ]{3,60}|我(?!要|想让|叫|让)[^去来找看]{1,12}"
)
"""What a person adds of themselves: "I'm just staying the weekend"."""


def topic_of(words: str) -> Topic | None:
    """Return the topic that a phrase, or all clauses of a sentence that ask, name."""
    whole = _topic_of_clause(words) or _topic_of_clause(_OPENS.sub("", words))
    if whole is not None:
        return whole
    clauses = [each for each in _CUT.split(words) if each]
    asked = [_topic_of_clause(_OPENS.sub("", each)) for each in clauses]
    topics = {topic for topic in asked if topic is not None}
    rest = [c for c, topic in zip(clauses, asked, strict=True) if topic is None]
    plain = len(topics) == 1 and len(clauses) <= 3 and all(_ASIDE.fullmatch(c) for c in rest)
    return topics.pop() if plain and topics <= _OF_ITSELF else None


def _topic_of_clause(words: str) -> Topic | None:
    plain = _ASKED.sub("", words)
    found = _EN_TOPIC.fullmatch(words) or _EN_TOPIC.fullmatch(plain) or _ZH_TOPIC.fullmatch(words)
    return Topic(found.lastgroup) if found and found.lastgroup else None


def answer_topic(topic: Topic, now: datetime | None) -> Bilingual | None:
    """Return the text on a topic, or None where that takes more than a table."""
    if topic in _CLOCK:
        return _NO_CLOCK if now is None else _clock(topic, now)
    if topic in (Topic.WHERE, Topic.PLACES):
        return None
    return say(f"talk.{topic.value}")


def _clock(topic: Topic, now: datetime) -> Bilingual:
    if topic is Topic.TIME:
        at = f"{now:%H:%M}"
        return say("talk.time", at=at)
    if topic is Topic.DAY:
        return say(f"talk.day_{now.weekday()}")
    return say("talk.month_day", year=now.year, month=now.month, day=now.day)
