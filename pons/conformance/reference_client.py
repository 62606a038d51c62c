"""Be a well-behaved brain that drives to and fro on a line, by velocity or by waypoints. Pure.

Told each status of the bridge; answers with plain dictionaries, because those who break them need
no message that is checked at birth.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import remainder, tau
from typing import TYPE_CHECKING, Any

from wire import PROTOCOL, Mode

if TYPE_CHECKING:
    from pons.conformance.track import TestTrack
    from wire import OwnerKind, Pose2, Status

Said = tuple[str, dict[str, Any]]
"""A key and what is said on it."""

CRUISE_MPS = 0.45
VELOCITY_S, WAYPOINTS_S = 0.047, 0.095
"""20 and 10 Hz, less the jitter of what they are sent on."""
TURN_BACK_M = 0.30
STEP_M = 0.1
POINTS = 14
TTL_S = 0.5
METRES, SECONDS = 60.0, 600.0
ENOUGH_M = 8.0
"""With less left of a grant a new mission is asked for, standing or not."""
ASTRAY_RAD = 0.6
FULL_TURN_RADPS = 0.6
GRANTED_IN = frozenset({Mode.HOLD, Mode.ACTIVE, Mode.STOPPING})


@dataclass
class ReferenceBrain:
    """Hold one brain's memory."""

    kind: OwnerKind
    brain_id: str
    track: TestTrack
    metres: float = METRES
    asks: bool = True
    """It wants to drive; without it only shows that it lives."""
    mission: str = "line-0"
    heading: int = 1
    leg: int = 0
    sent_s: float = field(default=float("-inf"))
    missions: int = 0

    def answer(self, status: Status, now_s: float, seq: int) -> list[Said]:
        """Return all that is due on a new status."""
        if status.owner is None or status.owner.planner_id != self.brain_id:
            return [self.hello(status)]
        said = [self.heartbeat(status)]
        grant = status.grant
        spent = grant is not None and grant.mission == self.mission and grant.metres < ENOUGH_M
        if spent and self.metres == METRES:
            self.new_mission()
        if self.asks and status.held is None and status.mode in GRANTED_IN:
            if grant is None or grant.mission != self.mission:
                said.append(self.grant(status))
            else:
                said += self.drive(status, now_s, seq)
        return said

    def drive(self, status: Status, now_s: float, seq: int) -> list[Said]:
        """Return a velocity or a horizon, if one is due."""
        period_s = VELOCITY_S if self.kind == "external" else WAYPOINTS_S
        if status.base_in_map is None or not now_s - self.sent_s >= period_s:
            return []
        self.sent_s = now_s
        along_m, _ = self.track.along(status.base_in_map)
        if self.heading > 0 and along_m > self.track.length_m - TURN_BACK_M:
            self.heading, self.leg = -1, self.leg + 1
        elif self.heading < 0 and along_m < TURN_BACK_M:
            self.heading, self.leg = 1, self.leg + 1
        if self.kind == "external":
            return [self.velocity(status, seq, *self._steer(status.base_in_map))]
        return [self.waypoints(status, seq, self.points(along_m))]

    def new_mission(self) -> None:
        """Ask for a grant of another mission from now on."""
        self.missions += 1
        self.mission, self.leg = f"line-{self.brain_id}-{self.missions}", 0

    # What is said -------------------------------------------------------------------------------

    def hello(self, status: Status) -> Said:
        """Ask to own the robot, believing the bridge's word on it."""
        return "cmd/hello", {
            "planner_id": self.brain_id, "kind": self.kind, "seen": status.seq,
            "protocol": PROTOCOL, "robot_hash": status.robot_hash,
            "fence_hash": status.fence_hash, "map_id": status.map_id,
        }  # fmt: skip

    def heartbeat(self, status: Status) -> Said:
        """Show that it lives and thinks."""
        return "cmd/heartbeat", {**self._stamp(status), "used": status.seq}

    def grant(self, status: Status) -> Said:
        """Ask for leave to move."""
        budget = {"mission": self.mission, "metres": self.metres, "seconds": SECONDS}
        return "cmd/grant", {**self._stamp(status), **budget}

    def velocity(self, status: Status, seq: int, v_mps: float, w_radps: float) -> Said:
        """Ask for a speed and a turn, the dead-man held."""
        return "cmd/external", {
            "source_id": self.brain_id, "epoch": status.epoch, "seq": seq,
            "seen": status.seq, "v_mps": v_mps, "w_radps": w_radps, "dead_man": True,
        }  # fmt: skip

    def waypoints(self, status: Status, seq: int, points: list[dict[str, float]]) -> Said:
        """Stream a horizon."""
        return "cmd/waypoints", {
            **self._stamp(status), "seq": seq, "mission": self.mission, "leg": self.leg,
            "map_id": status.map_id, "ttl_s": TTL_S, "points": points, "final": False,
        }  # fmt: skip

    def _stamp(self, status: Status) -> dict[str, Any]:
        return {"planner_id": self.brain_id, "epoch": status.epoch, "seen": status.seq}

    def _steer(self, pose: Pose2) -> tuple[float, float]:
        """Keep to the line, forwards or backwards; turn on the spot where far astray."""
        _, left_m = self.track.along(pose)
        astray_rad = remainder(pose.yaw_rad - self.track.heading_rad, tau)
        v = CRUISE_MPS * self.heading if abs(astray_rad) < ASTRAY_RAD else 0.0
        w = -1.5 * astray_rad - 2.0 * left_m * v
        return v, max(-FULL_TURN_RADPS, min(FULL_TURN_RADPS, w))

    def points(self, along_m: float) -> list[dict[str, float]]:
        """Return the way ahead to the line's end, a step apart."""
        end_m = self.track.length_m if self.heading > 0 else 0.0
        rest_m = abs(end_m - along_m)
        count = min(POINTS, int(rest_m / STEP_M))
        ahead = [along_m + self.heading * STEP_M * (n + 0.5) for n in range(count)]
        places = [self.track.at(one) for one in ahead]
        speed = CRUISE_MPS * self.heading
        return [{"x_m": x, "y_m": y, "speed_mps": speed} for x, y in places]


def number(now_s: float) -> int:
    """Return a seq that rises with time, whichever of one brain's processes counts."""
    return round(now_s * 1e5)
