"""Let Nav2 drive through the bridge: ``pons nav2 [--topic /cmd_vel_nav]``.

Stands in the planner's place (``pons up --no-planner``): hears Nav2's velocity over whichever
transport robot.toml names, and says it as ``cmd/external``, under the bridge's grants, lidar, fence
and stops (docs/external-velocity.md). Exit status: 0 left when asked, 1 its home can't be written
at present, 2 refused.
"""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import secrets
import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2.nav2_velocity import Nav2Velocity
from ros2.transport_choice import open_transport
from wire import ConfigError, keys, load_robot
from wire.keys import Key, Party
from wire.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.operations import Answer
    from ros2.transport import LinkMessages
    from ros2.trouble import Ros2Trouble
    from wire import Record, Status
    from wire.ros2_config import Ros2Config
    from wire.session import Publisher, Session

log = logging.getLogger("nav2")

PERIOD_S = 0.002
TOPIC = "/cmd_vel_nav"
_SAID: tuple[Key[Any], ...] = (keys.HELLO, keys.HEARTBEAT, keys.GRANT, keys.EXTERNAL)


class Nav2Node:
    """Join one velocity topic to the bridge."""

    def __init__(self, link: Nav2Velocity, ros2: Ros2Config, session: Session) -> None:
        self._link = link
        self._transport = open_transport(ros2, self, lambda _: None)
        self._statuses = session.subscriber(keys.STATUS)
        self._says: dict[str, Publisher[Any]] = {key.path: session.publisher(key) for key in _SAID}
        self._heard: list[Answer] = []
        self._status: Status | None = None
        self._told = ""

    def open(self, now_s: float) -> None:
        """Begin anew on a connection."""
        self._link.open(now_s)

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that it went."""
        self._link.close(trouble)

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Keep what may need a subscription, and let the link hear it."""
        if said is not None:
            self._heard.append(said)
        return self._link.hear(said, now_s)

    async def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until told to stop."""
        serving = asyncio.create_task(self._transport.serve())
        try:
            while not stopped() and not serving.done():
                await self._turn(time.monotonic())
                await asyncio.sleep(PERIOD_S)
        finally:
            serving.cancel()
            result = await asyncio.gather(serving, return_exceptions=True)
        if isinstance(result[0], Exception):
            raise result[0]

    async def _turn(self, now_s: float) -> None:
        heard, self._heard = self._heard, []
        wanted = [one for said in heard for one in self._link.subscribe(said)]
        for request in (*self._link.due(now_s), *wanted):
            await self._transport.send(request)
        await self._transport.drop_if_silent(now_s)
        status = self._statuses.newest()
        if status is not None:
            self._status = status
            for key, message in self._link.answer(status):
                self._say(key, message)
        if self._status is not None:
            velocity = self._link.velocity(self._status, now_s)
            if velocity is not None:
                self._say(keys.EXTERNAL, velocity)
        self._tell(now_s)

    def _say(self, key: Key[Any], message: Record) -> None:
        self._says[key.path].put(message)

    def _tell(self, now_s: float) -> None:
        """Log what changed: trouble with ROS, and what the bridge makes of it."""
        trouble, status = self._link.trouble(now_s), self._status
        bridge = "no bridge" if status is None else f"{status.mode.value}, held {status.held}"
        line = f"{bridge}; {trouble.code if trouble else 'Nav2 is heard or silent'}"
        if line != self._told:
            self._told = line
            log.info("%s", f"{line}: {trouble.detail}" if trouble else line)


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    logging.getLogger("websockets").setLevel(logging.ERROR)  # what ends is said by a code of ours
    parser = argparse.ArgumentParser(prog="python -m ros2.nav2", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--topic", default=TOPIC, help=f"Nav2's velocity (default {TOPIC})")
    try:
        _serve(parser.parse_args(arguments))
    except ConfigError as error:
        sys.stderr.write(f"nav2: {error}\n")
        return error.exit_status
    return 0


def _serve(options: argparse.Namespace) -> None:
    stopped: list[bool] = []
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.append(True))
    robot = load_robot(options.robot)
    ros2 = robot.ros2
    if ros2 is None:
        found = f"{options.robot} has no part ros2; docs/external-velocity.md shows one"
        raise ConfigError("ros2_not_configured", found)
    if ros2.node is not None:
        found = "pons nav2 goes by ros2.transport; with ros2.node have [ros2.nav2] and a planner"
        raise ConfigError("nav2_by_node", found)
    if options.topic in (ros2.cmd_vel, ros2.command):
        found = f"{options.topic} is what the relay drives by; have Nav2 say {TOPIC} instead"
        raise ConfigError("nav2_topic_taken", found)
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    with open_session(Party.PLANNER, robot.id, home) as session:
        link = Nav2Velocity(ros2, options.topic, f"nav2-{secrets.token_hex(4)}", robot.hash)
        log.info("dialling %s for %s", ros2.peer, options.topic)
        asyncio.run(Nav2Node(link, ros2, session).run(lambda: bool(stopped)))


if __name__ == "__main__":
    sys.exit(main())
