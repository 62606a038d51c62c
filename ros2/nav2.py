"""Let Nav2 drive through the bridge: ``pons nav2``.

Stands in the planner's place (``pons up --no-planner``): hears Nav2's velocity from the ROS 2
process, and says it as ``cmd/external``, under the bridge's grants, lidar, fence and stops
(docs/external-velocity.md). Exit status: 0 left when asked, 1 its home can't be written at present,
2 refused.
"""

from __future__ import annotations

import argparse
import logging
import os
import secrets
import signal
import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2.nav2_velocity import Nav2Velocity
from wire import ConfigError, keys, load_robot
from wire.keys import Key, Party
from wire.session import open_session

if TYPE_CHECKING:
    from wire import Status
    from wire.session import Publisher, Session

log = logging.getLogger("nav2")

PERIOD_S = 0.002
_SAID: tuple[Key[Any], ...] = (keys.HELLO, keys.HEARTBEAT, keys.GRANT, keys.EXTERNAL)


class Nav2Node:
    """Join Nav2's velocity to the bridge."""

    def __init__(self, nav2: Nav2Velocity, session: Session) -> None:
        self._nav2 = nav2
        self._states = session.subscriber(keys.NAV2_STATE)
        self._statuses = session.subscriber(keys.STATUS)
        self._says: dict[str, Publisher[Any]] = {key.path: session.publisher(key) for key in _SAID}
        self._status: Status | None = None
        self._told = ""

    def turn(self, now_s: float) -> None:
        """Hear Nav2 and bridge, and say what is due."""
        state, status = self._states.newest(), self._statuses.newest()
        if state is not None:
            self._nav2.hear(state, now_s)
        if status is not None:
            self._status = status
            for key, message in self._nav2.answer(status):
                self._says[key.path].put(message)
        if self._status is not None:
            velocity = self._nav2.velocity(self._status, now_s)
            if velocity is not None:
                self._says[keys.EXTERNAL.path].put(velocity)
        self._tell(now_s)

    def _tell(self, now_s: float) -> None:
        """Log what changed: trouble with ROS, and what the bridge makes of it."""
        trouble, status = self._nav2.trouble(now_s), self._status
        bridge = "no bridge" if status is None else f"{status.mode.value}, held {status.held}"
        line = f"{bridge}; {trouble or 'Nav2 is heard or silent'}"
        if line != self._told:
            self._told = line
            log.info("%s", line)


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    parser = argparse.ArgumentParser(
        prog="pons nav2",
        description="Let Nav2 drive through the bridge, in the planner's place "
        "(`pons up --no-planner`). Stops and limits stay the bridge's.",
        epilog="example: pons nav2",
    )
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    try:
        _serve(parser.parse_args(arguments))
    except ConfigError as error:
        sys.stderr.write(f"nav2: {error}\n")
        return error.exit_status
    return 0


def _serve(options: argparse.Namespace) -> None:
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    robot = load_robot(options.robot)
    if robot.ros2 is None or robot.ros2.nav2 is None:
        found = f"{options.robot} has no part ros2.nav2; docs/external-velocity.md shows one"
        raise ConfigError("ros2_not_configured", found)
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    with open_session(Party.PLANNER, robot.id, home) as session:
        node = Nav2Node(Nav2Velocity(f"nav2-{secrets.token_hex(4)}", robot.hash), session)
        while not stopped.wait(PERIOD_S):
            node.turn(time.monotonic())


if __name__ == "__main__":
    sys.exit(main())
