"""Play a well-behaved drive and planner against the core; each misbehaves by a switch."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Any

from bridge.core import Decision
from wire import (
    PROTOCOL,
    DriveState,
    Grant,
    Heartbeat,
    Hello,
    Pose2,
    Status,
    Waypoint,
    Waypoints,
)

BOOT = "b0"
MAP_ID = "a" * 16
FENCE_HASH = "f" * 16
PERIOD_S = 0.01


@dataclass
class FakeDrive:
    """Follow wheel commands with a first-order lag, and stop by itself when nobody speaks."""

    boot_id: str = "d0"
    seq: int = 0
    echo_boot: str | None = None
    echo_seq: int = 0
    heard_s: float | None = None
    target: tuple[float, float] = (0.0, 0.0)
    enabled: bool = False
    angles: tuple[float, float] = (0.0, 0.0)
    speeds: tuple[float, float] = (0.0, 0.0)
    estop_pressed: bool | None = False
    battery: float | None = None
    current_a: float | None = None
    pressed: tuple[str, ...] = ()
    """Bumpers, or the cliff sensor."""
    deaf: bool = False
    """Hears no commands but reports."""
    runs_on: bool = False
    """Ignores what it is told and keeps its speed."""
    never_times_out: bool = False
    tells_time_out: bool = True
    """False: it stops in silence and says nothing of it."""

    def tick(self, now_s: float) -> DriveState:
        late = self.heard_s is None or now_s - self.heard_s > 0.2
        timed_out = late and not self.never_times_out
        wanted = (0.0, 0.0) if timed_out or not self.enabled else self.target
        share = PERIOD_S / 0.04
        if not self.runs_on:
            left, right = self.speeds
            self.speeds = (
                left + share * (wanted[0] - left),
                right + share * (wanted[1] - right),
            )
        self.angles = (
            self.angles[0] + self.speeds[0] * PERIOD_S,
            self.angles[1] + self.speeds[1] * PERIOD_S,
        )
        self.seq += 1
        return DriveState(
            boot_id=self.boot_id,
            seq=self.seq,
            stamp_s=now_s,
            echo_boot=self.echo_boot,
            echo_seq=self.echo_seq,
            enabled=self.enabled and not timed_out,
            timed_out=timed_out if self.tells_time_out else None,
            left_rad=self.angles[0],
            right_rad=self.angles[1],
            left_radps=self.speeds[0],
            right_radps=self.speeds[1],
            estop_pressed=self.estop_pressed,
            battery=self.battery,
            current_a=self.current_a,
            bumper_front="bumper_front" in self.pressed,
            bumper_rear="bumper_rear" in self.pressed,
            cliff="cliff" in self.pressed,
        )

    def hear(self, decision: Decision, now_s: float) -> None:
        command = decision.command
        if command is None or self.deaf:
            return
        self.heard_s = now_s
        self.echo_boot, self.echo_seq = command.boot, command.seq
        self.enabled = command.enable
        self.target = (command.left_radps, command.right_radps)


@dataclass
class FakePlanner:
    """Own, grant, stream and beat as PROTOCOL asks, on each status it is shown."""

    planner_id: str = "p1"
    mission: str | None = None
    leg: int = 1
    goal_m: tuple[float, float] | None = None
    """None streams a horizon of no points."""
    metres: float = 20.0
    seconds: float = 120.0
    silent: bool = False
    ttl_s: float = 0.5
    seq: int = 0
    status: Status | None = None
    used: int | None = None
    """Pin what heartbeats say was used; None tells the truth."""
    next_horizon_s: float = 0.0

    def says(self, status: Status | None, now_s: float) -> dict[str, Any]:
        """Return what it puts in the next inbox, by field."""
        if self.silent:
            return {}
        said: dict[str, Any] = {}
        if status is not None:
            self.status = status
            said = self._on_status(status)
        if self.status is None:
            return said
        if self._owns(self.status) and self._granted(self.status) and now_s >= self.next_horizon_s:
            self.next_horizon_s = now_s + 0.1 - 1e-6
            said["waypoints"] = (self.horizon(self.status),)
        return said

    def _owns(self, status: Status) -> bool:
        return status.owner is not None and status.owner.planner_id == self.planner_id

    def _granted(self, status: Status) -> bool:
        return status.grant is not None and status.grant.mission == self.mission

    def _on_status(self, status: Status) -> dict[str, Any]:
        if not self._owns(status):
            return {"hellos": (self.hello(status),)}
        used = status.seq if self.used is None else self.used
        beat = Heartbeat(planner_id=self.planner_id, epoch=status.epoch, seen=status.seq, used=used)
        said: dict[str, Any] = {"heartbeats": (beat,)}
        if self.mission is not None and not self._granted(status):
            grant = Grant(
                planner_id=self.planner_id,
                epoch=status.epoch,
                seen=status.seq,
                mission=self.mission,
                metres=self.metres,
                seconds=self.seconds,
            )
            said["grants"] = (grant,)
        return said

    def hello(self, status: Status) -> Hello:
        return Hello(
            planner_id=self.planner_id,
            kind="planner",
            seen=status.seq,
            protocol=PROTOCOL,
            robot_hash=status.robot_hash,
            fence_hash=status.fence_hash,
            map_id=MAP_ID,
        )

    def horizon(self, status: Status) -> Waypoints:
        self.seq += 1
        points: tuple[Waypoint, ...] = ()
        final = False
        if self.goal_m is not None and status.base_in_map is not None:
            points, final = straight(status.base_in_map, self.goal_m)
        return Waypoints(
            planner_id=self.planner_id,
            epoch=status.epoch,
            seq=self.seq,
            seen=status.seq,
            mission=self.mission or "m",
            leg=self.leg,
            map_id=MAP_ID,
            ttl_s=self.ttl_s,
            points=points,
            final=final,
        )


def straight(
    here: Pose2, goal_m: tuple[float, float], speed_mps: float = 0.4
) -> tuple[tuple[Waypoint, ...], bool]:
    """Return a straight horizon of at most 30 points, and whether it ends at the goal."""
    dx, dy = goal_m[0] - here.x_m, goal_m[1] - here.y_m
    away = hypot(dx, dy)
    if away < 0.06:
        return (Waypoint(x_m=goal_m[0], y_m=goal_m[1], speed_mps=speed_mps),), True
    count = max(1, int(away / 0.1))
    points = tuple(
        Waypoint(
            x_m=here.x_m + dx * index / count,
            y_m=here.y_m + dy * index / count,
            speed_mps=speed_mps,
        )
        for index in range(min(count, 29) + 1)
    )
    return points, count <= 29
