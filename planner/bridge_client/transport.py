"""Hold the planner's ends of the wire, both ways. No thread, no decision.

Every read is a non-blocking drain of a ring and every send drops rather than waits, so that the
event loop may do both.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from wire import (
    Event,
    FenceRequest,
    Grant,
    Heartbeat,
    Hello,
    Localization,
    LocalizerStatus,
    MarksRequest,
    Nav2Goal,
    Nav2State,
    Odometry,
    OpKind,
    OpRequest,
    PoseHint,
    Record,
    Scan,
    Status,
    Stop,
    TrialOrder,
    TrialState,
    Velocity,
    Waypoints,
)
from wire import keys as k

if TYPE_CHECKING:
    from wire.session import Session


class Bus(Protocol):
    """Be the wire to the link: a session, or a fake one in tests."""

    def status(self) -> Status | None:
        """Take the newest bridge status that was not taken yet."""

    def localization(self) -> Localization | None:
        """Take the newest localization that was not taken yet."""

    def localizer(self) -> LocalizerStatus | None:
        """Take the localizer's newest word on what it does that was not taken yet."""

    def trial(self) -> TrialState | None:
        """Take the newest word of a robot in set-up that was not taken yet."""

    def nav2(self) -> Nav2State | None:
        """Take Nav2's newest word that was not taken yet; None where Nav2 does not drive."""

    def odometry(self) -> Odometry | None:
        """Take the newest odometry that was not taken yet."""

    def scan(self) -> Scan | None:
        """Take the newest scan that was not taken yet."""

    def events(self) -> tuple[Event, ...]:
        """Take the bridge's events that were not taken yet, oldest first."""

    def send(self, message: Record) -> None:
        """Send a command; its type says on which key."""

    def ask(self, kind: OpKind, request: OpRequest) -> None:
        """Send a request of the operator."""

    def steer(self, velocity: Velocity) -> None:
        """Send a velocity by hand."""


class WireBus:
    """Join a wire session's publishers and subscribers."""

    def __init__(self, session: Session, *, nav2: bool = False) -> None:
        """Declare what the planner hears and says; ``nav2``: where Nav2 drives, with it, too."""
        self._nav2 = session.subscriber(k.NAV2_STATE) if nav2 else None
        self._nav2_goal = session.publisher(k.NAV2_GOAL) if nav2 else None
        self._external = session.publisher(k.EXTERNAL) if nav2 else None
        self._status = session.subscriber(k.STATUS)
        self._localization = session.subscriber(k.LOCALIZATION)
        self._localizer = session.subscriber(k.LOC_STATE)
        self._hint = session.publisher(k.LOC_HINT)
        self._odometry = session.subscriber(k.ODOM)
        self._scan = session.subscriber(k.SCAN)
        self._events = session.subscriber(k.EVENT)
        self._trial = session.subscriber(k.TRIAL_STATE)
        self._order = session.publisher(k.TRIAL_ORDER)
        self._hello = session.publisher(k.HELLO)
        self._grant = session.publisher(k.GRANT)
        self._heartbeat = session.publisher(k.HEARTBEAT)
        self._waypoints = session.publisher(k.WAYPOINTS)
        self._stop = session.publisher(k.STOP)
        self._fence = session.publisher(k.FENCE)
        self._marks = session.publisher(k.MARKS)
        self._teleop = session.publisher(k.TELEOP)
        self._ops = {key.path.removeprefix("op/"): session.publisher(key) for key in k.OPS}

    def status(self) -> Status | None:
        return self._status.newest()

    def localization(self) -> Localization | None:
        return self._localization.newest()

    def localizer(self) -> LocalizerStatus | None:
        return self._localizer.newest()

    def trial(self) -> TrialState | None:
        return self._trial.newest()

    def nav2(self) -> Nav2State | None:
        return self._nav2.newest() if self._nav2 is not None else None

    def odometry(self) -> Odometry | None:
        return self._odometry.newest()

    def scan(self) -> Scan | None:
        return self._scan.newest()

    def events(self) -> tuple[Event, ...]:
        return tuple(item for item in self._events.drain().items if isinstance(item, Event))

    def send(self, message: Record) -> None:
        match message:
            case Heartbeat():
                self._heartbeat.put(message)
            case Waypoints():
                self._waypoints.put(message)
            case Grant():
                self._grant.put(message)
            case Hello():
                self._hello.put(message)
            case Stop():
                self._stop.put(message)
            case FenceRequest():
                self._fence.put(message)
            case MarksRequest():
                self._marks.put(message)
            case PoseHint():
                self._hint.put(message)
            case TrialOrder():
                self._order.put(message)
            case Nav2Goal() if self._nav2_goal is not None:
                self._nav2_goal.put(message)
            case Velocity() if self._external is not None:
                self._external.put(message)
            case _:
                raise TypeError(f"{type(message).__name__} is no command of an owner")

    def ask(self, kind: OpKind, request: OpRequest) -> None:
        self._ops[kind].put(request)

    def steer(self, velocity: Velocity) -> None:
        self._teleop.put(velocity)
