"""Define the messages to the bridge. Each may be late, wrong or hostile.

``seen`` is the seq of the newest ``bridge/status`` that the origin had when it made the message.
The bridge knows when it sent that status, so no sender can make a message look younger than it is.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from wire.base import Record
from wire.bounded_types import MAX_POINTS, MAX_TTL_S, Count, Epoch, Fingerprint, Name
from wire.fence import MAX_MARKS_TEXT, MAX_TEXT
from wire.geometry import Metres, Mps, Radps, Yaw

OwnerKind = Literal["planner", "external"]


class Hello(Record):
    """Ask to own the robot. Sent on each status until answered there."""

    planner_id: Name
    kind: OwnerKind
    seen: Count
    protocol: Annotated[int, Field(ge=0, le=1_000_000)]
    robot_hash: Fingerprint
    fence_hash: Fingerprint
    map_id: Fingerprint


class Grant(Record):
    """Allow one mission so much way and time. The remainder outlives epochs."""

    planner_id: Name
    epoch: Epoch
    seen: Count
    mission: Name
    metres: Annotated[float, Field(gt=0.0, le=60.0)]
    seconds: Annotated[float, Field(gt=0.0, le=600.0)]


class Waypoint(Record):
    """Give one point in ``map``, the speed to pass it at (its sign is the direction)."""

    x_m: Metres
    y_m: Metres
    speed_mps: Mps
    heading_rad: Yaw | None = None


class Waypoints(Record):
    """Stream a rolling horizon of one leg. No points: ramp to a stop, no fault."""

    planner_id: Name
    epoch: Epoch
    seq: Count
    seen: Count
    mission: Name
    leg: Count
    map_id: Fingerprint
    ttl_s: Annotated[float, Field(gt=0.0, le=MAX_TTL_S)]
    points: Annotated[tuple[Waypoint, ...], Field(max_length=MAX_POINTS)]
    final: bool
    """The last point is where the leg ends."""


class Heartbeat(Record):
    """Show that the owner lives (``seen``) and that its mission loop thinks (``used``)."""

    planner_id: Name
    epoch: Epoch
    seen: Count
    used: Count


UNREADABLE = "unreadable"
"""Id and source of a stop that can't be read: a newer shell's, or a button's with a field more."""
RELAYED = "planner:"
"""Before the source of a request that the planner passes on: who asked is then its word alone."""


def mark_relayed(source: str) -> str:
    """Return the source of a request that the planner passes on."""
    return f"{RELAYED}{source}"[:64]


class Stop(Record):
    """Stop now and hold. Anyone may say it and it is never refused, even where it can't be read.

    An id is a repeat for 5 s, and not across a resume or an arm: later it stops as a new one.
    """

    id: Name
    source: Name


class Velocity(Record):
    """Steer by hand (``cmd/teleop``) or by another brain (``cmd/external``)."""

    source_id: Name
    epoch: Epoch
    seq: Count
    seen: Count
    v_mps: Mps
    w_radps: Radps
    dead_man: bool


class VelocitySequence:
    """Number the velocities of one source: from 1 on in each epoch, as the bridge counts them."""

    def __init__(self) -> None:
        self._epoch, self._seq = "", 0

    def take_next(self, epoch: str) -> int:
        """Return the number of the next velocity in this epoch."""
        if epoch != self._epoch:
            self._epoch, self._seq = epoch, 0
        self._seq += 1
        return self._seq


OpKind = Literal["arm", "disarm", "estop", "reset", "resume"]


class Proof(Record):
    """Show that somebody with the operator's key means this request now."""

    nonce: Name
    mac: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


class OpRequest(Record):
    """Ask as the operator; the key says what for. Arm, reset and resume count only with a proof."""

    id: Name
    source: Name
    proof: Proof | None = None


class FenceRequest(Record):
    """Ask as the operator for another fence. The proof binds the fence's text by its SHA-256."""

    id: Name
    source: Name
    fence: Annotated[str, Field(min_length=2, max_length=MAX_TEXT)]
    """The whole text that is to be fence.json."""
    proof: Proof | None = None


class MarksRequest(Record):
    """Ask as the operator for other marks on the map. The proof binds their text by its SHA-256."""

    id: Name
    source: Name
    marks: Annotated[str, Field(min_length=2, max_length=MAX_MARKS_TEXT)]
    """The whole text: what it leaves out is deleted."""
    proof: Proof | None = None


class EstopLink(Record):
    """Tell the state of a wired stop button. Silence for 0.5 s counts as pressed."""

    seq: Count
    pressed: bool
