"""Find the track that counts in turns: turn on the spot, and compare the wheels with the gyro.

Four wheels and tracks skid sideways where they turn, so that the robot turns less than two wheels
so far apart would turn it: as if they stood 1.3 to 2 times as far apart. Needs what the bridge says
of every robot (its odometry with the gyro's rate in it), so it works on bases that report seldom.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi
from statistics import median
from typing import TYPE_CHECKING

from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.findings import CalibrationFinding, check_limits, close
from pons.calibrate.procedure import ready, take_runs
from wire import wrap

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pons.calibrate.procedure import CalibrationPlan
    from pons.calibrate.session import CalibrationRig
    from wire import Odometry, RobotDescription

ROUND_RAD = 2 * pi
TURN_RADPS, TURN_SHARE = 0.6, 0.7
STANDS_S = 1.0
SHAKES_RADPS = 0.02
"""Of a gyro whose bias was taken away, standing."""
GAP_S = 0.25
LEAST_RAD = 1.0
SPREAD = 0.05
"""Wheels that skid never do so twice alike."""
PLAUSIBLE = (0.6, 2.3)
"""Of what robot.toml said: the geometry of four wheels may stand there."""


@dataclass(frozen=True, slots=True)
class TurnSeen:
    """Hold by how much one turn was, as wheels and gyro say; signed [rad]."""

    by_wheels_rad: float
    by_gyro_rad: float

    @property
    def ratio(self) -> float:
        """Return how much more the wheels say than the gyro."""
        return self.by_wheels_rad / self.by_gyro_rad


def find_track(
    rig: CalibrationRig,
    robot: RobotDescription,
    plan: CalibrationPlan,
    when: str,
    say: Callable[[str], None],
) -> list[CalibrationFinding]:
    """Turn and measure; the robot stands when this returns or raises.

    Raises:
        CalibrationRefusal: nothing was measured that may be believed.
    """
    if not robot.inputs.imu:
        raise CalibrationRefusal("no_gyro", "inputs.imu is false")
    ready(rig.listen(needs_senses=False), robot)
    was_m = robot.base.wheel_separation_m
    turns = take_runs(
        rig, plan, say, "turn", plan.turns, lambda sign: _turn(rig, robot, sign),
        lambda seen: f"wheels {seen.by_wheels_rad:+.2f} rad, gyro {seen.by_gyro_rad:+.2f} rad, "
        f"track {was_m * seen.ratio:.4f} m",
    )  # fmt: skip
    return _finding([was_m * seen.ratio for seen in turns], robot, when)


def seen_in(said: Sequence[Odometry]) -> TurnSeen:
    """Return what one turn was; it begins and ends with the robot standing.

    Raises:
        RunLost, CalibrationRefusal: it can't be read.
    """
    if len(said) < 3:
        raise RunLost("run_lost", "no odometry was heard")
    rates = [one.yaw_rate_radps for one in said]
    known = [rate for rate in rates if rate is not None]
    if len(known) < len(rates):
        raise CalibrationRefusal("no_gyro", "the gyro says nothing; pons doctor, line gyro")
    if any(one.odom_id != said[0].odom_id for one in said):
        raise RunLost("run_lost", "odometry began anew")
    gap_s = max(after.stamp_s - before.stamp_s for before, after in pairwise(said))
    if gap_s > GAP_S:
        raise RunLost("run_lost", f"no odometry for {gap_s:.2f} s")
    still = [rate for one, rate in zip(said, known, strict=True)
             if one.stamp_s - said[0].stamp_s <= STANDS_S / 2]  # fmt: skip
    bias_radps = sum(still) / len(still)
    if not abs(bias_radps) <= SHAKES_RADPS:
        raise RunLost("run_lost", f"standing, the gyro says {bias_radps:+.3f} rad/s")
    by_wheels = by_gyro = 0.0
    for at in range(1, len(said)):
        before, now = said[at - 1], said[at]
        by_wheels += wrap(now.base_in_odom.yaw_rad - before.base_in_odom.yaw_rad)
        mean_radps = (known[at - 1] + known[at]) / 2.0 - bias_radps
        by_gyro += mean_radps * (now.stamp_s - before.stamp_s)
    return TurnSeen(by_wheels, by_gyro)


def _turn(rig: CalibrationRig, robot: RobotDescription, sign: float) -> TurnSeen:
    """Turn once round by the gyro.

    Raises:
        CalibrationRefusal, RunLost: it was not a turn.
    """
    radps = min(TURN_RADPS, TURN_SHARE * robot.limits.max_turn_radps)
    said: list[Odometry] = []
    turned = _TurnCount(said)
    limit_s = 5.0 + 3.0 * ROUND_RAD / radps
    with rig.hold(odometry=said, stands_s=STANDS_S):
        rig.steer(0.0, sign * radps, lambda: turned.radians() >= ROUND_RAD, limit_s)
    return believable(seen_in(said))


def believable(seen: TurnSeen) -> TurnSeen:
    """Return a turn in which wheels and gyro went the same way.

    Raises:
        CalibrationRefusal: ``gyro_stands`` or ``gyro_backwards``.
    """
    if not abs(seen.by_gyro_rad) >= LEAST_RAD:
        text = f"wheels {seen.by_wheels_rad:+.2f} rad, gyro {seen.by_gyro_rad:+.2f} rad"
        raise CalibrationRefusal("gyro_stands", text)
    if not seen.by_gyro_rad * seen.by_wheels_rad > 0.0:
        text = f"wheels {seen.by_wheels_rad:+.2f} rad, gyro {seen.by_gyro_rad:+.2f} rad"
        raise CalibrationRefusal("gyro_backwards", text)
    return seen


class _TurnCount:
    """Count how far it turned by now, roughly: as the gyro says, or half of what wheels say.

    A gyro that stands or lies must not turn the robot for ever: wheels end it after two rounds.
    """

    def __init__(self, said: Sequence[Odometry]) -> None:
        self._said, self._at = said, 1
        self._gyro_rad = self._wheels_rad = 0.0

    def radians(self) -> float:
        """Return the turn [rad], without sign."""
        while self._at < len(self._said):
            before, now = self._said[self._at - 1], self._said[self._at]
            self._gyro_rad += (now.yaw_rate_radps or 0.0) * (now.stamp_s - before.stamp_s)
            self._wheels_rad += wrap(now.base_in_odom.yaw_rad - before.base_in_odom.yaw_rad)
            self._at += 1
        return max(abs(self._gyro_rad), abs(self._wheels_rad) / 2.0)


def _finding(tracks: list[float], robot: RobotDescription, when: str) -> list[CalibrationFinding]:
    """Return the track, if the turns agree and robot.toml may hold it.

    Raises:
        CalibrationRefusal: ``spread_too_wide`` or ``out_of_bounds``.
    """
    base = robot.base
    track_m = close("base.wheel_separation_m", tracks, SPREAD)
    low, high = PLAUSIBLE
    if not low * base.wheel_separation_m <= track_m <= high * base.wheel_separation_m:
        text = f"base.wheel_separation_m: {track_m:.4g}, {base.wheel_separation_m:.4g} before"
        raise CalibrationRefusal("out_of_bounds", text)
    times = "" if base.wheels_apart_m is None else (
        f", {track_m / base.wheels_apart_m:.2f} times the wheels' distance"
    )  # fmt: skip
    evidence = (
        f"calibrated {when}: median of {len(tracks)} turns, {min(tracks):.4f} to "
        f"{max(tracks):.4f}; wheels against the gyro{times}"
    )
    was_m, value_m = base.wheel_separation_m, round(median(tracks), 4)
    found = [CalibrationFinding("base", "wheel_separation_m", was_m, value_m, evidence)]
    check_limits(robot, found)
    return found
