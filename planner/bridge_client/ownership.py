"""Write an owner's messages to the bridge: hello, grant, heartbeat, waypoints. Pure: no IO.

Told each bridge status, what the mission wants now and what it last consumed. Laws: everything
names the epoch of the status it answers, so nothing from before an epoch change is ever sent; a
sequence begins anew with each epoch; ``seen`` is the status on which this very horizon was cut.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from wire import (
    PROTOCOL,
    Grant,
    Heartbeat,
    Hello,
    Mode,
    OwnerKind,
    Record,
    Status,
    Waypoint,
    Waypoints,
)

GRANT_METRES = 60.0
GRANT_SECONDS = 600.0
TTL_S = 0.5
"""Ten statuses; the bridge's own default for CMD_STALE."""
PERIOD_S = 0.095
"""10 Hz of waypoints, less the jitter of 20 Hz statuses."""
HALTS = 3
"""Horizons of no points sent after a path, however quickly the bridge says that it holds."""


@dataclass(frozen=True, slots=True)
class Identity:
    """Name the planner that asks to own the robot, and its view of the robot."""

    planner_id: str
    robot_hash: str
    fence_hash: str
    map_id: str
    kind: OwnerKind = "planner"


@dataclass(frozen=True, slots=True)
class MotionRequest:
    """Hold the motion to ask of the bridge now. Empty: stand, and ask for nothing."""

    mission: str | None = None
    """Ask for a grant for this goal."""
    leg: int | None = None
    """Stream this leg's path; None: stand."""
    grant: str | None = None
    """The name under which the bridge meters it."""


STAND = MotionRequest()


@dataclass(frozen=True, slots=True)
class Course:
    """Hold the mission's wish now. ``points`` None: stand, and end the leg being followed."""

    mission: str | None = None
    leg: int = 0
    points: tuple[Waypoint, ...] | None = None
    final: bool = False


STANDING = Course()


@dataclass(frozen=True, slots=True)
class OwnerState:
    """Remember the messages said in this epoch."""

    epoch: str | None = None
    seq: int = 0
    sent_s: float = float("-inf")
    streamed: tuple[str, int] | None = None
    """Mission and leg of the newest path sent in this epoch."""
    halts: int = 0
    """Horizons of no points still owed."""
    granted_on: tuple[int, str] | None = None
    """Status and mission of the newest grant asked for: once a status is enough."""
    ahead_on: tuple[int, int] | None = None
    """Status and leg of the newest horizon sent right behind its grant, not yet confirmed."""


def owns(identity: Identity, status: Status) -> bool:
    """Tell whether the bridge calls us its owner."""
    return status.owner is not None and status.owner.planner_id == identity.planner_id


def on_status(
    identity: Identity, state: OwnerState, status: Status, course: Course, used: int, now_s: float
) -> tuple[OwnerState, tuple[Record, ...]]:
    """Answer one new status: hello until owner, else heartbeat, grant and horizon.

    Args:
        identity: who we are.
        state: what was said before.
        status: the newest status; everything sent is stamped with it.
        course: what the mission wants, cut on this very status.
        used: seq of the status that the mission loop last consumed.
        now_s: our monotonic clock, for the rate of waypoints only.
    """
    state = _in_epoch(state, status)
    if not owns(identity, status):
        return state, (_hello(identity, status),)
    beat = Heartbeat(planner_id=identity.planner_id, epoch=status.epoch, seen=status.seq, used=used)
    state, rest = on_course(identity, state, status, course, now_s)
    return state, (beat, *rest)


def on_course(
    identity: Identity, state: OwnerState, status: Status, course: Course, now_s: float
) -> tuple[OwnerState, tuple[Record, ...]]:
    """Return a changed course's first messages: a grant, a first horizon, or a halt."""
    state = _in_epoch(state, status)
    if not owns(identity, status):
        return state, ()
    state, grants = _grant(identity, state, status, course)
    if identity.kind == "external":  # it drives by velocity; the bridge takes no horizon of it
        return state, grants
    state, horizons = _horizon(identity, state, status, course, now_s)
    return state, (*grants, *horizons)


def _in_epoch(state: OwnerState, status: Status) -> OwnerState:
    return state if state.epoch == status.epoch else OwnerState(epoch=status.epoch)


def _hello(identity: Identity, status: Status) -> Hello:
    return Hello(
        planner_id=identity.planner_id,
        kind=identity.kind,
        seen=status.seq,
        protocol=PROTOCOL,
        robot_hash=identity.robot_hash,
        fence_hash=identity.fence_hash,
        map_id=identity.map_id,
    )


def _grant(
    identity: Identity, state: OwnerState, status: Status, course: Course
) -> tuple[OwnerState, tuple[Record, ...]]:
    mission = course.mission
    granted = status.grant is not None and status.grant.mission == mission
    if mission is None or granted or status.held is not None:
        return state, ()
    if state.granted_on == (status.seq, mission):
        return state, ()
    grant = Grant(
        planner_id=identity.planner_id,
        epoch=status.epoch,
        seen=status.seq,
        mission=mission,
        metres=GRANT_METRES,
        seconds=GRANT_SECONDS,
    )
    return replace(state, granted_on=(status.seq, mission)), (grant,)


def _horizon(
    identity: Identity, state: OwnerState, status: Status, course: Course, now_s: float
) -> tuple[OwnerState, tuple[Record, ...]]:
    """Stream the course's path under its grant; without a path, halt what is still followed.

    A grant asked for on this very status counts: the bridge hears grants before horizons, and drops
    the horizon of a grant that it refused. What was sent so is sent again when status confirms it,
    since the two travel on keys of their own and may fall on two ticks.
    """
    confirmed = status.grant.mission if status.grant is not None else None
    asked = state.granted_on
    granted = asked[1] if asked is not None and asked[0] == status.seq else confirmed
    if granted is None:
        return state, ()
    if course.points is not None and course.mission == granted:
        leg = (granted, course.leg)
        if leg == state.streamed and not now_s - state.sent_s >= PERIOD_S:
            return state, ()
        if granted == confirmed:
            state = replace(state, streamed=leg, halts=HALTS)
        elif state.ahead_on == (status.seq, course.leg):
            return state, ()
        else:
            state = replace(state, ahead_on=(status.seq, course.leg), streamed=None, halts=HALTS)
        return _send(identity, state, status, leg, course.points, course.final, now_s)
    fresh = state.halts == HALTS  # the first halt leaves at once, whatever the rate
    if not (state.halts > 0 or status.mode is Mode.ACTIVE):
        return state, ()
    if not (fresh or now_s - state.sent_s >= PERIOD_S):
        return state, ()
    known = status.leg.leg if status.leg is not None and status.leg.mission == granted else 0
    leg = state.streamed if state.streamed and state.streamed[0] == granted else (granted, known)
    state = replace(state, halts=max(0, state.halts - 1))
    return _send(identity, state, status, leg, (), False, now_s)


def _send(
    identity: Identity,
    state: OwnerState,
    status: Status,
    leg: tuple[str, int],
    points: tuple[Waypoint, ...],
    final: bool,
    now_s: float,
) -> tuple[OwnerState, tuple[Record, ...]]:
    message = Waypoints(
        planner_id=identity.planner_id,
        epoch=status.epoch,
        seq=state.seq + 1,
        seen=status.seq,
        mission=leg[0],
        leg=leg[1],
        map_id=identity.map_id,
        ttl_s=TTL_S,
        points=points,
        final=final,
    )
    return replace(state, seq=state.seq + 1, sent_s=now_s), (message,)
