"""Say what a plan that is driven in the simulator is given, and what comes of it. Data only.

Both ends know these: the planner, which asks, and the process that drives (``lockstep``).
"""

from __future__ import annotations

from enum import StrEnum
from typing import Literal

from planner.plan import Bilingual, PlanRecord, StepRecord
from planner.plan.base import Frozen
from planner.rehearsal import Rehearsal
from planner.site.places import Place
from wire import MarksFile, Pose2, RobotDescription

MODULE = "lockstep.rehearsal_process"
"""What drives; started by name, so that a robot that never rehearses loads nothing of it."""
LONGEST_S = 1_800.0
"""Of simulated time: an hour's round is shown by its first half hour."""
LONGEST_WAIT_S = 5.0
"""That is waited for in the simulator; of a longer wait the rest is added up."""


class LeftOut(StrEnum):
    """Name what a drive in the simulator leaves out, so that nobody takes it for known."""

    LOCALIZATION = "localization"
    """The robot knows where it is, but for a little noise."""
    PEOPLE_STAND = "people_stand"
    """Who was seen stands there; nobody walks, and nobody comes."""
    PICTURES = "pictures"
    """What it would see, hear or remember: such steps are passed over."""
    BRANCHES = "branches"
    """Each condition is taken to hold."""
    ROUNDS = "rounds"
    """What repeats is driven once."""
    WAITS = "waits"
    """Long waits are counted, and not waited for."""
    NAV2 = "nav2"
    """Nav2 drives this robot; here our own way of driving does."""


class DriveRequest(Frozen):
    """Ask for a plan's steps to be driven: from where, among what."""

    site: str
    """The site's folder."""
    robot: RobotDescription
    begins: Pose2
    rows: tuple[tuple[int, StepRecord], ...]
    """The steps to drive, each with its index in the plan."""
    places: tuple[Place, ...] = ()
    """That people taught, beside the site's own."""
    marks: MarksFile | None = None
    discs: tuple[tuple[float, float, float], ...] = ()
    """x, y, radius in ``map`` [m] of people as they were seen last."""
    cells_bytes: int = 0
    """Of the body: cells that hold something; behind them, those where something may stand."""
    limit_s: float = LONGEST_S
    """Of simulated time."""


class DrivenStep(Frozen):
    """Show what came of one step of the plan."""

    index: int
    """In the plan's row of steps."""
    kind: str
    place: str | None = None
    name: Bilingual | None = None
    branch: bool = False
    outcome: Literal["pending", "running", "succeeded", "failed", "stuck", "left_out"]
    """``stuck``: it neither ended nor went on."""
    length_m: float = 0.0
    seconds: float = 0.0
    nearest_m: float | None = None
    """From the robot's rim to the nearest thing, at the nearest."""
    nearest_at: tuple[float, float] | None = None
    """Where the robot was then, in ``map`` [m]."""
    contacts: int = 0
    rows: tuple[str, ...] = ()
    """Of the bridge's rules that bound it, in the order in which they came."""
    end: Pose2 | None = None
    code: str | None = None
    message: Bilingual | None = None


class DrivenPlan(Frozen):
    """Show a plan as it was driven so far."""

    steps: tuple[DrivenStep, ...] = ()
    trail: tuple[tuple[float, float], ...] = ()
    """Where the robot was, in ``map`` [m]."""
    at: Pose2 | None = None
    length_m: float = 0.0
    seconds: float = 0.0
    """On the simulated clock."""
    contacts: int = 0
    nearest_m: float | None = None


class DrivenRehearsal(Frozen):
    """Show a rehearsal that is driven in the simulator, while it runs and when it is over."""

    id: str
    state: Literal["running", "done", "cancelled", "failed"]
    map_id: str
    begins: Pose2
    shown: Rehearsal
    """What the route search foretold of the same plan."""
    driven: DrivenPlan = DrivenPlan()
    left_out: tuple[LeftOut, ...] = ()
    took_s: float = 0.0
    """Of real time, the start of its process too."""
    code: str | None = None
    """Why it failed."""
    message: Bilingual | None = None
    times_faster: float | None = None
    """Simulated over real time."""


def steps_to_drive(plan: PlanRecord, shown: Rehearsal) -> tuple[tuple[int, StepRecord], ...]:
    """Return the steps of a plan that can be driven without eyes, each with its index."""
    known = (step for step in shown.steps if step.does != "open" and not step.instead)
    return tuple((step.index, plan.steps[step.index]) for step in known)


def left_out(plan: PlanRecord, shown: Rehearsal, *, nav2: bool) -> tuple[LeftOut, ...]:
    """Return what the drive of a plan leaves out."""
    kinds = {row.kind for row in plan.steps}
    found = {
        LeftOut.PICTURES: any(step.does == "open" for step in shown.steps),
        LeftOut.BRANCHES: "if" in kinds,
        LeftOut.ROUNDS: "repeat" in kinds,
        LeftOut.WAITS: any(
            row.kind == "wait" and (row.seconds or 0.0) > LONGEST_WAIT_S for row in plan.steps
        ),
        LeftOut.NAV2: nav2,
    }
    return (
        LeftOut.LOCALIZATION,
        LeftOut.PEOPLE_STAND,
        *(what for what, is_so in found.items() if is_so),
    )
