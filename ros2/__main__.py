"""Drive robot.toml's ROS 2 base: ``python -m ros2 --robot robot.toml [--home DIR]``.

It reaches the robot by ``ros2.transport``, holds the graph against robot.toml, and says on
``ros2/state`` how it goes (docs/ros2.md). A server, base or relay that is missing is waited for;
the robot stands meanwhile.
Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import argparse
import asyncio
import gc
import logging
import os
import secrets
import signal
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

from processes.priority import set_fifo
from ros2.base_link import BaseLink
from ros2.nav2_goals import Nav2Goals
from ros2.node import Ros2Node
from ros2.robot_link import RobotLink
from ros2.robot_process import RosRobotProcess
from ros2.ros_base import RosBase
from wire import ConfigError, load_robot
from wire.keys import Party
from wire.plain_file import read_plain_file
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable

    from wire.ros2_config import Ros2Config
    from wire.session import Session

log = logging.getLogger("ros2")

KEY_FILE, MIN_KEY_BYTES, MAX_KEY_BYTES = "relay.key", 16, 4096
PRIORITY = 40
"""Of SCHED_FIFO; below the bridge, beside what else stands for wheels."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m ros2", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--site", type=Path, help="taken as every process's, and not used")
    parser.add_argument("--port", type=int, help="of a twin's server or router on this computer")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    robot = load_robot(options.robot)
    ros2 = robot.ros2
    if ros2 is None:
        raise ConfigError(
            "ros2_not_configured", f"{options.robot} has no part ros2; docs/ros2.md shows one"
        )
    if options.port is not None:
        ros2 = at_port(ros2, options.port)
        robot = robot.model_copy(update={"ros2": ros2})
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    set_fifo(PRIORITY)  # before the session, whose threads inherit it
    with open_session(Party.ROS2, robot.id, home) as session:
        boot_id = f"ros2-{secrets.token_hex(4)}"
        if ros2.node is not None:
            base = RosBase(robot, boot_id, relay_key(home))
            _serve_node(base, ros2.node, session, relay_key(home), nav2=ros2.nav2 is not None,
                        stopped=stopped.is_set)  # fmt: skip
            return
        nav2 = Nav2Goals(ros2, ros2.nav2, boot_id) if ros2.nav2 is not None else None
        link = BaseLink(robot, boot_id, relay_key(home))
        node = Ros2Node(link, ros2, session, nav2)
        gc.collect()
        gc.freeze()
        log.info("dialling %s", ros2.peer)
        asyncio.run(node.run(stopped.is_set))


def _serve_node(
    base: RosBase,
    locator: str,
    session: Session,
    key: bytes,
    *,
    nav2: bool,
    stopped: Callable[[], bool],
) -> None:
    """Dial the robot until told to stop."""
    names = (*base.names, "nav2/state") if nav2 else base.names
    with RobotLink(locator, names) as link:
        process = RosRobotProcess(base, link, session, key, nav2=nav2)
        gc.collect()
        gc.freeze()
        log.info("dialling %s", locator)
        process.run(stopped)


def relay_key(home: Path) -> bytes:
    """Return the key that the relay's commands are signed with; empty where there is none.

    Raises:
        ConfigError: it is short, or others may read it.
    """
    path = home / KEY_FILE
    try:
        key = read_plain_file(path, MAX_KEY_BYTES).strip()
        shared = path.stat().st_mode & 0o077
    except FileNotFoundError:
        return b""
    except OSError as error:
        raise ConfigError("relay_key_unreadable", f"{path}: {error.strerror}") from None
    if shared or not len(key) >= MIN_KEY_BYTES:
        text = f"{path} must be of mode 0600 and hold {MIN_KEY_BYTES} bytes or more"
        raise ConfigError("relay_key_unfit", text)
    return key


def at_port(ros2: Ros2Config, port: int) -> Ros2Config:
    """Return how a twin is reached: by rosbridge too where robot.toml says DDS."""
    if ros2.node is not None:
        return ros2.model_copy(update={"node": f"tcp/127.0.0.1:{port}"})
    if ros2.transport == "zenoh":
        return ros2.model_copy(update={"router": f"tcp/127.0.0.1:{port}"})
    return ros2.model_copy(update={"transport": "rosbridge", "url": f"ws://127.0.0.1:{port}"})


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    logging.getLogger("websockets").setLevel(logging.ERROR)  # what ends is said by a code of ours
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"ros2: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
