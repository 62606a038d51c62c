"""Turn one lidar scan into points around the robot, once, so that every tick can be cheap.

Owns what a beam means: a return within range is a point, a return too near is a point at the
shortest range, no return is unknown. Points lie in ``base`` as it was at the scan; a tick moves
the robot among them instead of moving them. A scan lives for ten ticks, so what none of them needs
is left out once: points further off than ``sight_m``. Knows no motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, cos, floor, hypot, inf, pi, sin, tau
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from wire.geometry import Pose2
from wire.value import value

if TYPE_CHECKING:
    from wire.lidar_config import LidarConfig
    from wire.sensors import Scan


Points = tuple[tuple[float, ...], tuple[float, ...]]
"""x and y [m], one each per point: two flat tuples cost less than one of pairs."""


@value
class Sector:
    """Count the beams of a range of directions."""

    beams: int
    returned: int
    covered: bool
    """Every direction of it lies within the lidar's field."""

    @property
    def is_known(self) -> bool:
        """Tell whether at least half of the beams came back, so that silence means free."""
        return self.beams > 0 and 2 * self.returned >= self.beams


@dataclass(frozen=True, slots=True)
class ScanPicture:
    """Hold a scan, the points near the robot in the order of the beams, and where the robot was."""

    base_in_odom: Pose2
    lidar_x_m: float
    lidar_y_m: float
    first_rad: float
    """Direction of beam 0 in ``base``."""
    step_rad: float
    ranges_m: tuple[float | None, ...]
    """As they came; beyond ``range_max_m`` counts as nothing."""
    range_min_m: float
    range_max_m: float
    returns: int
    """How many beams came back."""
    sight_m: float | None
    """Every return nearer to ``base`` than this is among the points; None: every return is."""
    xs_m: tuple[float, ...]
    ys_m: tuple[float, ...]
    """Where beams returned, in ``base`` at the scan."""
    nearest_m: float | None
    """No return is nearer to ``base`` than this; None if nothing returned."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @classmethod
    def from_scan(
        cls,
        scan: Scan,
        base_in_odom_at_scan: Pose2,
        lidar: LidarConfig,
        sight_m: float | None = None,
    ) -> ScanPicture:
        """Make the picture of a scan.

        Args:
            scan: ranges in the lidar's frame.
            base_in_odom_at_scan: odometry's pose at the scan's time, not at its arrival.
            lidar: where it sits and what it can measure.
            sight_m: how far from ``base`` points will be asked for; None keeps them all.
        """
        ranges, low, high = scan.ranges_m, lidar.range_min_m, lidar.range_max_m
        lx, ly = lidar.x_m, lidar.y_m
        offset = hypot(lx, ly)
        first = lidar.yaw_rad + scan.angle_min_rad
        far = high if sight_m is None else min(high, sight_m + offset)
        returns, near, xs, ys = _points(
            ranges, _rays(first, scan.angle_increment_rad, len(ranges)), low, high, far, lx, ly
        )
        nearest_m = near
        if near is None and returns:
            nearest_m = far
        return cls(
            base_in_odom=base_in_odom_at_scan,
            lidar_x_m=lx,
            lidar_y_m=ly,
            first_rad=first,
            step_rad=scan.angle_increment_rad,
            ranges_m=ranges,
            range_min_m=low,
            range_max_m=high,
            returns=returns,
            sight_m=sight_m,
            xs_m=tuple(xs),
            ys_m=tuple(ys),
            nearest_m=None if nearest_m is None else nearest_m - offset,
        )

    @property
    def beams(self) -> int:
        """Return how many beams the scan had."""
        return len(self.ranges_m)

    def sector(self, middle_rad: float, half_rad: float) -> Sector:
        """Count the beams within ``half_rad`` of a direction of ``base`` at the scan."""
        high = self.range_max_m
        beams = returned = 0
        for start, end in self._runs(middle_rad, half_rad):
            beams += end - start
            returned += len([r for r in self.ranges_m[start:end] if r is not None and r <= high])
        return Sector(beams, returned, self._covers(middle_rad, half_rad))

    def points(self, within_m: float) -> Points:
        """Return x and y [m] of all returns within a distance of ``base`` at the scan, or of more.

        Beyond the sight they are made anew, which costs as much as the picture itself: a robot that
        looks so far has a scan grown old, or is faster than anybody asked it to be.
        """
        if self.sight_m is None or within_m <= self.sight_m:
            return self.xs_m, self.ys_m
        low, far = self.range_min_m, self.range_max_m
        rays = _rays(self.first_rad, self.step_rad, self.beams)
        _, _, xs, ys = _points(self.ranges_m, rays, low, far, far, self.lidar_x_m, self.lidar_y_m)
        return tuple(xs), tuple(ys)

    @property
    def whole(self) -> bool:
        """Tell whether the lidar sees all round."""
        return self.beams * self.step_rad >= tau - 1e-6

    def _runs(self, middle_rad: float, half_rad: float) -> list[tuple[int, int]]:
        """Return the runs of beam numbers within a range of directions, none counted twice."""
        count, step = self.beams, self.step_rad
        width = min(max(half_rad, 0.0), pi - 1e-9)
        start = _wrap_turn(middle_rad - width - self.first_rad)
        runs = []
        for turn in (-tau, 0.0, tau):  # a field may begin anywhere and be longer than one turn
            begin = start + turn
            if begin + 2 * width < 0.0 or begin > count * step:
                continue  # the field has nothing there: most often so
            low = max(0, ceil(begin / step))
            high = min(count, floor((begin + 2 * width) / step) + 1)
            if high > low:
                runs.append((low, high))
        return runs

    def _covers(self, middle_rad: float, half_rad: float) -> bool:
        """Tell whether a range of directions lies within the lidar's field, a beam to spare."""
        if self.whole:
            return True
        field = self.beams * self.step_rad
        start = _wrap_turn(middle_rad - half_rad - self.first_rad + self.step_rad)
        return start + 2 * half_rad <= field + self.step_rad


def _points(
    ranges: tuple[float | None, ...],
    rays: tuple[tuple[float, ...], tuple[float, ...]],
    low: float,
    high: float,
    far: float,
    lidar_x_m: float,
    lidar_y_m: float,
) -> tuple[int, float | None, list[float], list[float]]:
    """Go over the beams once, for this is the dearest part of a tick.

    Returns:
        How many returned up to ``high`` [m]; the least range up to ``far`` [m], never under
        ``low``, or None; x and y in ``base`` [m] of all returns up to ``far``.
    """
    cosines, sines = rays
    returns, least = 0, inf
    xs: list[float] = []
    ys: list[float] = []
    for r, cosine, sine in zip(ranges, cosines, sines, strict=True):
        if r is None or not r <= high:  # what is not a number is no return either
            continue
        returns += 1
        if r <= far:
            seen = r if r > low else low  # noqa: FURB136  # max and min double the time of this loop
            if seen < least:
                least = seen
            xs.append(lidar_x_m + seen * cosine)
            ys.append(lidar_y_m + seen * sine)
    return returns, least if xs else None, xs, ys


@lru_cache(maxsize=8)
def _rays(
    first_rad: float, step_rad: float, count: int
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the beams' cosines and sines; a lidar's are the same in every scan."""
    angles = [first_rad + index * step_rad for index in range(count)]
    return tuple(map(cos, angles)), tuple(map(sin, angles))


def _wrap_turn(angle_rad: float) -> float:
    """Bring an angle into [0, 2 pi); NaN and infinity become 0."""
    turned = angle_rad % tau if -1e6 <= angle_rad <= 1e6 else 0.0
    return turned if turned < tau else 0.0
