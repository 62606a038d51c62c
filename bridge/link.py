"""Receive the bridge's messages as one inbox a tick and publish its decision. Decides nothing.

Bounded work whatever comes: each key's ring is bounded, at most the 4 newest of a key are parsed,
and all that came is counted for the flood detector. What makes the robot stand (stop, estop,
disarm) is the exception: the whole ring is searched from the newest back, so that no flood hides
it; repeats of what has its verdict are passed by, and what can't be read is obeyed under a name of
its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from bridge.core.inbox import ArrivedAt, FenceArrival, Inbox, LoopFacts, OperatorArrival, RejectedAt
from wire import (
    UNREADABLE,
    DecodeFailure,
    DriveState,
    OpRequest,
    Stop,
    authentic,
    authentic_fence,
    authentic_marks,
    decode,
)
from wire.base import Record
from wire.keys import (
    ARM,
    DISARM,
    DRIVE_STATE,
    ESTOP,
    ESTOP_LINK,
    EVENT,
    EXTERNAL,
    FENCE,
    GRANT,
    HEARTBEAT,
    HELLO,
    IMU,
    LOCALIZATION,
    MARKS,
    ODOM,
    RESET,
    RESUME,
    SCAN,
    STATUS,
    STOP,
    TELEOP,
    WAYPOINTS,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from bridge.core.decision import Decision
    from bridge.core.inbox import FenceDone
    from wire import FenceRequest, Imu, MarksRequest, OpKind
    from wire.keys import Key
    from wire.session import Session, Subscriber

M = TypeVar("M", bound=Record)
H = TypeVar("H", Stop, OpRequest)

PARSED = 4
"""At most so many newest messages of a key are worth parsing in one tick."""
STOPS_KEPT = 4
"""Different stops without a verdict that one tick answers, of each key; any one of them stops."""

_HALTS: tuple[tuple[OpKind, Key[OpRequest]], ...] = (("estop", ESTOP), ("disarm", DISARM))
_OPS: tuple[tuple[OpKind, Key[OpRequest]], ...] = (
    ("arm", ARM),
    ("reset", RESET),
    ("resume", RESUME),
)


class BridgeLink:
    """Hold subscribers and publishers of all the bridge's keys but the drive's."""

    def __init__(self, session: Session, robot_id: str, operator_key: bytes) -> None:
        self._robot_id = robot_id
        self._operator_key = operator_key
        self._stop = session.subscriber(STOP)
        self._halts = tuple((kind, key, session.subscriber(key)) for kind, key in _HALTS)
        self._ops = tuple((kind, key, session.subscriber(key)) for kind, key in _OPS)
        self._fence = session.subscriber(FENCE)
        self._marks = session.subscriber(MARKS)
        self._hello = session.subscriber(HELLO)
        self._grant = session.subscriber(GRANT)
        self._heartbeat = session.subscriber(HEARTBEAT)
        self._localization = session.subscriber(LOCALIZATION)
        self._teleop = session.subscriber(TELEOP)
        self._external = session.subscriber(EXTERNAL)
        self._waypoints = session.subscriber(WAYPOINTS)
        self._estop_link = session.subscriber(ESTOP_LINK)
        self._scan = session.subscriber(SCAN)
        self._imu = session.subscriber(IMU)
        self._status = session.publisher(STATUS)
        self._odometry = session.publisher(ODOM)
        self._event = session.publisher(EVENT)

    def drain(  # noqa: PLR0913  # what came by other ways than the bus, all by name
        self,
        drive: tuple[DriveState | DecodeFailure, ...],
        loop: LoopFacts,
        *,
        real_time: bool,
        chance: str,
        is_repeat: Callable[[str, str], bool] = lambda _kind, _id: False,
        imu: Imu | None = None,
        fence_done: FenceDone | None = None,
        marks_done: FenceDone | None = None,
        recorder_says: str = "",
    ) -> Inbox:
        """Drain one tick's arrivals into an inbox, stops first.

        ``is_repeat`` tells of a kind and an id whether the core has its verdict. ``imu`` is what
        the drive's own gyro said; where it has none, the key's newest counts.
        """
        took = _TickDrain()
        stops = took.take_halts(STOP, self._stop, "stop", is_repeat)
        ops = self._operator(took, is_repeat)
        return Inbox(
            stops=stops,
            ops=ops,
            hellos=took.take_all(HELLO, self._hello),
            grants=took.take_all(GRANT, self._grant),
            heartbeats=took.take_all(HEARTBEAT, self._heartbeat),
            localization=took.take_newest(LOCALIZATION, self._localization),
            teleop=took.take_all(TELEOP, self._teleop),
            external=took.take_all(EXTERNAL, self._external),
            waypoints=took.take_all(WAYPOINTS, self._waypoints),
            drive=took.sort_out(DRIVE_STATE, drive),
            scan=took.take_newest(SCAN, self._scan),
            imu=imu or took.take_newest(IMU, self._imu),
            estop_link=took.take_newest(ESTOP_LINK, self._estop_link),
            fences=self._fences(took),
            fence_done=fence_done,
            marks=self._marks_of(took),
            marks_done=marks_done,
            rejected=tuple(took.rejected),
            arrived=tuple(took.arrived),
            loop=loop,
            real_time=real_time,
            recorder_ok=not recorder_says,
            recorder_says=recorder_says,
            chance=chance,
        )

    def publish(self, decision: Decision) -> None:
        """Publish status, odometry and events of a decision."""
        if decision.status is not None:
            self._status.put(decision.status)
        if decision.odometry is not None:
            self._odometry.put(decision.odometry)
        for event in decision.events:
            self._event.put(event)

    def _operator(
        self, took: _TickDrain, is_repeat: Callable[[str, str], bool]
    ) -> tuple[OperatorArrival, ...]:
        halts = (
            OperatorArrival(kind, request, self._authentic(kind, request))
            for kind, key, subscriber in self._halts
            for request in took.take_halts(key, subscriber, kind, is_repeat)
        )
        others = (
            OperatorArrival(kind, request, self._authentic(kind, request))
            for kind, key, subscriber in self._ops
            for request in took.take_all(key, subscriber)
        )
        return (*halts, *others)

    def _fences(self, took: _TickDrain) -> tuple[FenceArrival, ...]:
        """Take requests for another fence."""
        return tuple(
            _arrival(
                each, each.fence, fits=authentic_fence(self._operator_key, self._robot_id, each)
            )
            for each in took.take_all(FENCE, self._fence)
        )

    def _marks_of(self, took: _TickDrain) -> tuple[FenceArrival, ...]:
        """Take requests for other marks."""
        return tuple(
            _arrival(
                each, each.marks, fits=authentic_marks(self._operator_key, self._robot_id, each)
            )
            for each in took.take_all(MARKS, self._marks)
        )

    def _authentic(self, kind: OpKind, request: OpRequest) -> bool:
        return authentic(self._operator_key, kind, self._robot_id, request.proof, request.id)


def _arrival(request: FenceRequest | MarksRequest, text: str, *, fits: bool) -> FenceArrival:
    """Return what arrived; the text of a request whose proof does not fit goes no further."""
    nonce = request.proof.nonce if request.proof is not None else None
    return FenceArrival(request.id, request.source, nonce, fits, text if fits else "")


class _TickDrain:
    """Collect the counts and refusals of one tick's drain.

    Most keys are silent in most ticks, so each is first asked for bytes alone: 0.5 us, four times
    cheaper than an empty list of messages.
    """

    __slots__ = ("arrived", "rejected")

    def __init__(self) -> None:
        self.arrived: list[ArrivedAt] = []
        self.rejected: list[RejectedAt] = []

    def take_all(self, key: Key[M], subscriber: Subscriber[M]) -> tuple[M, ...]:
        """Return a command key's messages, at most the PARSED newest, and count them all."""
        payloads = subscriber.drain_bytes()
        if not payloads:
            return ()
        self.arrived.append(ArrivedAt(key.path, len(payloads)))
        return self._parse(key, payloads[-PARSED:])

    def take_halts(
        self,
        key: Key[H],
        subscriber: Subscriber[H],
        kind: str,
        is_repeat: Callable[[str, str], bool],
    ) -> tuple[H, ...]:
        """Return what is to make the robot stand, oldest first, then what can't be read."""
        payloads = subscriber.drain_bytes()
        if not payloads:
            return ()
        self.arrived.append(ArrivedAt(key.path, len(payloads)))
        found: list[H] = []
        refused: DecodeFailure | None = None
        for payload in dict.fromkeys(reversed(payloads)):  # a flood says the same thing often
            item = decode(key, payload)
            if isinstance(item, DecodeFailure):
                refused = item
            elif not is_repeat(kind, item.id) and all(item.id != other.id for other in found):
                found.append(item)
                if len(found) == STOPS_KEPT:
                    break
        found.reverse()
        if refused is not None:  # one word for all of them: what they say is worth no memory
            self.rejected.append(RejectedAt(key.path, refused))
            if not is_repeat(kind, UNREADABLE):
                found.append(key.message(id=UNREADABLE, source=UNREADABLE))
        return tuple(found)

    def take_newest(self, key: Key[M], subscriber: Subscriber[M]) -> M | None:
        """Return a state key's newest message."""
        payloads = subscriber.drain_bytes()
        good = self._parse(key, payloads[-1:]) if payloads else ()
        return good[-1] if good else None

    def sort_out(self, key: Key[M], items: Iterable[M | DecodeFailure]) -> tuple[M, ...]:
        """Return the messages and note the refusals."""
        good: list[M] = []
        for item in items:
            if isinstance(item, DecodeFailure):
                self.rejected.append(RejectedAt(key.path, item))
            else:
                good.append(item)
        return tuple(good)

    def _parse(self, key: Key[M], payloads: list[bytes]) -> tuple[M, ...]:
        return self.sort_out(key, [decode(key, payload) for payload in payloads])
