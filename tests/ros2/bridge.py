"""Command a ROS 2 base as the bridge does, over the wire."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from wire import DriveCommand, DriveState, Ros2Status, keys
from wire.keys import Party
from wire.session import Session, open_session

LIMIT_S = 60.0


class Bridge:
    """Command as a bridge does and hear what comes back, until something holds."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.session: Session = open_session(Party.BRIDGE, "r1", home)
        self.judge = open_session(Party.JUDGE, "r1", home)
        self._commands = self.session.publisher(keys.DRIVE_COMMAND)
        self._states = self.session.subscriber(keys.DRIVE_STATE)
        self._status = self.judge.subscriber(keys.ROS2_STATE)
        self.state: DriveState | None = None
        self.status: Ros2Status | None = None
        self.seq = 0

    def until(self, done: Callable[[], bool]) -> None:
        end_s = time.monotonic() + LIMIT_S
        while not done():
            assert time.monotonic() < end_s, f"nothing came of it: {self.status}, {self.state}"
            self.seq += 1
            self._commands.put(
                DriveCommand(
                    boot="boot1", seq=self.seq, left_radps=1.0, right_radps=1.0, enable=True
                )
            )
            time.sleep(0.01)
            self.state = self._states.newest() or self.state
            self.status = self._status.newest() or self.status

    def code(self) -> str | None:
        return self.status.code if self.status else "nothing"

    def close(self) -> None:
        self.session.close()
        self.judge.close()
