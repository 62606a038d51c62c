"""Build the vocabulary of the default home, and one way to write a plan in a line."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from math import degrees

import pytest

from planner.language.grammar import Context, plan
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Ask,
    Bilingual,
    Clarify,
    Count,
    Entry,
    Find,
    Follow,
    GoTo,
    Look,
    MoveStraight,
    Patrol,
    Say,
    StepPlan,
    Turn,
    Vocabulary,
    Wait,
    places_of,
)

ROOMS = (
    ("living_room", "living room", "客厅", ("lounge", "sitting room", "起居室")),
    ("kitchen", "kitchen", "厨房", ("灶间",)),
    ("bedroom", "bedroom", "卧室", ("睡房",)),
    ("bathroom", "bathroom", "卫生间", ("toilet", "restroom", "洗手间", "浴室", "厕所")),
    ("study", "study", "书房", ("office",)),
    ("hallway", "hallway", "走廊", ("corridor", "过道")),
    ("entrance", "entrance", "玄关", ("入口", "门厅")),
)
PLACES = (
    ("sofa", "sofa", "沙发", ("couch",), "living_room"),
    ("tv", "TV", "电视", ("television", "电视机"), "living_room"),
    ("dining_table", "dining table", "餐桌", ("饭桌",), "kitchen"),
    ("fridge", "fridge", "冰箱", ("refrigerator",), "kitchen"),
    ("bed", "bed", "床", (), "bedroom"),
    ("desk", "desk", "书桌", ("桌子",), "study"),
    ("charging_dock", "charging dock", "充电桩", ("dock", "charger"), "entrance"),
    ("front_door", "front door", "大门", ("门口",), "entrance"),
)


def _home() -> Vocabulary:
    rooms = [
        Entry(id=id_, kind="room", name=Bilingual(en=en, zh=zh), aliases=aliases)
        for id_, en, zh, aliases in ROOMS
    ]
    places = [
        Entry(id=id_, kind="place", name=Bilingual(en=en, zh=zh), aliases=aliases, room=room)
        for id_, en, zh, aliases, room in PLACES
    ]
    return Vocabulary(entries=(*rooms, *places))


HOME = _home()


@pytest.fixture(scope="session")
def home() -> Vocabulary:
    """Return the default home's names."""
    return HOME


BARE = frozenset({"go_to", "come_back", "return_home", "wait", "say"})
"""What a robot can do that has no camera and neither turns nor moves on its own word."""
NOON = datetime(2030, 1, 2, 12, 0, tzinfo=UTC)


def in_short(text: str, vocabulary: Vocabulary, runnable: frozenset[str] = EVERY_KIND) -> str:
    """Return what a sentence is understood as, in one line."""
    made = plan(text, vocabulary, Context(room="study", runnable=runnable, now=NOON))
    match made:
        case StepPlan():
            return " ".join(_short(step) for step in made.steps)
        case AnswerPlan():
            return f"answer: {made.text.en}"
        case Clarify():
            return f"clarify {made.code.value}"
    return f"refuse {made.code.value}"


def _short(step: object) -> str:
    match step:
        case GoTo(place=place):
            return place
        case Wait(seconds=seconds):
            return f"wait={seconds:g}"
        case Say(text=text):
            return f"say={text}"
        case Find() | Count() | Follow() | Look():
            what = step.question if isinstance(step, Look) else step.object
            return f"{step.kind}={what}" + "".join(f"@{place}" for place in places_of(step))
        case Turn():
            return f"turn={round(degrees(step.angle_rad))}"
        case MoveStraight(distance_m=metres):
            return f"move={metres:g}"
        case Patrol(places=places):
            return f"patrol={','.join(places)}"
        case Ask(question=question):
            return f"ask={question}"
    return str(getattr(step, "kind", step))


@pytest.fixture(scope="session")
def understood() -> Callable[[str], str]:
    """Return the reader of one line per sentence."""
    return lambda text: in_short(text, HOME)


@pytest.fixture(scope="session")
def understood_bare() -> Callable[[str], str]:
    """Return the same for a robot that can only drive, wait and speak."""
    return lambda text: in_short(text, HOME, BARE)
