"""Run simulator, localization and a bridge in a home of their own, or join those that run.

Owns processes and the two sessions: the judge's, which watches, and the planner's, which speaks.
"""

from __future__ import annotations

import secrets
import time
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Self

from pons.conformance.adapter import CannotTest
from pons.conformance.bounds import MotionBounds
from pons.conformance.raw_publisher import Mouth
from pons.conformance.record import DriveRecord
from pons.conformance.watch import BridgeWatch
from pons.robot_processes import BODY, RobotProcesses
from processes.parent_death import child_command
from wire import VIRTUAL_KEY, ConfigError, Mode, OpRequest, encode, load_robot, signed_request
from wire.doors import BRIDGE_DOOR
from wire.keys import Party
from wire.session import open_session
from wire.site_map import read_map_id
from wire.sockets import Endpoints

if TYPE_CHECKING:
    from types import TracebackType

    from pons.conformance.track import TestTrack
    from pons.settings import LaunchSettings
    from wire import OpKind, Status

START_S = 40.0
HEARD_S = 3.0
PUT_S = 1.0
OURS = "bridge"


class SystemUnderTest:
    """Be an Adapter for every bridge that speaks this wire."""

    def __init__(
        self, settings: LaunchSettings, track: TestTrack, *, module: str = OURS, join: bool = False
    ) -> None:
        """Describe it; entering the context starts or joins it.

        Args:
            settings: robot and site; home too where an existing one is joined.
            track: where the robot is put.
            module: run as the bridge: ``python -m MODULE --home … --robot … --site …``.
            join: start nothing; test the bridge that runs in the settings' home.
        """
        self.name = f"joined in {settings.home}" if join else module
        self._settings, self._track, self._module, self._join = settings, track, module, join
        self._robot = load_robot(settings.robot)
        self.bounds = MotionBounds.of(self._robot)
        self.record = DriveRecord()
        self._home = settings.home
        self._stack = ExitStack()
        self._processes: RobotProcesses | None = None

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            if not self._join:
                self._start(stack)
            try:
                self._watch = stack.enter_context(BridgeWatch(self._home, self._robot.id))
                party = open_session(Party.PLANNER, self._robot.id, self._home)
                self._mouth = Mouth(stack.enter_context(party))
            except ConfigError as wrong:
                raise CannotTest(str(wrong)) from None
            self.record = self._watch.record
            self._await(HEARD_S if self._join else START_S)
            if self._join:
                self._put_on_the_track()
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    # The adapter --------------------------------------------------------------------------------

    def status(self) -> Status | None:
        """Return the bridge's newest word."""
        return self._watch.status

    def say(self, key: str, payload: bytes) -> None:
        """Send bytes as they are."""
        self._mouth.say(key, payload)

    def operate(self, kind: OpKind) -> bytes:
        """Make an operator's request, signed with the simulator's published key."""
        status, request_id = self.status(), f"kit-{secrets.token_hex(6)}"
        request = OpRequest(id=request_id, source="kit")
        if status is not None:
            request = signed_request(VIRTUAL_KEY, kind, status, "kit", request_id)
        payload = encode(request)
        self.say(f"op/{kind}", payload)
        return payload

    def helper(self) -> tuple[str, ...]:
        """Return the command of a helper, which dies with this process."""
        return child_command("pons.conformance.worker_process", str(self._home), self._robot.id)

    def door(self) -> str:
        """Return the bridge's socket."""
        return str(Endpoints(self._home).socket(BRIDGE_DOOR))

    # Starting -----------------------------------------------------------------------------------

    def _start(self, stack: ExitStack) -> None:
        folder = TemporaryDirectory(prefix="pc-", ignore_cleanup_errors=True)
        self._home = Path(stack.enter_context(folder))
        pose = self._track.middle
        start = ("--start", f"{pose.x_m:.3f}", f"{pose.y_m:.3f}", f"{pose.yaw_rad:.4f}")
        described = RobotProcesses(
            replace(self._settings, home=self._home),
            BODY,
            modules={OURS: self._module},
            arguments={"sim": start},
        )
        self._processes = stack.enter_context(described)

    def _await(self, limit_s: float) -> None:
        """Wait until bridge and robot speak and nothing is awaited any more."""
        end_s = time.monotonic() + limit_s
        while not self._speaks():
            if time.monotonic() > end_s:
                raise CannotTest(f"no_bridge: {self._lacks()}; not within {limit_s:.0f} s")
            ended = self._processes and self._processes.find_ended()
            if ended:
                raise CannotTest(f"{ended.name} ended:\n{ended.last_words()}")
            time.sleep(0.05)
        status = self.status()
        known = (self._robot.hash, read_map_id(self._settings.site))
        why = unfit(status, *known) if status is not None else None
        if why is not None:
            raise CannotTest(why)

    def _speaks(self) -> bool:
        status = self.status()
        ready = status is not None and status.mode not in (Mode.BOOT, Mode.SELFTEST)
        metal = status is not None and not status.drive.virtual
        # A busy machine takes longer to find the first pose than a row has for driving off.
        placed = self._join or (status is not None and status.base_in_map is not None)
        return metal or (
            ready and placed and bool(self.record.truths) and bool(self.record.commands)
        )

    def _lacks(self) -> str:
        status = self.status()
        if status is None:
            return f"no status was heard in {self._home}"
        if not self.record.truths:
            return "no simulator tells the truth"
        if status.base_in_map is None:
            return f"mode {status.mode}, the robot does not know where it is"
        waits = ", ".join(status.waiting_for)
        return f"mode {status.mode}, waits for {waits or 'nothing'}"

    def _put_on_the_track(self) -> None:
        self._watch.place(self._track.middle, f"kit-{secrets.token_hex(6)}")
        time.sleep(PUT_S)


def unfit(status: Status, robot_hash: str, map_id: str) -> str | None:
    """Say why a running bridge must not be tested; None where it may.

    Args:
        status: its word.
        robot_hash: of the robot whose limits it will be held to.
        map_id: of the site on which the robot will be driven.
    """
    if not status.drive.virtual:
        return (
            f"metal: the bridge drives {status.drive.kind}, and this kit plays brains that are "
            "broken on purpose; it tests simulated robots only"
        )
    for what, came, expected in (
        ("robot", status.robot_hash, robot_hash),
        ("site", status.map_id, map_id),
    ):
        if came != expected:
            return (
                f"other_{what}: the bridge serves {came}, given was {expected}; name its own with "
                + ("PONS_ROBOT" if what == "robot" else "--site")
            )
    if status.owner is not None:
        return (
            f"owned: {status.owner.kind} {status.owner.planner_id} owns the robot; end it first "
            "(`pons up --no-planner` starts a robot without one)"
        )
    return None
