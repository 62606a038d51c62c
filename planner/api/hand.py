"""Carry a hand on the stick to the bridge over a WebSocket of its own, and tell whose hand steers.

The bridge alone decides who steers, how fast, and when a hand is too old (0.25 s without a word of
it stands); nothing here makes its law softer. Here a page's fractions become speeds below
robot.toml's limits, and a frame's age is judged on our own clock: a page repeats the number of the
newest beat that it heard, so what a network kept back is older than its last word. A socket that
closes lets go at once.

A page sends ``{"seq": 7, "beat": 12, "forward": 0.5, "left": 0.0, "held": true}``, 20 times a
second while a person holds the stick and 4 times while not; first, if it likes,
``{"name": "Ana"}``, which a person with a token of their own bears anyhow. Twenty beats a second
come back.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import secrets
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import Field, StrictBool, ValidationError

from planner.api import problems
from planner.api.access import SUBPROTOCOL
from planner.api.interfaces import Services
from planner.api.schemas import Body
from planner.people import ASKER
from wire.bounded_types import Count

if TYPE_CHECKING:
    from collections.abc import Mapping

    from planner.api.interfaces import Robot

BEAT_S = 0.05
CAUSAL_S = 0.4
"""From a beat to the frame that repeats it: the way there and back, and the wait for either."""
APART_S = 0.04
"""Between two frames of a held stick that are handed on: the bridge hears 20 a second, and takes a
burst that a network kept back for a flood."""
IDLE_APART_S = 0.2
"""Between two frames of one that is not held; they show the bridge that it is released."""
QUIET_S = 0.2
"""Of a held stick without a frame, four of which should have come: with what is still on its way
this is sooner than the bridge's own 0.25 s, which stand behind it."""
SILENT_S = 5.0
"""Of one that is not held; then its socket is closed."""
MOST_SOCKETS = 8
MOST_BYTES = 400
POLICY_VIOLATION = 1008
_BEATS = 32
_GONE = (WebSocketDisconnect, RuntimeError)
"""What a socket raises that nobody is left at."""
_Fraction = Annotated[float, Field(ge=-1.0, le=1.0, strict=True)]


class HandFrame(Body):
    """Say where a hand holds the stick, in fractions of what the robot may do."""

    seq: Annotated[Count, Field(strict=True)]
    """Rises with each frame."""
    beat: Annotated[Count, Field(strict=True)]
    """The number of the newest beat that the page heard."""
    forward: _Fraction
    left: _Fraction
    held: StrictBool


class HandName(Body):
    """Say who holds the stick, for the others' pages."""

    name: Annotated[str, Field(max_length=40)]


@dataclass(frozen=True, slots=True)
class StickOrder:
    """Be what the bridge is told of a hand, in fractions of robot.toml's limits."""

    forward: float
    left: float
    held: bool


RELEASED = StickOrder(0.0, 0.0, held=False)


class Hand:
    """Judge the frames of one page's stick. Pure: told the time, knows no socket."""

    def __init__(self) -> None:
        self.code: str | None = None
        """Why the stick that the page holds moves nothing; None: nothing is known against it."""
        self._beats: dict[int, float] = {}
        self._beat = 0
        self._seq = -1
        self._held = False
        self._told_s = float("-inf")

    @property
    def patience_s(self) -> float:
        """Return how long nothing may come."""
        return QUIET_S if self._held else SILENT_S

    def next_beat(self, now_s: float) -> int:
        """Number a beat that is sent now."""
        self._beat += 1
        self._beats[self._beat] = now_s
        self._beats.pop(self._beat - _BEATS, None)
        return self._beat

    def hear(self, frame: HandFrame, now_s: float, *, is_taken: bool) -> StickOrder | None:
        """Return what the bridge is told of this frame, None: nothing.

        Args:
            frame: what the page says.
            now_s: on the clock that numbered the beats.
            is_taken: another hand steers now.
        """
        if not frame.seq > self._seq:
            return None
        self._seq = frame.seq
        if not frame.held:
            return self._take_release(now_s)
        if self.code is not None:
            return None  # until the page lets go
        if not now_s - self._beats.get(frame.beat, float("-inf")) <= CAUSAL_S:
            return self.refuse("hand_late")
        if is_taken:
            return self.refuse("hand_taken")
        if self._held and not now_s - self._told_s >= APART_S:
            return None
        self._held, self._told_s = True, now_s
        return StickOrder(frame.forward, frame.left, held=True)

    def refuse(self, code: str) -> StickOrder | None:
        """Take no more of this press, and let go where the stick steered."""
        self.code = code
        return self.let_go()

    def let_go(self) -> StickOrder | None:
        """Return the release where the stick was held: its page is gone, late or refused."""
        was_held, self._held = self._held, False
        return RELEASED if was_held else None

    def _take_release(self, now_s: float) -> StickOrder | None:
        self.code = None
        if not self._held and not now_s - self._told_s >= IDLE_APART_S:
            return None
        self._held, self._told_s = False, now_s
        return RELEASED


def is_taken(robot: Robot, source: str) -> bool:
    """Return whether another hand than this one steers now."""
    driver = robot.driver
    return driver is not None and driver["id"] != source


def relay(robot: Robot, source: str, name: str, order: StickOrder | None) -> None:
    """Tell the bridge, below robot.toml's limits and the owner's; its caps come on top."""
    if order is None:
        return
    limits = robot.description.limits
    v_mps, w_radps = order.forward * robot.max_speed_mps, order.left * limits.max_turn_radps
    robot.steer(source, v_mps, w_radps, dead_man=order.held, name=name)


def routes(services: Services) -> APIRouter:
    """Return the socket."""
    router = APIRouter(tags=["operator"])
    open_sockets: set[str] = set()

    @router.websocket("/v1/hand")
    async def hand(socket: WebSocket) -> None:
        if len(open_sockets) >= MOST_SOCKETS:
            detail = f"{MOST_SOCKETS} pages may show a stick at once"
            await socket.send_denial_response(problems.response(503, "too_many_sockets", detail))
            return
        stick = _Stick(services, socket)
        open_sockets.add(stick.source)
        try:
            offered = socket.scope.get("subprotocols", ())
            await socket.accept(subprotocol=SUBPROTOCOL if SUBPROTOCOL in offered else None)
            await stick.attend()
        finally:
            open_sockets.discard(stick.source)

    return router


class _Stick:
    """Be one page's socket."""

    def __init__(self, services: Services, socket: WebSocket) -> None:
        self.source = f"page-{secrets.token_hex(6)}"
        self._robot, self._socket = services.robot, socket
        self._person = ASKER.get()
        self._hand, self._name = Hand(), "" if self._person is None else self._person.name

    async def attend(self) -> None:
        """Run until either side ends it; then the stick is let go at once."""
        tasks = [asyncio.create_task(self._beats()), asyncio.create_task(self._listen())]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            relay(self._robot, self.source, self._name, self._hand.let_go())
            for task in tasks:
                task.cancel()
            for task in tasks:
                with contextlib.suppress(asyncio.CancelledError, *_GONE):
                    await task

    async def _beats(self) -> None:
        while True:
            status = self._robot.status
            driver = self._robot.driver
            told = {
                "kind": "beat",
                "beat": self._hand.next_beat(time.monotonic()),
                "id": self.source,
                "driver": driver,
                "mode": status.mode if status else None,
                "code": self._hand.code,
            }
            await self._socket.send_text(json.dumps(told, ensure_ascii=False))
            await asyncio.sleep(BEAT_S)

    async def _listen(self) -> None:
        while True:
            try:
                async with asyncio.timeout(self._hand.patience_s):
                    message = await self._socket.receive()
            except TimeoutError:
                order = self._hand.refuse("hand_late")
                if order is None:
                    return  # not even held
                relay(self._robot, self.source, self._name, order)
                continue
            if message["type"] != "websocket.receive":
                return
            try:
                self._hear(_content(message))
            except ValidationError:
                detail = 'expected {"seq", "beat", "forward", "left", "held"} or {"name"}'
                told = {"kind": "problem", "code": "unknown_message", "detail": detail}
                await self._socket.send_text(json.dumps(told))
                await self._socket.close(POLICY_VIOLATION, "unknown_message")
                return

    def _hear(self, content: dict[str, Any]) -> None:
        if "name" in content:
            said = HandName.model_validate(content).name.strip()
            self._name = said if self._person is None else self._person.name
            return
        frame = HandFrame.model_validate(content)
        taken = is_taken(self._robot, self.source)
        order = self._hand.hear(frame, time.monotonic(), is_taken=taken)
        relay(self._robot, self.source, self._name, order)


def _content(message: Mapping[str, Any]) -> dict[str, Any]:
    said = message.get("text")
    if not isinstance(said, str) or len(said) > MOST_BYTES:
        return {}
    try:
        content = json.loads(said)
    except (ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}
