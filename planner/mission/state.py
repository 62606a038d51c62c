"""Own what is remembered of missions: one record each, and the state of one robot.

A ``Mission`` is what the journal keeps; it changes only at transitions. What the running step needs
between two statuses is its ``Activity``. Data only, no clock: ``*_s`` are on the caller's monotonic
clock, ``*_unix_s`` for people.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from pydantic import Field, model_validator

from planner.mission.activity import Activity
from planner.mission.recovery import FRESH, RecoveryRecord
from planner.perception.snapshot import Sight
from planner.plan import (
    ENDED,
    BrainTag,
    ChangedOrder,
    Frozen,
    GoalAnswer,
    GoalState,
    Language,
    Means,
    Outcome,
    PlanRecord,
    Step,
    StepRecord,
    StepState,
    root_of,
)
from planner.site.site_view import SiteView
from planner.skills.actions import UNSEEN
from planner.skills.perception import NO_EYES, Eyesight
from planner.skills.skill_state import SkillState
from wire import Pose2, Status

ORDER_SOURCE = "order:"
"""What the source of every goal of a standing order begins with."""
AGENT_SOURCE = "agent:"
"""What the source of every goal of an agent begins with (planner/mission/agents.py)."""
RESERVED_KEYS = "standing-order:"
"""What the Idempotency-Key of every such goal begins with, and no other request's may."""
MAX_OPEN = 33
"""Goals that have not ended: one running and 32 that wait."""
MAX_ANSWERS = 12
MAX_ENDED = 200
"""Ended goals kept at hand; the journal keeps ten times as many."""


class GivenOrder(Frozen):
    """Keep what was asked: the words or steps, from whom, and from where they were said."""

    id: str
    order: int
    """Rises with every goal given."""
    text: str
    language: Language
    changed: ChangedOrder | None = None
    """What its text makes of the order before it: "again", "no, the study"."""
    points: tuple[Step, ...] = ()
    """What it was given as, in place of words: points of the map or other steps, its whole plan."""
    source: str = "api"
    """Who gave it: a new order of the same source closes what a brain asked about older ones."""
    by: str = "api"
    """The door that it came through: shown to people, and decides nothing."""
    replace: bool = False
    first: bool = False
    """It comes in place of a goal that was taken back: nobody who waits overtakes it."""
    doubtful_stop: bool = False
    """Its sentence holds a stop word and stopped the robot before it was thought about."""
    interrupted: str | None = None
    """The goal that was paused by that stop; a correction ends it."""
    map_id: str = ""
    """The map that every pose here is on; empty in records of older programs."""
    accepted_at: tuple[float, float, float] | None = None
    """Where the robot stood when the goal was accepted: x [m], y [m], yaw [rad] in ``map``. Where
    the goal begins with coming back: when the order before it was given."""
    departed_at: tuple[float, float, float] | None = None
    """Where the robot stood when the order before was given, where that is beyond doubt."""

    @property
    def order_text(self) -> str:
        """Return the part of the text that is an order by itself."""
        return self.text if self.changed is None else self.changed.words or self.text


class Consent(Frozen):
    """Keep what people answered to a goal, and what it still waits for from them."""

    replies: tuple[str, ...] = ()
    """What the person answered to our questions, in order."""
    questions: tuple[str, ...] = ()
    """What was asked before each of them; empty where an older program kept none."""
    answers: tuple[GoalAnswer, ...] = ()
    """What people answered to any question of it; kept to be shown."""
    sure: PlanRecord | None = None
    """What the built-in brain read in the order: offered where a model's plan gets a no."""
    confirm: bool = False
    """Wait for a yes before the first step."""
    held: bool = False
    """Queued, and kept there until a person resumes or cancels it."""
    kept: bool = False
    """It is held by more than a question of the goal before it: no answer lets it go."""
    given_under_hold: str | None = None
    """The bridge's hold that stood when a person last spoke for this goal. Once a plan is made and
    accepted, that hold is cleared, and no hold that came later."""
    stopped_by: str | None = None
    """Likewise of the stop that paused it last."""
    speed_share: float = Field(default=1.0, ge=0.0, le=1.0)
    """Of the planned speeds' cap: a person said "slow down" while it ran."""
    grants: int = Field(default=0, ge=0)
    """Longer searches that a person said yes to: each is a grant of the bridge's of its own."""


class Planning(Frozen):
    """Keep the plan that was made of an order, and the thoughts spent on it."""

    plan: PlanRecord | None = None
    brain: BrainTag | None = None
    tried: tuple[str, ...] = ()
    """Fingerprints of the plans that were taken: the same again leads nowhere."""
    replans: int = 0
    """Thoughts spent on steps that failed."""
    decides: int = 0
    """Thoughts spent on ``decide`` steps."""
    failure: Outcome | None = None
    """Why a step failed, while a new plan is thought about or the robot drives back after it."""

    @property
    def steps(self) -> tuple[StepRecord, ...]:
        return self.plan.steps if self.plan is not None else ()


class Progress(Frozen):
    """Keep how far a goal has come: of its plan, of its current step, and on the floor."""

    step: int = 0
    part: int = 0
    """Legs of the current step that were reached: what was done of it is not done again."""
    began_at: tuple[float, float, float] | None = None
    """Where the robot stood when the current step began: x [m], y [m], yaw [rad] in ``map``."""
    done: float = 0.0
    """What odometry says was done of the current step: radians of a turn, else metres ahead."""
    skill_state: SkillState | None = None
    """What the skill of the current step remembers; None: nothing yet, or it never does."""
    recovery: RecoveryRecord = FRESH
    """What the current step has tried where its way was shut, and what stood there."""
    step_s: float = 0.0
    """Time for which the current step was worked on."""
    step_m: float = 0.0
    """What was driven for it."""
    leg: int = 0
    """The newest leg of this mission; legs only rise."""
    metres: float = 0.0
    granted_at_m: float = 0.0
    """What was driven for the goal before the grant that holds now."""
    limited: dict[str, int] = Field(default_factory=dict)
    """Statuses during which the bridge's limit of that name was the nearest one."""


class Mission(GivenOrder, Consent, Planning, Progress):
    """Keep one goal whole: enough to show it, and to take it up again after a crash.

    Each idea is a record, which is all that many a function takes; the journal keeps them as one.
    """

    state: GoalState
    reason: str | None = None
    outcome: Outcome | None = None
    created_unix_s: float
    updated_unix_s: float

    @model_validator(mode="before")
    @classmethod
    def _read_meaning(cls, record: Any) -> Any:
        """Read the sentence that a former program wrote in place of what was said."""
        if isinstance(record, dict) and "meant" in record:
            kept = {name: value for name, value in record.items() if name != "meant"}
            return {**kept, "changed": {"words": record["meant"]} if record["meant"] else None}
        return record

    @model_validator(mode="after")
    def _remembers_its_own_step(self) -> Mission:
        state, step = self.skill_state, self.current_step
        if state is not None and (step is None or step.kind != state.kind):
            raise ValueError(
                f"the current step is {step and step.kind!r}, its state {state.kind!r}"
            )
        return self

    @property
    def has_ended(self) -> bool:
        return self.state in ENDED

    @property
    def words(self) -> str:
        """Return the newest thing that the person said about this goal, to be understood."""
        return self.replies[-1] if self.replies else self.text

    @property
    def grant_name(self) -> str:
        """Return the name under which the bridge meters what the goal drives now."""
        return self.id if self.grants == 0 else f"{self.id}.{self.grants}"

    @property
    def current_step(self) -> StepRecord | None:
        """Return the current step; None before the plan and after its last step."""
        return self.steps[self.step] if self.step < len(self.steps) else None

    @property
    def asks(self) -> bool:
        """Tell whether the current step is a question to a person; it may be answered already."""
        return self.current_step is not None and self.current_step.kind == "ask"

    @property
    def steps_ahead(self) -> tuple[StepRecord, ...]:
        """Return the steps that may still be done: those of a round that may come again, too."""
        if self.step >= len(self.steps):
            return ()
        return self.steps[root_of(self.steps, self.step) :]

    @property
    def returning(self) -> bool:
        """Tell whether the goal has failed, and only its way back is left."""
        failed = self.current_step is not None and self.current_step.state is StepState.FAILED
        return self.failure is not None and not failed

    @property
    def has_begun(self) -> bool:
        """Tell whether any step was begun: from then on the goal keeps its place at the front."""
        return self.step > 0 or (
            self.current_step is not None and self.current_step.state is not StepState.PENDING
        )


@dataclass(frozen=True, slots=True)
class GoalKey:
    """Remember which request an Idempotency-Key came with, and the goal that it made."""

    key: str
    body: str
    """Fingerprint of the request."""
    goal: str


@dataclass(frozen=True, slots=True)
class Rules:
    """Bound what a mission may do by itself. Data, from the owner's settings."""

    replans: int = 2
    """New plans for a goal whose step failed; then it fails."""
    decides: int = 3
    """Times that a goal may think again because its plan says so."""
    answer_s: float = 600.0
    """How long an answer to a question of any kind is waited for, standing."""


@dataclass(frozen=True, slots=True)
class MissionState:
    """Hold all missions of one robot. Frozen; dictionaries in it are replaced, never changed."""

    facts: SiteView
    rules: Rules = Rules()
    nav2: bool = False
    """Nav2 drives the legs: it searches the ways, and its recoveries are its own."""
    local_offset_s: float = 0.0
    """Of people's own clock from UTC."""
    wall_offset_s: float = 0.0
    """Unix time less the monotonic clock that ``now_s`` is on."""
    missions: dict[str, Mission] = field(default_factory=dict)
    queue: tuple[str, ...] = ()
    running: str | None = None
    activity: Activity | None = None
    """What the running goal does now; dies with the process."""
    status: Status | None = None
    status_s: float = float("-inf")
    eyes: Eyesight = NO_EYES
    sight: Sight = UNSEEN
    pardoned: str | None = None
    """The bridge's hold that stood when a person last acted; it is given time to clear."""
    pardon_until_s: float = float("-inf")
    asked_s: dict[str, float] = field(default_factory=dict)
    """Since when each goal waits for a person's word."""
    order: int = 0
    tickets: int = 0
    written: int = 0
    """Journal entries asked for."""
    safe: int = 0
    """Journal entries known to be on disk."""

    @property
    def pose(self) -> Pose2 | None:
        """Return the robot in ``map``, as the newest status says."""
        return self.status.base_in_map if self.status is not None else None

    @property
    def running_goal(self) -> Mission | None:
        """Return the mission that has the robot, or None."""
        return self.missions.get(self.running or "")

    def goals_in(self, *states: GoalState, besides: str | None = None) -> list[Mission]:
        """Return the goals in these states besides one, as they were given: the oldest first."""
        found = (m for m in self.missions.values() if m.state in states and m.id != besides)
        return sorted(found, key=lambda m: m.order)

    @property
    def means(self) -> Means:
        """Return the robot's means besides driving and talking, as its eyes are now."""
        return self.eyes.means(self.sight.blind, grows=self.facts.grows)


def newest_paused(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that was paused last, besides the one that asks; None: none is."""
    paused = book.goals_in(GoalState.PAUSED, besides=asking)
    newest = max(paused, key=lambda m: (m.updated_unix_s, m.order), default=None)
    return newest.id if newest is not None else None


_OPEN = (
    GoalState.PLANNING,
    GoalState.NEEDS_CLARIFICATION,
    GoalState.AWAITING_CONFIRMATION,
    GoalState.PAUSED,
    GoalState.QUEUED,
)


def goal_to_end(book: MissionState, asking: str | None = None) -> str | None:
    """Return the goal that a person means by "that": the running one, else the newest open one."""
    if book.running is not None:
        return book.running
    for state in _OPEN:
        if found := book.goals_in(state, besides=asking):
            return found[-1].id
    return None
