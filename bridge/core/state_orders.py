"""Hold the core's memory of owner, grants, operator, leg, stick and an asked-for fence."""

from __future__ import annotations

from dataclasses import dataclass, replace

from bridge.core.geometry.path_profile import Path
from wire import Answer, Owner, Pose2, Waypoint, Waypoints
from wire.value import value

MAX_MISSIONS = 64
"""Remainders kept; a mission older than so many others would start anew, under the operator cap."""


@dataclass(frozen=True, slots=True)
class Ownership:
    """Remember the robot's owner, and the newest status that the owner has shown to have seen."""

    owner: Owner | None = None
    last_owner_id: str | None = None
    echo_s: float | None = None
    """When the newest echoed status was sent; outlives the loss of the owner."""
    used_s: float | None = None
    waypoints_seq: int | None = None
    external_seq: int | None = None


@dataclass(frozen=True, slots=True)
class MissionLeft:
    """Keep the budget left to one mission id; no later grant adds to it."""

    mission: str
    metres: float
    seconds: float


@value
class Grants:
    """Meter the mission granted in this epoch, and the distance since the last operator act."""

    mission: str | None = None
    metres: float = 0.0
    seconds: float = 0.0
    book: tuple[MissionLeft, ...] = ()
    """Other missions' remainders, oldest first."""
    operator_metres: float = 0.0
    operator_seconds: float = 0.0
    hand_metres: float = 0.0
    hand_seconds: float = 0.0
    """What a hand on the stick may still drive before a person acts and signs."""
    since_arm: bool = False
    """A grant was given since arming: the brain's death then disarms."""

    def return_budget(self) -> Grants:
        """Put the granted mission's remainder in the book; nothing is granted any more."""
        if self.mission is None:
            return self
        left = MissionLeft(self.mission, self.metres, self.seconds)
        book = (*(item for item in self.book if item.mission != left.mission), left)
        return replace(self, mission=None, metres=0.0, seconds=0.0, book=book[-MAX_MISSIONS:])

    def spent_part(self) -> str | None:
        """Name the budget used up while a mission is granted; None if none is."""
        if self.mission is None:
            return None
        for name, left in (
            ("mission's metres", self.metres),
            ("mission's seconds", self.seconds),
            ("operator's metres", self.operator_metres),
            ("operator's seconds", self.operator_seconds),
        ):
            if not left > 0.0:
                return name
        return None

    def spent_hand_part(self) -> str | None:
        """Name the budget that a hand on the stick has used up; None if none is."""
        if not self.hand_metres > 0.0:
            return "hand's metres"
        return None if self.hand_seconds > 0.0 else "hand's seconds"


@dataclass(frozen=True, slots=True)
class TimedAnswer:
    """Keep one verdict for as long as its request may be repeated."""

    at_s: float
    answer: Answer


@dataclass(frozen=True, slots=True)
class Operator:
    """Remember nonces and verdicts."""

    nonce_no: int = 0
    """Counts from 1; 0 before the first tick."""
    nonce_tag: str = ""
    """The chance of the tick that made it; without any, no proof counts."""
    nonce_made_s: float = 0.0
    old_nonce_no: int | None = None
    old_tag: str = ""
    old_until_s: float = 0.0
    answers: tuple[TimedAnswer, ...] = ()
    """Verdicts on requests by id: one id, one verdict."""
    accepted: tuple[str, ...] = ()
    """Ids taken under the nonces that still count: no proof works twice, whatever is forgotten."""
    refusals: tuple[TimedAnswer, ...] = ()
    """Newest refusal per sender of hello and per mission of grant; overwritten and let go."""


@dataclass(frozen=True, slots=True)
class LegMemory:
    """Remember the newest leg and the horizon that is followed."""

    mission: str | None = None
    leg: int = 0
    reached: bool = False
    goal: Waypoint | None = None
    """Where the leg ends, once a final horizon said so."""
    refusal: str | None = None
    horizon: Waypoints | None = None
    """The newest accepted, followed until it is stale."""
    path: Path | None = None
    """The horizon made ready to follow."""
    sent_s: float = 0.0
    """When the status that this horizon was cut on was sent."""

    def has_usable_horizon(self, mission: str | None, now_s: float) -> bool:
        """Tell whether a fresh horizon of the granted mission asks the robot to move."""
        return (
            self.horizon is not None
            and bool(self.horizon.points)
            and not self.reached
            and self.horizon.mission == mission
            and now_s - self.sent_s <= self.horizon.ttl_s
        )


@dataclass(frozen=True, slots=True)
class External:
    """Remember the newest velocity of an external brain."""

    v_mps: float
    w_radps: float
    dead_man: bool
    sent_s: float


@dataclass(frozen=True, slots=True)
class Stick:
    """Remember the hand on the stick; it must be seen released, then neutral, to take over."""

    released: tuple[str, ...] = ()
    """Sources seen with the dead-man released in this epoch."""
    ready: tuple[str, ...] = ()
    """Those of them then seen neutral."""
    source_id: str | None = None
    """Who holds the dead-man and may steer; nobody else does until it is released."""
    pressed_s: float | None = None
    """When anybody's dead-man was last heard pressed."""
    seq: int = -1
    v_mps: float = 0.0
    w_radps: float = 0.0
    received_s: float = 0.0
    sent_s: float = 0.0


@value
class PendingMarks:
    """Remember a request for marks whose proof held, while it is prepared and written."""

    id: str
    source: str
    text: str


@value
class Marks:
    """Remember what people drew on the map and is in force, and what is asked for."""

    text: str = ""
    """Empty: nothing is drawn."""
    hash: str | None = None
    asked: PendingMarks | None = None


@value
class PendingFence:
    """Remember a request whose proof held while nothing had torque."""

    id: str
    source: str
    text: str
    """All that is to be fence.json: what the proof binds."""
    robot_in_map: Pose2
    """Where the robot stood: a fence that leaves it outside is refused."""
    written: bool = False
    """It stands on the disk and counts from the bridge's next start."""
