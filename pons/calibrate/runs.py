"""Drive the runs: back and forth in a line at two speeds, once round on the spot. Knows the rig.

A run begins and ends standing. Its stop is the letting go of the dead-man, so the ordinary stop of
the bridge is what is measured.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from pons.calibrate.track import DriveTrack

if TYPE_CHECKING:
    from pons.calibrate.reference import WallLook
    from pons.calibrate.session import CalibrationRig
    from wire import RobotDescription

SLOW_MPS, SLOW_S = 0.06, 2.2
SETTLES_S = 0.9
"""After a change of speed; then wheel control has settled."""
FAST_MPS, FAST_SHARE = 0.35, 0.7
TURN_RADPS, TURN_SHARE = 0.8, 0.7
EVEN_S = 0.5
"""Of even fast speed before the stop is what the fit of the dead zone uses."""
SETTLED_TICKS = round(SETTLES_S * 100)
EVEN_TICKS = round(EVEN_S * 100)


@dataclass(frozen=True, slots=True)
class Run:
    """Hold one run's recording, from standing to standing."""

    track: DriveTrack
    before: WallLook
    after: WallLook


def stopping_m(mps: float, robot: RobotDescription) -> float:
    """Return how far the robot rolls on once the stick is let go at a speed."""
    return 0.1 * mps + mps * mps / (2 * robot.limits.max_decel_mps2) + 0.02


def straight(rig: CalibrationRig, robot: RobotDescription, metres: float) -> Run:
    """Drive so many believed metres, backwards if negative; slowly at first."""
    sign = 1.0 if metres > 0.0 else -1.0
    fast_mps = min(FAST_MPS, FAST_SHARE * robot.limits.max_speed_mps)
    before, track = rig.look(), DriveTrack()
    with rig.hold(track):
        began_s = rig.now_s
        track.mark("slow")
        rig.steer(sign * SLOW_MPS, 0.0, lambda: rig.now_s - began_s >= SLOW_S, 2 * SLOW_S)
        track.mark("fast")
        rolled = _WheelRun(track, robot)
        target_m = abs(metres) - stopping_m(fast_mps, robot)
        limit_s = 4.0 + 2.0 * abs(metres) / fast_mps
        rig.steer(sign * fast_mps, 0.0, lambda: rolled.metres() >= target_m, limit_s)
        track.mark("stop")
    return Run(track, before, rig.look())


def turn(rig: CalibrationRig, robot: RobotDescription, angle_rad: float) -> Run:
    """Turn on the spot by about so much, clockwise if negative."""
    sign = 1.0 if angle_rad > 0.0 else -1.0
    radps = min(TURN_RADPS, TURN_SHARE * robot.limits.max_turn_radps)
    rim_mps = radps * robot.base.wheel_separation_m / 2
    stop_rad = radps * (0.1 + rim_mps / (2 * robot.limits.max_decel_mps2))
    before, track = rig.look(), DriveTrack()
    with rig.hold(track):
        rolled = _WheelRun(track, robot)
        target_rad = abs(angle_rad) - stop_rad
        limit_s = 5.0 + 2.0 * abs(angle_rad) / radps
        rig.steer(0.0, sign * radps, lambda: rolled.radians() >= target_rad, limit_s)
        track.mark("stop")
    return Run(track, before, rig.look())


ROUND_RAD = 2 * pi


@dataclass(frozen=True, slots=True)
class _WheelRun:
    """Tell how far the wheels say the robot came in a run, by robot.toml's geometry."""

    track: DriveTrack
    robot: RobotDescription

    def metres(self) -> float:
        """Return the path [m], without sign."""
        left, right = self._wheels()
        return abs(left + right) / 2 * self.robot.base.wheel_radius_m

    def radians(self) -> float:
        """Return the turn [rad], without sign."""
        left, right = self._wheels()
        base = self.robot.base
        return abs(right - left) * base.wheel_radius_m / base.wheel_separation_m

    def _wheels(self) -> tuple[float, float]:
        return self.track.turned_rad() if len(self.track.states) > 1 else (0.0, 0.0)
