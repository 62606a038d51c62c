"""Build the newest order that a sentence of a few words leans on."""

from __future__ import annotations

from typing import Any

from planner.brain import OfflineBrain
from planner.language.catalogue import say
from planner.language.utterance import parse
from planner.mission.events import Planned, Submitted
from planner.mission.reducer import advance
from planner.mission.skills import Eyesight
from planner.mission.state import Mission, MissionState
from planner.perception.snapshot import Sight
from planner.plan import Clarify, Code, GoalState, StepPlan
from planner.site import Site
from planner.site.site_view import facts_of
from tests.conftest import ROOT
from wire import CameraConfig

FACTS = facts_of(Site.load(ROOT / "sites" / "home"))
NOW_S = 1000.0
_EYES = Eyesight(CameraConfig(), ("person", "cup", "bottle", "chair", "backpack"))


def order_under_way(text: str, *steps: Any) -> MissionState:
    """Return the book with this order planned as these steps."""
    book = MissionState(FACTS, eyes=_EYES, sight=Sight())
    book, _ = advance(book, Submitted("g0", text, parse(text).language), NOW_S)
    return advance(book, Planned("g0", StepPlan(steps=steps)), NOW_S)[0]


def order_done(text: str, *steps: Any) -> MissionState:
    """Return the book once this order is over."""
    book = order_under_way(text, *steps)
    done = newest(book).model_copy(update={"state": GoalState.SUCCEEDED})
    return MissionState(FACTS, eyes=_EYES, sight=Sight(), missions={"g0": done}, order=1)


def order_asked_about(text: str) -> MissionState:
    """Return the book while the grammar asks what is missing in this order."""
    book = MissionState(FACTS, eyes=_EYES, sight=Sight())
    book, _ = advance(book, Submitted("g0", text, parse(text).language), NOW_S)
    asks = Clarify(code=Code.INCOMPLETE, question=say("question.yes_or_no"))
    return advance(book, Planned("g0", asks, None, OfflineBrain().tag), NOW_S)[0]


def newest(book: MissionState) -> Mission:
    """Return the newest order."""
    return max(book.missions.values(), key=lambda m: m.order)
