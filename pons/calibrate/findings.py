"""Turn runs into values for robot.toml, each with its evidence, or refuse them.

Safety values are never better than the worst run: lag_s is the longest seen, max_decel_mps2 is not
raised and not above the weakest stop. Knows no sessions and no files.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, isfinite
from statistics import fmean, median
from typing import TYPE_CHECKING

from pydantic import ValidationError

from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.motor import LEFT, RIGHT, braking_radps2, fit_motor, plateau, statics
from pons.calibrate.runs import EVEN_TICKS, SETTLED_TICKS
from pons.calibrate.track import TICK_S
from wire import RobotDescription
from wire.robot import explain

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pons.calibrate.runs import Run

RADIUS_SPREAD, SEPARATION_SPREAD, BRAKING_SPREAD = 0.015, 0.02, 0.15
"""Largest less smallest, as a share of the median."""
DEAD_ZONE_SPREAD_RADPS, LAG_SPREAD_S = 0.03, 0.04
PLAUSIBLE = (0.75, 1.33)
"""Of what robot.toml said: beyond it, the measure is wrong rather than the robot."""


@dataclass(frozen=True, slots=True)
class StraightRun:
    """Hold what one run in a line showed; for the mean of both wheels unless said otherwise."""

    radius_m: float
    dead_zone_radps: float
    gains: tuple[float, float]
    """Left, right: how much a wheel turns of what it is told, past the dead zone."""
    response_s: float
    lag_s: float
    """From the bridge's word to the slower wheel: way there, delay and lag."""
    transport_s: float
    braking_radps2: float
    """Of the wheel that brakes less."""


@dataclass(frozen=True, slots=True)
class CalibrationFinding:
    """Give one value, its evidence, and the former one."""

    table: str
    key: str
    was: float
    value: float
    evidence: str

    @property
    def name(self) -> str:
        """Return how the value is called in robot.toml."""
        return f"{self.table}.{self.key}"


def of_straight(run: Run, went_m: float) -> StraightRun:
    """Read one run in a line.

    Args:
        run: it.
        went_m: how far it truly went, without sign [m].

    Raises:
        RunLost: it cannot be read.
    """
    track = run.track
    ticks, marks = track.ticks(), track.marks
    slow = marks["slow"] + SETTLED_TICKS, marks["fast"]
    fast = marks["stop"] - EVEN_TICKS, marks["stop"]
    motors = []
    for wheel in (LEFT, RIGHT):
        dead_zone, gain = statics(plateau(ticks, wheel, *slow), plateau(ticks, wheel, *fast))
        motors.append(fit_motor(ticks, wheel, dead_zone, gain))
    rolled_rad = abs(sum(track.turned_rad())) / 2
    transport_s = median(track.behind) * TICK_S if track.behind else TICK_S
    return StraightRun(
        radius_m=went_m / rolled_rad,
        dead_zone_radps=fmean(motor.dead_zone_radps for motor in motors),
        gains=(motors[LEFT].gain, motors[RIGHT].gain),
        response_s=fmean(motor.lag_s for motor in motors),
        lag_s=max(motor.lag_s + motor.delay_s for motor in motors) + transport_s,
        transport_s=transport_s,
        braking_radps2=braking_radps2(ticks, marks["stop"]),
    )


def separation_m(run: Run, turned_rad: float, radius_m: float) -> float:
    """Return the wheel separation that one turn on the spot shows [m]."""
    left, right = run.track.turned_rad()
    return abs(right - left) * radius_m / abs(turned_rad)


def findings(
    straights: Sequence[StraightRun],
    separations_m: Sequence[float],
    robot: RobotDescription,
    reference: str,
    when: str,
) -> list[CalibrationFinding]:
    """Return every value with its evidence.

    Args:
        straights: the runs in a line.
        separations_m: of each turn.
        robot: what robot.toml says now.
        reference: spoken name of what distances were compared with.
        when: UTC time, for the evidence.

    Raises:
        CalibrationRefusal: ``spread_too_wide`` or ``out_of_bounds``.
    """
    base, limits, drive = robot.base, robot.limits, robot.drive
    radius_m = radius_of(straights, robot)
    apart_m = close("wheel_separation_m", separations_m, SEPARATION_SPREAD)
    dead = [run.dead_zone_radps for run in straights]
    dead_zone = _near("dead_zone_radps", dead, DEAD_ZONE_SPREAD_RADPS)
    response = [run.response_s for run in straights]
    _near("response_s", response, LAG_SPREAD_S)
    response_s = _round_down(min(response), 3)
    lags = [run.lag_s for run in straights]
    _near("lag_s", lags, LAG_SPREAD_S)
    braking = [run.braking_radps2 * radius_m for run in straights]
    close("max_decel_mps2", braking, BRAKING_SPREAD)
    kp, ki_per_s = gains(response_s, median(run.transport_s for run in straights))
    gain = ", ".join(
        f"{side} {median(run.gains[wheel] for run in straights):.3f}"
        for side, wheel in (("left", LEFT), ("right", RIGHT))
    )
    outside, inside = f"against {reference}", f"by the encoders; wheels turn {gain} of what is told"
    seen = _Evidence(when)
    found = [
        CalibrationFinding("base", "wheel_radius_m", base.wheel_radius_m, round(radius_m, 5),
                seen.of([run.radius_m for run in straights], 4, outside)),
        CalibrationFinding("base", "wheel_separation_m", base.wheel_separation_m, round(apart_m, 4),
                seen.of(separations_m, 4, outside)),
        CalibrationFinding("limits", "max_decel_mps2", limits.max_decel_mps2,
                min(limits.max_decel_mps2, _round_down(min(braking), 2)),
                seen.of(braking, 3, "never more than the weakest stop, never raised")),
        CalibrationFinding("drive", "lag_s", drive.lag_s, _round_up(max(lags), 3),
                seen.of(lags, 3, "the longest counts: way to the drive, delay and motor")),
        CalibrationFinding("drive", "dead_zone_radps", drive.dead_zone_radps, round(dead_zone, 3),
                seen.of(dead, 3, inside)),
        CalibrationFinding("drive", "response_s", drive.response_s, response_s,
                seen.of(response, 3, "the shortest counts")),
        CalibrationFinding("drive", "kp", drive.kp, kp, seen.by_rule(response_s)),
        CalibrationFinding("drive", "ki_per_s", drive.ki_per_s, ki_per_s, seen.by_rule(response_s)),
    ]  # fmt: skip
    plausible("base.wheel_separation_m", apart_m, base.wheel_separation_m)
    check_limits(robot, found)
    return found


def radius_of(straights: Sequence[StraightRun], robot: RobotDescription) -> float:
    """Return the wheel radius that the runs in a line agree on [m].

    Raises:
        CalibrationRefusal: ``spread_too_wide`` or ``out_of_bounds``.
    """
    radius_m = close("base.wheel_radius_m", [run.radius_m for run in straights], RADIUS_SPREAD)
    plausible("base.wheel_radius_m", radius_m, robot.base.wheel_radius_m)
    return radius_m


def gains(response_s: float, transport_s: float) -> tuple[float, float]:
    """Return kp and ki [1/s] for a motor with this lag behind this way.

    Skogestad's rule for a first-order lag T behind a delay L: kp = T / (C + L), integral time
    min(T, 4 (C + L)). The closed loop's time C is the motor's own, or twice the delay where that is
    longer: no faster than the motor would be alone, so that even twice the gain is stable.
    """
    delay_s = transport_s + TICK_S
    closed_s = max(response_s, 2 * delay_s)
    kp = response_s / (closed_s + delay_s)
    return round(kp, 2), round(kp / min(response_s, 4 * (closed_s + delay_s)), 1)


@dataclass(frozen=True, slots=True)
class _Evidence:
    """Word the evidence of a value."""

    when: str

    def of(self, values: Sequence[float], digits: int, how: str) -> str:
        """Give median and spread."""
        low, high = min(values), max(values)
        return (
            f"calibrated {self.when}: median {median(values):.{digits}f}, "
            f"{low:.{digits}f} to {high:.{digits}f} in {len(values)} runs, {how}"
        )

    def by_rule(self, response_s: float) -> str:
        """Give the source that a gain was derived from."""
        return f"calibrated {self.when}: derived from a motor of {response_s:.3f} s and its delay"


def close(name: str, values: Sequence[float], share: float) -> float:
    """Return the median of values that lie together, by share of it."""
    middle = median(values)
    if not (all(isfinite(one) for one in values) and _spread(values) <= share * middle):
        text = f"{name}: {min(values):.4f} to {max(values):.4f}, allowed {100 * share:.1f} % apart"
        raise CalibrationRefusal("spread_too_wide", text)
    return middle


def _near(name: str, values: Sequence[float], apart: float) -> float:
    """Return the median of values that lie together, by distance."""
    if not (all(isfinite(one) for one in values) and _spread(values) <= apart):
        text = f"{name}: {min(values):.3f} to {max(values):.3f}, allowed {apart:.3f} apart"
        raise CalibrationRefusal("spread_too_wide", text)
    return median(values)


def _spread(values: Sequence[float]) -> float:
    return max(values) - min(values)


def _round_up(value: float, digits: int) -> float:
    return float(ceil(value * 10**digits - 1e-9)) / float(10**digits)


def _round_down(value: float, digits: int) -> float:
    return float(floor(value * 10**digits + 1e-9)) / float(10**digits)


def plausible(name: str, value: float, was: float) -> None:
    """See that a value is not so far from the former one that the measure must be wrong.

    Raises:
        CalibrationRefusal: ``out_of_bounds``.
    """
    low, high = PLAUSIBLE
    if not low * was <= value <= high * was:
        text = f"{name}: {value:.4g}, {was:.4g} in robot.toml; was the measure right?"
        raise CalibrationRefusal("out_of_bounds", text)


def check_limits(robot: RobotDescription, found: Sequence[CalibrationFinding]) -> None:
    """See that robot.toml may hold all of it."""
    told = robot.model_dump(exclude_unset=True)  # some keys may not be given where they are fixed
    for one in found:
        told.setdefault(one.table, {})[one.key] = one.value
    try:
        RobotDescription.model_validate(told, strict=True)
    except ValidationError as error:
        raise CalibrationRefusal("out_of_bounds", explain(error)) from None
