"""Be a robot on paper: a bridge of a few lines and a body in shared memory that no death moves."""

from __future__ import annotations

import mmap
import struct
from dataclasses import dataclass, field
from math import cos, hypot, sin
from typing import TYPE_CHECKING, Any

from tests.planner.mission.fakes import PERIOD_S, FakeBridge
from wire import LegReport, Mode, Pose2, Record, Status, Waypoints, wrap

if TYPE_CHECKING:
    from collections.abc import Callable

FIELDS = ("x_m", "y_m", "yaw_rad", "turned_rad", "gone_m", "seq", "writes")
SPEED_MPS, TURN_RADPS = 0.5, 1.0
FRAME = struct.Struct(f"{len(FIELDS)}d")
TEXT = 256
"""Bytes of text behind the numbers."""


class MinimalBody:
    """Hold where the robot is and how far it came, in memory that forked processes share."""

    def __init__(self) -> None:
        object.__setattr__(self, "_memory", mmap.mmap(-1, FRAME.size + TEXT))
        self.x_m, self.y_m = 1.5, 2.0

    def __getattr__(self, name: str) -> float:
        if name not in FIELDS:
            raise AttributeError(name)
        return float(FRAME.unpack(self._memory[: FRAME.size])[FIELDS.index(name)])

    def __setattr__(self, name: str, value: float) -> None:
        values = list(FRAME.unpack(self._memory[: FRAME.size]))
        values[FIELDS.index(name)] = float(value)
        self._memory[: FRAME.size] = FRAME.pack(*values)

    @property
    def leg(self) -> LegReport | None:
        """Return the leg that the bridge remembers: it outlives planners, too."""
        text = bytes(self._memory[FRAME.size :]).rstrip(b"\0")
        return LegReport.model_validate_json(text) if text else None

    def keep_leg(self, leg: LegReport | None) -> None:
        """Remember the newest leg."""
        text = leg.model_dump_json().encode() if leg is not None else b""
        self._memory[FRAME.size :] = text.ljust(TEXT, b"\0")

    if TYPE_CHECKING:
        _memory: mmap.mmap


@dataclass
class PaperBridge(FakeBridge):
    """Follow straight ways and spins; each poll is one status, and time goes with it."""

    body: MinimalBody = field(default_factory=MinimalBody)
    on_leg: Callable[[str, int], None] = lambda mission, leg: None

    @classmethod
    def of(cls, body: MinimalBody, on_leg: Callable[[str, int], None]) -> PaperBridge:
        """Return a bridge that was up before this planner: what comes now is another brain."""
        bridge = cls(body=body, on_leg=on_leg, seq=int(body.seq), last_owner="before")
        if (leg := body.leg) is not None:
            bridge.leg = leg.model_copy(update={"following": False})
        bridge.pose = Pose2(body.x_m, body.y_m, body.yaw_rad)
        return bridge

    def now_s(self) -> float:
        """Return the time [s]: it goes with the statuses, through all lives."""
        return 1000.0 + self.seq * PERIOD_S

    def status(self) -> Status | None:
        """Go on by one status."""
        said = self.step()
        self.body.seq = self.seq
        return said.model_copy(update={"base_in_odom": self.pose})

    def hear(self, message: Record) -> None:
        """Take a command; a path that is taken is a motion that begins."""
        before = self.horizon
        super().hear(message)
        taken = self.horizon is message and before is not message
        if self.leg is not None and self.leg != self.body.leg:
            self.body.keep_leg(self.leg)
        if taken and isinstance(message, Waypoints) and message.points:
            self.on_leg(message.mission, message.leg)

    def _move(self) -> float:
        horizon = self.horizon
        if horizon is None or not horizon.points or self.leg is None:
            return 0.0
        moved: Any = self._walk(SPEED_MPS * PERIOD_S)
        goal = horizon.points[-1].heading_rad
        left_rad = wrap(goal - self.pose.yaw_rad) if goal is not None and not self.ahead else 0.0
        step = max(-TURN_RADPS * PERIOD_S, min(TURN_RADPS * PERIOD_S, left_rad))
        self.pose = Pose2(self.pose.x_m, self.pose.y_m, wrap(self.pose.yaw_rad + step))
        body = self.body
        body.x_m, body.y_m, body.yaw_rad = self.pose.x_m, self.pose.y_m, self.pose.yaw_rad
        body.turned_rad += step
        if horizon.final and not self.ahead and abs(left_rad - step) < 0.01:
            self.leg = self.leg.model_copy(update={"reached": True, "following": False})
            self.body.keep_leg(self.leg)
            self.horizon, self.mode = None, Mode.HOLD
            return 0.0
        return float(moved) + abs(step)

    def _walk(self, left_m: float) -> float:
        """Go along the points, keeping the heading; return how far."""
        walked_m = 0.0
        while self.ahead and left_m > 0.0:
            point = self.ahead[0]
            gap_m = hypot(point.x_m - self.pose.x_m, point.y_m - self.pose.y_m)
            share = 1.0 if gap_m <= left_m else left_m / gap_m
            dx = share * (point.x_m - self.pose.x_m)
            dy = share * (point.y_m - self.pose.y_m)
            self.pose = Pose2(self.pose.x_m + dx, self.pose.y_m + dy, self.pose.yaw_rad)
            ahead = self._ahead(dx, dy)
            self.body.gone_m += ahead
            walked_m += abs(ahead)
            if share < 1.0:
                break
            left_m -= gap_m
            del self.ahead[0]
        return walked_m

    def _ahead(self, dx: float, dy: float) -> float:
        return dx * cos(self.pose.yaw_rad) + dy * sin(self.pose.yaw_rad)
