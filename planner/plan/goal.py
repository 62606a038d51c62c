"""Own the record of a goal as the API shows it: states, reasons, steps and the outcome.

Data only: which change of state is allowed is the mission reducer's business.
"""

from __future__ import annotations

from enum import StrEnum

from pydantic import AwareDatetime, Field

from planner.plan.base import Bilingual, Frozen, Language
from planner.plan.outcome import Code, Outcome, Spot
from planner.plan.responses import AnswerPlan, Clarify, Option, Refuse, StepPlan
from planner.plan.steps import MODELS, ClockTime, Side, Span, Step, UseSkill
from planner.plan.tree import StepNode, StepRole, list_nodes


class GoalState(StrEnum):
    """Where a goal stands."""

    QUEUED = "queued"
    PLANNING = "planning"
    AWAITING_CONFIRMATION = "awaiting_confirmation"
    NEEDS_CLARIFICATION = "needs_clarification"
    RUNNING = "running"
    PAUSED = "paused"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    REFUSED = "refused"
    CANCELLED = "cancelled"


ENDED = frozenset({GoalState.SUCCEEDED, GoalState.FAILED, GoalState.REFUSED, GoalState.CANCELLED})


class PauseReason(StrEnum):
    """Why a goal is paused; a fault is written with its row, see `fault`."""

    OPERATOR = "operator"
    STOP = "stop"
    TELEOP = "teleop"
    ESTOP = "estop"
    BUDGET = "budget"
    BLOCKED = "blocked"
    DISARMED = "disarmed"
    PLANNER_RESTARTED = "planner_restarted"


def fault(row: str) -> str:
    """Write the pause reason of a bridge row: `fault(LIDAR_STALE)`."""
    return f"fault({row})"


class StepState(StrEnum):
    """Where one step of a goal stands."""

    PENDING = "pending"
    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    SKIPPED = "skipped"


class Found(Frozen):
    """Show a thing that was seen: its kind, its point in `map` [m], how far away, how long ago."""

    label: str
    color: str | None = None
    x_m: float
    y_m: float
    sigma_m: float | None = None  # one standard deviation of where it stands
    room: str | None = None
    distance_m: float | None = None
    age_s: float | None = None


class PictureBill(Frozen):
    """Show what a search by the vision model has cost so far, and what it may cost."""

    pictures: int = Field(ge=0)  # that went out
    pictures_most: int = Field(ge=0)  # of one search
    tokens: int = Field(ge=0)  # as they were billed
    tokens_most: int = Field(ge=0)  # about so many, if all pictures go out
    money: float | None = None  # none: no price is set
    money_most: float | None = None
    currency: str | None = None


class PatrolSighting(Frozen):
    """Show what a patrol saw at one of its stops, or that there was no way to it."""

    place: str
    said: Bilingual
    shut: bool = False


class StepRecord(Frozen):
    """Show one step: its request, its state, its result and why not."""

    kind: str
    place: str | None = None
    places: tuple[str, ...] = ()
    object: str | None = None
    text: str | None = None
    seconds: float | None = None
    angle_rad: float | None = None
    distance_m: float | None = None
    span: Span | None = None  # a time that is asked about
    deeds: bool = False  # what the robot did is asked about
    state: StepState = StepState.PENDING
    reached: Spot | None = None
    residual_m: float | None = None  # distance left to the goal when the bridge said "reached"
    residual_rad: float | None = None  # angle left, likewise; by odometry for a turn
    moved_m: float | None = None  # by odometry, along the heading at the beginning of a move
    turned_rad: float | None = None  # by odometry, counter-clockwise positive
    visited: int | None = None  # places of a patrol reached so far
    look: bool = False  # a patrol looks round at each of them; a point is faced from near by
    stops: tuple[PatrolSighting, ...] = ()  # what came of each that is over
    x: int | None = None  # a point of the picture, 0 to 1000 from its left
    y: int | None = None  # and from its top
    map_id: str | None = None  # of the point below
    x_m: float | None = None  # a point of that map [m], given by a person
    y_m: float | None = None
    yaw_rad: float | None = None  # the heading to stand at there
    found: Found | None = None  # what a step that looks has found
    count: int | None = None  # how many of it
    bill: PictureBill | None = None  # what the vision model has cost this step
    rooms: tuple[str, ...] = ()  # that were looked through
    code: Code | None = None  # what a step that looks came to
    said: Bilingual | None = None  # and in words, from figures
    read: Bilingual | None = (
        None  # what a model said of the picture, or a tool: tainted, for people
    )
    answer: str | None = None  # what a person answered to this step's question
    recoveries: tuple[str, ...] = ()  # what was tried where the way was shut, in order
    left_m: float | None = None  # way left while the step runs
    left_rad: float | None = None  # angle left while it runs
    left_s: float | None = None  # time left while it runs
    reason: str | None = None
    depth: int = 0  # in how many other steps it stands
    role: StepRole | None = None  # what it is to the step that holds it
    times: int | None = None  # rounds of a repeat, at most
    round: int = 0  # of a repeat: which one runs, or was the last
    began_unix_s: float | None = None  # of a repeat: when its first round began
    holds: bool | None = None  # of a condition: what it came to; None: not asked, or can't be told
    earlier: tuple[Bilingual, ...] = ()  # of a repeat: what its rounds before this one came to
    side: Side | None = None  # of the place or thing, at which to stand
    word: str | None = None  # that is waited for
    time: str | None = None  # HH:MM that is waited for
    after: str | None = None  # HH:MM
    before: str | None = None  # HH:MM
    tool: str | None = None  # that is asked: SERVER.TOOL
    arguments: tuple[str, ...] = ()  # of the call, in the row of the tool's parameters


class PlanRecord(Frozen):
    """Show a plan of any kind in one flat shape."""

    kind: str
    steps: tuple[StepRecord, ...] = ()
    code: Code | None = None
    text: Bilingual | None = None  # the answer, the question or the reason
    options: tuple[Option, ...] = ()


class BrainTag(Frozen):
    """Name the brain that planned, with its version, and the brain it stood in for, if it did."""

    name: str
    version: str
    prompt: str | None = None  # version and hash of the prompt that a model was asked with
    fallback_from: str | None = None  # the model that should have planned
    fallback_reason: str | None = None  # stable code of why it did not
    fallback_message: Bilingual | None = None  # the same for a person


class GoalAnswer(Frozen):
    """Show a question of a goal, what a person answered, by what door, and when."""

    asked: Bilingual | None = None
    said: str | None = None  # none: a yes by a button
    by: str = "api"
    unix_s: float


class Goal(Frozen):
    """Show a goal whole: the sentence, its reading, its state, how it ended."""

    id: str
    text: str
    by: str = "api"  # who gave it, as far as that is known: the door that it came through
    stopped_by: str | None = None  # while it is paused by a stop
    answers: tuple[GoalAnswer, ...] = ()  # that it was given, oldest first; the newest 12
    language: Language
    state: GoalState
    reason: str | None = None
    plan: PlanRecord | None = None
    outcome: Outcome | None = None
    brain: BrainTag | None = None
    position: int | None = Field(default=None, ge=0)  # in the queue; 0 is next
    created: AwareDatetime
    updated: AwareDatetime


def plan_record(plan: StepPlan | AnswerPlan | Clarify | Refuse) -> PlanRecord:
    """Flatten a plan for the goal's record, every step pending."""
    match plan:
        case StepPlan():
            return PlanRecord(
                kind=plan.kind, steps=tuple(map(_step_record, list_nodes(plan.steps)))
            )
        case AnswerPlan():
            return PlanRecord(kind=plan.kind, text=plan.text)
        case Clarify():
            return PlanRecord(
                kind=plan.kind, code=plan.code, text=plan.question, options=plan.options
            )
        case Refuse():
            return PlanRecord(kind=plan.kind, code=plan.code, text=plan.reason)


_HELD = {"when", "then", "otherwise", "steps", "on_failure", "until"}
"""Fields that hold steps: each of these has a record of its own."""


def _step_record(node: StepNode) -> StepRecord:
    fields = node.step.model_dump(exclude=_HELD)
    if "question" in fields:
        fields["text"] = fields.pop("question")
    if isinstance(node.step, UseSkill):  # for showing: its own steps take its place before a walk
        fields = {"kind": node.step.kind, "text": node.step.name}
    return StepRecord.model_validate({**fields, "depth": node.depth, "role": node.role})


def step_of(record: StepRecord) -> Step:
    """Return the step that a record without held steps shows. Raises ValueError: it can't be."""
    model = MODELS[record.kind]
    fields = {name: getattr(record, name) for name in model.model_fields}
    return model.model_validate(fields)  # type: ignore[return-value]  # each model is a step


def places_of(step: Step | ClockTime | StepRecord) -> tuple[str, ...]:
    """Return the place ids that a step names."""
    place: str | None = getattr(step, "place", None)
    places: tuple[str, ...] = getattr(step, "places", ())
    return (place,) if place else places
