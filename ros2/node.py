"""Run one ROS 2 base as a process: commands from the wire to its graph, and back what it says."""

from __future__ import annotations

import asyncio
import logging
import time
from typing import TYPE_CHECKING

from ros2.transport_choice import open_transport
from ros2.trouble import STARTING
from wire import keys
from wire.nav2_dialogue import Nav2Goal, Nav2State

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.base_link import BaseLink
    from ros2.nav2_goals import Nav2Goals
    from ros2.operations import Answer, Request
    from ros2.transport import LinkMessages
    from ros2.trouble import Ros2Trouble
    from wire.ros2_config import Ros2Config
    from wire.session import Publisher, Session, Subscriber

log = logging.getLogger("ros2")

PERIOD_S = 0.002
"""A command waits so long at most. The transport's ring is asked; it wakes nobody."""
LOOK_S = 0.02
"""What is due to the graph, and what is wrong, is looked at so often."""
STATE_S = 0.5
NAV2_STATE_S = 0.1
FROZEN_S = 0.1
DISTRUST_S = 0.1
"""After a pause of this process, what lay in its sockets for so long is thrown away: nobody can say
how old it is, and the relay has stopped the base by then."""


class Nav2Door:
    """Join Nav2's goals to the wire, beside a base's link and on its transport."""

    def __init__(self, goals: Nav2Goals, session: Session) -> None:
        self._goals = goals
        self._orders: Subscriber[Nav2Goal] = session.subscriber(keys.NAV2_GOAL)
        self._state: Publisher[Nav2State] = session.publisher(keys.NAV2_STATE)
        self._wanted: list[Request] = []
        self._said_s, self._twists = float("-inf"), 0
        self._code: str | None = STARTING

    def open(self, now_s: float) -> None:
        """Begin anew on a connection."""
        self._wanted.clear()
        self._goals.open(now_s)

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now."""
        self._goals.close(trouble)

    def hear(self, said: Answer | None, now_s: float) -> None:
        """Let Nav2's goals hear what the graph says."""
        self._wanted += self._goals.hear(said, now_s)

    def turn(self, now_s: float) -> list[Request]:
        """Hear the planner, tell it what is new, and return what is to be said to the graph."""
        order = self._orders.newest()
        if order is not None:
            self._goals.take(order, now_s)
        due, self._wanted = [*self._wanted, *self._goals.due(now_s)], []
        twists = self._goals.twists
        if twists != self._twists or due or now_s - self._said_s >= NAV2_STATE_S:
            self._twists, self._said_s = twists, now_s
            state = self._goals.state(now_s)
            self._state.put(state)
            if state.code != self._code:
                self._code = state.code
                log.info("Nav2: %s", f"{state.code}: {state.detail}" if state.code else "heard")
        return due


class Ros2Node:
    """Connect one base's link to the wire and to its transport."""

    def __init__(
        self, link: BaseLink, ros2: Ros2Config, session: Session, nav2: Nav2Goals | None = None
    ) -> None:
        self._link = link
        self._nav2 = Nav2Door(nav2, session) if nav2 is not None else None
        self._commands = session.subscriber(keys.DRIVE_COMMAND)
        self._drive = session.publisher(keys.DRIVE_STATE)
        self._scan = session.publisher(keys.SCAN)
        self._imu = session.publisher(keys.IMU)
        self._state = session.publisher(keys.ROS2_STATE)
        self._transport = open_transport(ros2, self, self._publish)
        self._turned_s = time.monotonic()
        self._distrusted_until_s = float("-inf")
        self._looked_s = self._said_s = float("-inf")
        self._code: str | None = STARTING
        self._seq = 0

    def open(self, now_s: float) -> None:
        """Begin anew on a connection that was just made."""
        self._link.open(now_s)
        if self._nav2 is not None:
            self._nav2.open(now_s)

    def close(self, trouble: Ros2Trouble) -> None:
        """Note that there is no connection now, and why."""
        self._link.close(trouble)
        if self._nav2 is not None:
            self._nav2.close(trouble)

    def hear(self, said: Answer | None, now_s: float) -> LinkMessages:
        """Let base and Nav2 hear one answer; return what the base makes of it."""
        if self._nav2 is not None:
            self._nav2.hear(said, now_s)
        return self._link.hear(said, now_s)

    async def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until told to stop."""
        reading = asyncio.create_task(self._transport.serve())
        try:
            while not stopped() and not reading.done():
                await self.turn(time.monotonic())
                await asyncio.sleep(PERIOD_S)
        finally:
            reading.cancel()
            result = await asyncio.gather(reading, return_exceptions=True)
        if isinstance(result[0], Exception):
            raise result[0]

    async def turn(self, now_s: float) -> None:
        """Pass on the newest command, ask what is due, say twice a second how it goes."""
        slept_s, self._turned_s = now_s - self._turned_s, now_s
        if slept_s > FROZEN_S:
            log.warning("frozen for %.2f s: what came meanwhile is thrown away", slept_s)
            self._distrusted_until_s = now_s + DISTRUST_S
        command = self._commands.newest()
        if command is not None and now_s >= self._distrusted_until_s:
            words = self._link.encode(command, now_s)
            if words is not None and self._transport.has_room():
                self._link.sent += int(await self._transport.send(words))
            elif words is not None:
                self._link.unsent += 1
        if self._nav2 is not None:
            for request in self._nav2.turn(now_s):
                await self._transport.send(request)
        if now_s - self._looked_s >= LOOK_S:
            self._looked_s = now_s
            for request in self._link.due(now_s):
                await self._transport.send(request)
            await self._transport.drop_if_silent(now_s)
            self._say(now_s)

    def _publish(self, heard: LinkMessages) -> None:
        if heard.state is not None:
            self._drive.put(heard.state)
        if heard.scan is not None:
            self._scan.put(heard.scan)
        if heard.imu is not None:
            self._imu.put(heard.imu)

    def _say(self, now_s: float) -> None:
        trouble = self._link.judge(now_s)
        code = trouble.code if trouble else None
        if code == self._code and now_s - self._said_s < STATE_S:
            return
        if code != self._code:
            level = logging.INFO if code in (None, STARTING) else logging.WARNING
            log.log(level, "%s", f"{code}: {trouble.detail}" if trouble else "the base is heard")
        self._code, self._said_s = code, now_s
        self._seq += 1
        self._state.put(self._link.status(self._seq, now_s))
