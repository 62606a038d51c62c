"""Carry commands from the wire to the node on a robot of ROS 2, and back what it says."""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from ros2.pons_ros2.pons_ros2.dead_man import sign
from ros2.robot_link import RobotLink
from ros2.trouble import STARTING, Ros2Trouble, known_code
from wire import keys
from wire.codec import decode, encode
from wire.nav2_dialogue import Nav2State

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.ros_base import RosBase
    from wire.session import Session

log = logging.getLogger("ros2")

PERIOD_S = 0.002
"""A command waits so long at most. zenoh's rings are asked; they wake nobody."""
LOOK_S = 0.05
"""Whether the robot is joined, and what is wrong, is looked at so often."""
STATE_S = 0.5
DIAL_S = 1.0
"""Until then that nobody answers is no news."""
FROZEN_S = 0.1
DISTRUST_S = 0.1
"""After a pause of this process, what lay in its sockets for so long is thrown away: nobody can say
how old it is, and the robot has stopped by then."""


class RosRobotProcess:
    """Connect one base to the wire and to its robot."""

    def __init__(
        self, base: RosBase, link: RobotLink, session: Session, key: bytes, *, nav2: bool
    ) -> None:
        self._base, self._link, self._key = base, link, key
        self._commands = session.subscriber(keys.DRIVE_COMMAND)
        self._drive = session.publisher(keys.DRIVE_STATE)
        self._scan = session.publisher(keys.SCAN)
        self._imu = session.publisher(keys.IMU)
        self._state = session.publisher(keys.ROS2_STATE)
        self._orders = session.subscriber(keys.NAV2_GOAL) if nav2 else None
        self._nav2 = session.publisher(keys.NAV2_STATE)
        self._views = session.subscriber(keys.PLAN_VIEW)
        self._turned_s = self._began_s = time.monotonic()
        self._distrusted_until_s = self._looked_s = self._said_s = float("-inf")
        self._code: str | None = STARTING
        self._has_joined = False
        self._seq = self._nav2_seq = 0

    def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until told to stop."""
        while not stopped():
            self.turn(time.monotonic())
            time.sleep(PERIOD_S)

    def turn(self, now_s: float) -> None:
        """Pass on the newest command, hear the robot, say twice a second how it goes."""
        slept_s, self._turned_s = now_s - self._turned_s, now_s
        if slept_s > FROZEN_S:
            log.warning("frozen for %.2f s: what came meanwhile is thrown away", slept_s)
            self._distrusted_until_s = now_s + DISTRUST_S
        if now_s - self._looked_s >= LOOK_S:
            self._looked_s = now_s
            self._look(now_s)
        self._hear(now_s)
        command = self._commands.newest()
        if command is not None and now_s >= self._distrusted_until_s:
            words = self._base.encode(command, now_s)
            if words is not None:
                self._link.say("command", words)
        for name, heard in (("nav2/goal", self._orders), ("plan", self._views)):
            said = heard.newest() if heard is not None else None
            if said is not None:
                self._link.say(name, sign(encode(said).decode(), self._key).encode())

    def _hear(self, now_s: float) -> None:
        for name in self._base.names:
            for payload in self._link.take(name):
                heard = self._base.hear(name, payload, now_s)
                if heard.state is not None:
                    self._drive.put(heard.state)
                if heard.scan is not None:
                    self._scan.put(heard.scan)
                if heard.imu is not None:
                    self._imu.put(heard.imu)
        if self._orders is not None:
            for payload in self._link.take("nav2/state"):
                self._pass_nav2(decode(keys.NAV2_STATE, payload))

    def _pass_nav2(self, said: object) -> None:
        """Pass on what Nav2 says, with the cure of what is wrong."""
        if isinstance(said, Nav2State):
            if said.code is not None:
                trouble = Ros2Trouble(known_code(said.code), said.detail)
                told = {"code": trouble.code, "detail": trouble.detail}
                said = said.model_copy(update=told)
            self._nav2.put(said)

    def _say_no_nav2(self, trouble: Ros2Trouble) -> None:
        """Tell the planner why it does not hear Nav2."""
        self._nav2_seq += 1
        self._nav2.put(
            Nav2State(
                boot_id="ros2", seq=self._nav2_seq, mission=None, leg=0, phase="idle",
                phase_s=0.0, twist=0, twist_age_s=0.0, v_mps=0.0, w_radps=0.0,
                code=trouble.code, detail=trouble.detail,
            )
        )  # fmt: skip

    def _look(self, now_s: float) -> None:
        joined = self._link.is_joined
        if joined and not self._has_joined:
            self._base.open(now_s)
        elif not joined and now_s - self._began_s > DIAL_S:
            gone = "ros2_node_gone" if self._base.reached else "ros2_no_node"
            self._base.close(Ros2Trouble(gone, f"nobody answers at {self._base.peer}"))
        self._has_joined = joined
        trouble = self._base.judge(now_s)
        if not joined and trouble is not None:
            self._say_no_nav2(trouble)
        code = trouble.code if trouble else None
        if code == self._code and now_s - self._said_s < STATE_S:
            return
        if code != self._code:
            level = logging.INFO if code in (None, STARTING) else logging.WARNING
            log.log(level, "%s", f"{code}: {trouble.detail}" if trouble else "the base is heard")
        self._code, self._said_s = code, now_s
        self._seq += 1
        self._state.put(self._base.status(self._seq, now_s))
