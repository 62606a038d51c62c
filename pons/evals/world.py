"""Be the world a plan is scored in: names, and a walk that writes down what the robot would do.

No robot, no map, no clock. Two plans that do the same leave the same trace, however they are cut
into steps: ``find(cup, kitchen)`` goes to the kitchen as ``go_to(kitchen)`` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from secrets import token_hex
from typing import Any

from planner.plan import (
    STANDS,
    Attempt,
    ClockTime,
    ComeBack,
    If,
    Patrol,
    Repeat,
    ReturnHome,
    StandAt,
    Step,
    StepPlan,
    Vocabulary,
    places_of,
)
from planner.site.site import Site
from planner.site.site_view import vocabulary_of

START, HOME, SOMEWHERE = "start", "home", "?"


def new_goal(suite: str) -> str:
    """Return the id of another goal: by it is counted what a model's answers to a sentence cost."""
    return f"{suite}-{token_hex(6)}"


@dataclass(frozen=True, slots=True)
class EvalWorld:
    """Hold what a suite plans against: its names, and the room the robot stands in."""

    vocabulary: Vocabulary
    room: str | None = None


@dataclass(frozen=True, slots=True)
class EvalEvent:
    """Write down one thing that a walked plan does, and where."""

    kind: str
    what: str = ""
    where: str = START
    number: float | None = None  # [m], [rad] or [s], by kind


@dataclass
class _Walk:
    here: str = START
    events: list[EvalEvent] = field(default_factory=list)

    def arrive(self, place: str) -> None:
        if place != self.here:
            self.here = place
            self.events.append(EvalEvent("at", place, place))

    def act(self, kind: str, what: str = "", number: float | None = None) -> None:
        self.events.append(EvalEvent(kind, what, self.here, number))


def walk(plan: StepPlan) -> tuple[EvalEvent, ...]:
    """Return a plan's acts, in order."""
    trace = _Walk()
    _walk(trace, plan.steps)
    return tuple(trace.events)


def _walk(trace: _Walk, steps: Sequence[Step | ClockTime]) -> None:
    for step in steps:
        if _walk_parts(trace, step):
            continue
        if isinstance(step, ComeBack | ReturnHome):
            trace.arrive(START if isinstance(step, ComeBack) else HOME)
            continue
        for place in places_of(step) if step.kind not in STANDS else ():
            if not (isinstance(step, StandAt) and step.side == "facing"):
                trace.arrive(place)
            if isinstance(step, Patrol) and step.look:
                trace.act("watch")
        if step.kind not in ("go_to", Patrol.model_fields["kind"].default):
            _act(trace, step.kind, step.model_dump())


def _walk_parts(trace: _Walk, step: Step | ClockTime) -> bool:
    """Write down what holds steps, each of its branches from where it begins; say if it does."""
    branches: tuple[tuple[str, Sequence[Step | ClockTime]], ...]
    match step:
        case If():
            trace.act("if")
            _walk(trace, (step.when,))
            branches = (("then", step.then), ("else", step.otherwise))
        case Attempt():
            trace.act("try")
            branches = (("", step.steps), ("failing", step.on_failure))
        case Repeat(until=None):
            for _ in range(step.times):
                _walk(trace, step.steps)
            return True
        case Repeat():
            trace.act("repeat", number=float(step.times))
            branches = (("", step.steps), ("until", (step.until,) if step.until else ()))
        case _:
            return False
    here = trace.here
    for name, part in branches:
        if name and (part or name == "then"):
            trace.act(name)
        trace.here = {"failing": SOMEWHERE, "until": trace.here}.get(name, here)
        _walk(trace, part)
    trace.act("end")
    trace.here = SOMEWHERE
    return True


def _act(trace: _Walk, kind: str, fields: dict[str, Any]) -> None:
    if kind == "stand_at":
        what = " ".join(part for part in (fields["side"], fields.get("object")) if part)
        where = fields.get("place") or trace.here
        trace.events.append(EvalEvent(kind, what, where, fields.get("distance_m")))
        trace.here = SOMEWHERE
        return
    if kind == "recall":
        trace.act(kind, _tell_question(fields))
        return
    said = ("object", "text", "question", "word", "time", "after", "before")
    what = next((fields[name] for name in said if fields.get(name)), "")
    number = fields.get("seconds", fields.get("angle_rad", fields.get("distance_m")))
    trace.act(kind, what, number)
    if kind in ("turn", "move", "follow", "go_to_object", "go_to_point", "explore"):
        trace.here = SOMEWHERE


def _tell_question(fields: dict[str, Any]) -> str:
    """Return what memory is asked, as a suite writes it: thing, ``@`` where, ``%`` when."""
    place, span = fields.get("place"), fields.get("span")
    parts = (fields.get("object"), place and f"@{place}", span and f"%{span}")
    return " ".join(part for part in parts if part)


def site_world(folder: Path, room: str | None = None) -> EvalWorld:
    """Return the world of a site's folder.

    Raises:
        SiteError: a file is missing or wrong.
    """
    return EvalWorld(vocabulary_of(Site.load(folder)), room)
