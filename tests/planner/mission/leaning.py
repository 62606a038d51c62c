"""Build the newest order that a sentence leans on, and say what the sentence makes of it."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Any, TypeVar

from planner.brain import OfflineBrain, ThinkRequest
from planner.language.catalogue import say
from planner.language.object_names import known_words
from planner.language.sentence import parse
from planner.mission.events import Planned, Submitted
from planner.mission.follow_up import lean_of
from planner.mission.reception import Reception, receive
from planner.mission.reducer import advance
from planner.mission.state import Mission, MissionState
from planner.perception.snapshot import Sight
from planner.plan import ChangedOrder, Clarify, Code, GoalState, GoTo, Means, Plan, StepPlan
from planner.site import Site
from planner.site.site_view import facts_of, vocabulary_of
from planner.skills import Eyesight
from tests.conftest import ROOT
from wire import CameraConfig

SITE = Site.load(ROOT / "sites" / "home")
FACTS = facts_of(SITE)
NAMES = FACTS.names
NOW_S = 1000.0
_CLASSES = ("person", "cup", "bottle", "chair", "backpack", "book", "ball", "cat")
_EYES = Eyesight(CameraConfig(), _CLASSES)
Before = TypeVar("Before")
"""What a sentence is said after: a book, or the last step of one."""
INCOMPLETE = Clarify(code=Code.INCOMPLETE, question=say("question.yes_or_no"))
_MEANS = Means(camera=True, detector=True)


def order_under_way(text: str, *steps: Any) -> MissionState:
    """Return the book with this order planned as these steps, else as the built-in brain does."""
    book = MissionState(FACTS, eyes=_EYES, sight=Sight())
    book, _ = advance(book, Submitted("g0", text, parse(text).language), NOW_S)
    plan = StepPlan(steps=steps) if steps else plan_of(text)
    return advance(book, Planned("g0", plan), NOW_S)[0]


def order_running(text: str, *steps: Any) -> MissionState:
    """Return the book while the robot is at this order."""
    book = order_under_way(text, *steps)
    runs = newest(book).model_copy(update={"state": GoalState.RUNNING})
    return replace(book, missions={"g0": runs}, running="g0")


def drive_under_way(text: str, place: str) -> MissionState:
    """Return the book of a planner without eyes, this order planned as a drive to a place."""
    book, _ = advance(MissionState(FACTS), Submitted("g0", text, parse(text).language), NOW_S)
    return advance(book, Planned("g0", StepPlan(steps=(GoTo(place=place),))), NOW_S)[0]


def order_done(text: str, *steps: Any) -> MissionState:
    """Return the book once this order is over."""
    book = order_under_way(text, *steps)
    done = newest(book).model_copy(update={"state": GoalState.SUCCEEDED})
    return MissionState(FACTS, eyes=_EYES, sight=Sight(), missions={"g0": done}, order=1)


def order_asked_about(text: str, asks: Clarify = INCOMPLETE) -> MissionState:
    """Return the book while the grammar asks this about an order."""
    book = MissionState(FACTS, eyes=_EYES, sight=Sight())
    book, _ = advance(book, Submitted("g0", text, parse(text).language), NOW_S)
    return advance(book, Planned("g0", asks, None, OfflineBrain().tag), NOW_S)[0]


def newest(book: MissionState) -> Mission:
    """Return the newest order."""
    return max(book.missions.values(), key=lambda m: m.order)


def each(
    before: Before, order: str | None, *sayings: str
) -> tuple[tuple[Before, str, str | None], ...]:
    """Return rows of a table in which all these sentences come to one order."""
    return tuple((before, said, order) for said in sayings)


def changed_by(book: MissionState, said: str, later_s: float = 0.0) -> ChangedOrder | None:
    """Return what a sentence makes of the newest order; None where it changes nothing."""
    lean = lean_of(book, parse(said), NOW_S + later_s)
    return lean.changed if lean is not None else None


def plan_of(text: str, changed: ChangedOrder | None = None) -> Plan:
    """Return the built-in brain's plan of a sentence."""
    request = ThinkRequest(
        text=text,
        vocabulary=vocabulary_of(SITE),
        runnable=_MEANS.plannable,
        blind=_MEANS.blind,
        things=known_words(_CLASSES),
        changed=changed,
    )
    return asyncio.run(OfflineBrain().think(request)).plan


def means(book: MissionState, said: str, order: str | None) -> bool:
    """Tell whether a sentence comes to an order that leans on nothing; None: changes nothing."""
    changed = changed_by(book, said)
    if changed is None:
        return order is None
    return order is not None and plan_of(said, changed) == plan_of(order)


def steps_after(book: MissionState, said: str) -> tuple[Any, ...]:
    """Return the steps that a sentence makes of what runs."""
    changed = changed_by(book, said)
    return changed.steps if changed is not None else ()


def heard(book: MissionState, said: str) -> Reception:
    """Return what a sentence is to the missions."""
    return receive(book, parse(said), Submitted("new", said, parse(said).language), NOW_S)
