"""Drive robot.toml's ROS 2 base: ``python -m ros2 --robot robot.toml [--home DIR]``.

It dials the node on the robot, and says on ``ros2/state`` how it goes (docs/ros2.md). A node or
base that is missing is waited for; the robot stands meanwhile.
Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import argparse
import gc
import logging
import os
import secrets
import signal
import sys
import threading
from pathlib import Path

from processes.log_lines import begin_log
from processes.priority import set_fifo
from ros2.robot_link import RobotLink
from ros2.robot_process import RosRobotProcess
from ros2.ros_base import RosBase
from wire import ConfigError, load_robot
from wire.keys import Party
from wire.plain_file import read_plain_file
from wire.session import open_session

log = logging.getLogger("ros2")

KEY_FILE, MIN_KEY_BYTES, MAX_KEY_BYTES = "relay.key", 16, 4096
PRIORITY = 40
"""Of SCHED_FIFO; below the bridge, beside what else stands for wheels."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m ros2", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--site", type=Path, help="taken as every process's, and not used")
    parser.add_argument("--port", type=int, help="of a twin's node on this computer")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    robot = load_robot(options.robot)
    ros2 = robot.ros2
    if ros2 is None:
        found = f"{options.robot} has no part ros2; docs/ros2.md shows one"
        raise ConfigError("ros2_not_configured", found)
    if options.port is not None:
        ros2 = ros2.model_copy(update={"node": f"tcp/127.0.0.1:{options.port}"})
        robot = robot.model_copy(update={"ros2": ros2})
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    key, nav2 = relay_key(home), ros2.nav2 is not None
    set_fifo(PRIORITY)  # before the sessions, whose threads inherit it
    base = RosBase(robot, f"ros2-{secrets.token_hex(4)}", key)
    names = (*base.names, "nav2/state") if nav2 else base.names
    with (
        open_session(Party.ROS2, robot.id, home) as session,
        RobotLink(ros2.node, names) as link,
    ):
        process = RosRobotProcess(base, link, session, key, nav2=nav2)
        gc.collect()
        gc.freeze()
        log.info("dialling %s", ros2.node)
        process.run(stopped.is_set)


def relay_key(home: Path) -> bytes:
    """Return the key that commands are signed with; empty where there is none.

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


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    begin_log()
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"ros2: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
