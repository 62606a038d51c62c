"""Speak with the bridge from the event loop: newest word in, commands out, requests until echoed.

Knows the wire and our own monotonic clock. Decides nothing about driving; what an owner says is
``owner``'s business, what is wanted the mission's. ``poll`` never blocks; the only waiting is that
of ``stop`` and ``operate`` for an echo, and others go on meanwhile.
"""

from __future__ import annotations

import asyncio
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from planner.bridge_client.errors import BridgeSilent
from planner.bridge_client.scan_to_map import points_in_map
from planner.bridge_client.transport import Bus
from wire import (
    VIRTUAL_KEY,
    Answer,
    Event,
    FenceRequest,
    HintVerdict,
    Localization,
    LocalizerStatus,
    MarksRequest,
    Nav2State,
    Odometry,
    OpKind,
    OpRequest,
    PoseHint,
    Record,
    RobotDescription,
    Scan,
    Status,
    Stop,
    TrialOrder,
    TrialState,
    Velocity,
    mark_relayed,
    signed_request,
)

ECHO_S = 2.0
REPEAT_S = 0.05
SCAN_FRESH_S = 0.5
HINT_S = 6.0
"""A search takes a fraction of a second, and two scans more to be believed."""

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Aged(Generic[T]):
    """Give the newest of something, with its age on our own clock [s]."""

    value: T
    age_s: float


@dataclass(frozen=True, slots=True)
class StopResult:
    """Tell whether the bridge has echoed a stop."""

    id: str
    is_echoed: bool
    waited_s: float


class Follower(Protocol):
    """Be told all odometry and localization as it comes, to know later where the robot was."""

    def odometry(self, odometry: Odometry) -> None: ...

    def localization(self, localization: Localization) -> None: ...


class Link:
    """Be the planner's one way to the bridge."""

    def __init__(
        self,
        bus: Bus,
        robot: RobotDescription,
        *,
        clock: Callable[[], float] = time.monotonic,
        new_id: Callable[[], str] = lambda: uuid.uuid4().hex,
    ) -> None:
        self._bus = bus
        self._robot = robot
        self._clock = clock
        self._new_id = new_id
        self._status: tuple[Status, float] | None = None
        self._localization: tuple[Localization, float] | None = None
        self._odometry: tuple[Odometry, float] | None = None
        self._scan: tuple[Scan, float] | None = None
        self._localizer: tuple[LocalizerStatus, float] | None = None
        self._trial: tuple[TrialState, float] | None = None
        self._waiting: dict[str, asyncio.Future[Answer]] = {}
        self._followers: list[Follower] = []

    # What was heard -----------------------------------------------------------------------------

    def poll(self) -> Status | None:
        """Drain the rings once; return the status that came since the last poll, if one did."""
        now_s = self._clock()
        if (localization := self._bus.localization()) is not None:
            self._localization = (localization, now_s)
            for follower in self._followers:
                follower.localization(localization)
        if (odometry := self._bus.odometry()) is not None:
            self._odometry = (odometry, now_s)
            for follower in self._followers:
                follower.odometry(odometry)
        if (said := self._bus.localizer()) is not None:
            self._localizer = (said, now_s)
        if (trial := self._bus.trial()) is not None:
            self._trial = (trial, now_s)
        if (scan := self._bus.scan()) is not None:
            self._scan = (scan, now_s)
        status = self._bus.status()
        if status is not None:
            self._status = (status, now_s)
            self._resolve(status)
        return status

    def tell(self, follower: Follower) -> None:
        """Tell somebody, from now on, how the robot moves and where it is."""
        self._followers.append(follower)

    def nav2(self) -> Nav2State | None:
        """Take Nav2's newest word that was not taken yet."""
        return self._bus.nav2()

    def events(self) -> tuple[Event, ...]:
        """Take the bridge's events since the last call. For people; never relied upon."""
        return self._bus.events()

    @property
    def status(self) -> Aged[Status] | None:
        """Return the newest bridge status, however old."""
        return self._aged(self._status)

    @property
    def localization(self) -> Aged[Localization] | None:
        """Return the newest localization, however old."""
        return self._aged(self._localization)

    @property
    def localizer(self) -> Aged[LocalizerStatus] | None:
        """Return what the localizer said last that it does, however old; None without one."""
        return self._aged(self._localizer)

    @property
    def trial(self) -> Aged[TrialState] | None:
        """Return the newest word of a robot in set-up, however old; None where none spoke."""
        return self._aged(self._trial)

    def order_trial(self, order: TrialOrder) -> None:
        """Bring set-up a page's order."""
        self._bus.send(order)

    @property
    def odometry(self) -> Aged[Odometry] | None:
        """Return the newest odometry, however old."""
        return self._aged(self._odometry)

    @property
    def scan(self) -> Aged[Scan] | None:
        """Return the newest scan, however old."""
        return self._aged(self._scan)

    def obstacles(self) -> tuple[tuple[float, float], ...]:
        """Return the lidar's points now in ``map`` [m]; none without scan or pose."""
        scan, status = self.scan, self.status
        if scan is None or status is None or not scan.age_s <= SCAN_FRESH_S:
            return ()
        pose = status.value.base_in_map
        return () if pose is None else points_in_map(scan.value, self._robot.lidar, pose)

    def _aged(self, kept: tuple[T, float] | None) -> Aged[T] | None:
        return None if kept is None else Aged(kept[0], self._clock() - kept[1])

    # What is said -------------------------------------------------------------------------------

    def send(self, messages: tuple[Record, ...]) -> None:
        """Send the owner's messages, in order."""
        for message in messages:
            self._bus.send(message)

    def teleop(self, velocity: Velocity) -> None:
        """Relay a velocity by hand; the bridge judges its age, its source and its dead-man."""
        self._bus.steer(velocity)

    async def stop(self, source: str) -> StopResult:
        """Say stop at 20 Hz until the bridge echoes it, 2 s at most. Never raises for silence."""
        began_s, stop_id = self._clock(), self._new_id()
        message = Stop(id=stop_id, source=mark_relayed(source))
        answer = await self._until_echoed(stop_id, lambda: self._bus.send(message))
        return StopResult(stop_id, answer is not None, self._clock() - began_s)

    def sign_again(self, request: OpRequest | None) -> OpRequest | None:
        """Return a person's request under the nonce that counts now, where no key is needed.

        A stop voids what was signed before it, though the very sentence that stopped may ask for
        another drive. With metal only the person can sign again.
        """
        status = self.status.value if self.status is not None else None
        if request is None or status is None or not status.drive.virtual:
            return request
        return signed_request(VIRTUAL_KEY, "resume", status, request.source, request.id)

    async def operate(self, kind: OpKind, request: OpRequest) -> Answer:
        """Bring an operator's request to the bridge and return its verdict.

        Raises:
            BridgeSilent: it was not echoed within 2 s.
        """
        answer = await self._until_echoed(request.id, lambda: self._bus.ask(kind, request))
        if answer is None:
            raise BridgeSilent(kind, ECHO_S)
        return answer

    async def offer_fence(self, request: FenceRequest) -> Answer:
        """Bring an operator's fence to the bridge and return its verdict.

        Raises:
            BridgeSilent: it was not echoed within 2 s.
        """
        return await self._offer(request, "fence")

    async def offer_marks(self, request: MarksRequest) -> Answer:
        """Bring an operator's marks to the bridge and return its verdict.

        Raises:
            BridgeSilent: it was not echoed within 2 s.
        """
        return await self._offer(request, "marks")

    async def _offer(self, request: FenceRequest | MarksRequest, kind: str) -> Answer:
        answer = await self._until_echoed(request.id, lambda: self._bus.send(request))
        if answer is None:
            raise BridgeSilent(kind, ECHO_S)
        return answer

    async def hint(self, hint: PoseHint) -> HintVerdict | None:
        """Tell localization where a person says the robot is; return its verdict.

        None: it did not answer within HINT_S; it may be one that takes no hints.
        """
        deadline_s = self._clock() + HINT_S
        while self._clock() < deadline_s:
            self._bus.send(hint)
            await asyncio.sleep(REPEAT_S)
            said = self._localizer[0].hint if self._localizer is not None else None
            if said is not None and said.id == hint.id:
                return said
        return None

    def _resolve(self, status: Status) -> None:
        if not self._waiting:
            return
        for answer in status.answers:
            future = self._waiting.get(answer.id)
            if future is not None and not future.done():
                future.set_result(answer)

    async def _until_echoed(self, request_id: str, say: Callable[[], None]) -> Answer | None:
        """Repeat until the answer stands in a status; ``poll`` must go on meanwhile."""
        future: asyncio.Future[Answer] = asyncio.get_running_loop().create_future()
        self._waiting[request_id] = future
        deadline_s = self._clock() + ECHO_S
        try:
            while self._clock() < deadline_s:
                say()
                done, _ = await asyncio.wait({future}, timeout=REPEAT_S)
                if done:
                    return future.result()
            return None
        finally:
            del self._waiting[request_id]
