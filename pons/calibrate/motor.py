"""Find a motor's dead zone, gain and lag, and its braking, in one straight run's recording.

The model is the one that wheel control feeds forward: what is told, less the dead zone, times a
gain, through a first-order lag and whole ticks of delay. Pure arithmetic on ticks; knows no wire.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, exp
from statistics import fmean
from typing import TYPE_CHECKING

from pons.calibrate.errors import RunLost
from pons.calibrate.track import TICK_S

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pons.calibrate.track import TrackTick

LEFT, RIGHT = 0, 1
SHORTEST_LAG_S, LONGEST_LAG_S = 0.002, 0.5
DELAYS = range(5)
SLOPE_FROM, SLOPE_TO = 0.80, 0.25
"""Shares of the speed between which a stop's deceleration is even, jerk left out."""
FEWEST = 5
GOLDEN = (5**0.5 - 1) / 2


@dataclass(frozen=True, slots=True)
class Motor:
    """Describe one wheel's motor as one run showed it."""

    dead_zone_radps: float
    gain: float
    lag_s: float
    delay_s: float


def plateau(ticks: Sequence[TrackTick], wheel: int, begin: int, end: int) -> tuple[float, float]:
    """Return the means of a wheel's commanded and real speed between two ticks [rad/s].

    Raises:
        RunLost: too few ticks were heard there.
    """
    within = [tick for tick in ticks if begin <= tick.seq < end]
    told = [tick.told[wheel] for tick in within]
    did = [tick.did[wheel] for tick in within if tick.did is not None]
    if len(did) < FEWEST:
        raise RunLost("run_lost", f"{len(did)} ticks at an even speed, expected {FEWEST} or more")
    return fmean(told), fmean(did)


def statics(slow: tuple[float, float], fast: tuple[float, float]) -> tuple[float, float]:
    """Return dead zone [rad/s] and gain from two even speeds: did = gain (told - dead zone).

    Raises:
        RunLost: the wheel did not turn as told, or hardly.
    """
    told, did = abs(fast[0]) - abs(slow[0]), abs(fast[1]) - abs(slow[1])
    if not (told > 0.2 and did > 0.05 and slow[0] * slow[1] > 0.0 and fast[0] * fast[1] > 0.0):
        text = f"told {slow[0]:.2f} and {fast[0]:.2f} rad/s, turned {slow[1]:.2f} and {fast[1]:.2f}"
        raise RunLost("encoder_fault", text)
    gain = did / told
    return max(0.0, abs(slow[0]) - abs(slow[1]) / gain), gain


def fit_motor(ticks: Sequence[TrackTick], wheel: int, dead_zone_radps: float, gain: float) -> Motor:
    """Return the lag and delay with which the model comes nearest to the wheel's motion."""
    told = [_beyond_dead_zone(tick.told[wheel], dead_zone_radps, gain) for tick in ticks]
    did = [None if tick.did is None else tick.did[wheel] for tick in ticks]
    best = (float("inf"), SHORTEST_LAG_S, 0)
    for delay in DELAYS:
        lag_s, error = _best_lag(told, did, delay)
        best = min(best, (error, lag_s, delay))
    _, lag_s, delay = best
    return Motor(dead_zone_radps, gain, lag_s, delay * TICK_S)


def _beyond_dead_zone(told: float, dead_zone: float, gain: float) -> float:
    return copysign(gain * max(0.0, abs(told) - dead_zone), told)


def _best_lag(
    told: Sequence[float], did: Sequence[float | None], delay: int
) -> tuple[float, float]:
    """Search by the golden section: the error of a first-order lag has one valley.

    Each step keeps one of the two errors that it looked at, so it costs one more.
    """
    wishes = [told[max(0, index - delay)] for index in range(len(told))]
    low, high = SHORTEST_LAG_S, LONGEST_LAG_S
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = _error(wishes, did, left), _error(wishes, did, right)
    while high - low > 5e-4:
        if at_left < at_right:
            high, right, at_right = right, left, at_left
            left = high - GOLDEN * (high - low)
            at_left = _error(wishes, did, left)
        else:
            low, left, at_left = left, right, at_right
            right = low + GOLDEN * (high - low)
            at_right = _error(wishes, did, right)
    lag_s = (low + high) / 2
    return lag_s, _error(wishes, did, lag_s)


def _error(wishes: Sequence[float], did: Sequence[float | None], lag_s: float) -> float:
    """Return the mean square by which the model misses what the encoder counted in each tick.

    Within a tick the wish w is even, so the speed goes from y to w + (y - w) e and its mean, which
    is what an encoder counts, is w + (y - w) (1 - e) T / dt, with e = exp(-dt / T).
    """
    keep = exp(-TICK_S / lag_s)
    mean = (1.0 - keep) * lag_s / TICK_S
    speed, total, count = did[0] or 0.0, 0.0, 0
    for wish, shown in zip(wishes, did, strict=True):
        behind = speed - wish
        if shown is not None:
            off = wish + behind * mean - shown
            total += off * off
            count += 1
        speed = wish + behind * keep
    return total / max(1, count)


def braking_radps2(ticks: Sequence[TrackTick], since: int) -> float:
    """Return how fast the slower-braking wheel slows in the even part of a stop [rad/s2].

    Raises:
        RunLost: the stop is too short to tell.
    """
    return min(_slope(ticks, wheel, since) for wheel in (LEFT, RIGHT))


def _slope(ticks: Sequence[TrackTick], wheel: int, since: int) -> float:
    points = [
        (tick.seq * TICK_S, abs(tick.did[wheel]))
        for tick in ticks
        if tick.did is not None and tick.seq >= since
    ]
    top = max((speed for _, speed in points[:FEWEST]), default=0.0)
    even = [point for point in points if SLOPE_TO * top <= point[1] <= SLOPE_FROM * top]
    if len(even) < FEWEST:
        raise RunLost("run_lost", f"{len(even)} ticks of even braking, expected {FEWEST} or more")
    mean_s, mean_speed = fmean(at for at, _ in even), fmean(speed for _, speed in even)
    along = sum((at - mean_s) * (speed - mean_speed) for at, speed in even)
    return -along / sum((at - mean_s) ** 2 for at, _ in even)
