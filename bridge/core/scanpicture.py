"""Turn one lidar scan into points around the robot, once, so that every tick can be cheap.

Owns what a beam means: a return within range is a point, a return too near is a point at the
shortest range, no return is unknown. Points lie in ``base`` as it was at the scan; a tick moves the
robot among them instead of moving them. Knows no motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, compress
from math import ceil, cos, floor, hypot, pi, sin, tau
from operator import mul
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from wire.geometry import Pose2
from wire.value import value

if TYPE_CHECKING:
    from wire.robot import LidarConfig
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
    def known(self) -> bool:
        """Tell whether at least half of the beams came back, so that silence means free."""
        return self.beams > 0 and 2 * self.returned >= self.beams


@dataclass(frozen=True, slots=True)
class ScanPicture:
    """Hold a scan's points, in the order of the beams, and where the robot was."""

    base_in_odom: Pose2
    lidar_x_m: float
    lidar_y_m: float
    first_rad: float
    """Direction of beam 0 in ``base``."""
    step_rad: float
    xs_m: tuple[float, ...]
    ys_m: tuple[float, ...]
    """Where beams returned, in ``base`` at the scan."""
    before: tuple[int, ...]
    """How many beams returned before each beam, and in all: one more than there are beams."""
    nearest_m: float | None
    """No point is nearer to ``base`` than this; None if nothing returned."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @classmethod
    def from_scan(cls, scan: Scan, base_in_odom_at_scan: Pose2, lidar: LidarConfig) -> ScanPicture:
        """Make the picture of a scan.

        Args:
            scan: ranges in the lidar's frame.
            base_in_odom_at_scan: odometry's pose at the scan's time, not at its arrival.
            lidar: where it sits and what it can measure.
        """
        low, high = lidar.range_min_m, lidar.range_max_m
        first = lidar.yaw_rad + scan.angle_min_rad
        cosines, sines = _rays(first, scan.angle_increment_rad, len(scan.ranges_m))
        came = [r is not None and r <= high for r in scan.ranges_m]
        ranges: list[float] = list(compress(scan.ranges_m, came))  # type: ignore[arg-type]  # no None
        nearest_m = min(ranges, default=high)
        if not nearest_m >= low:  # rare: most scans have nothing so near
            ranges = [max(r, low) for r in ranges]
            nearest_m = low
        lx, ly = lidar.x_m, lidar.y_m
        xs = tuple(map(mul, ranges, compress(cosines, came)))
        ys = tuple(map(mul, ranges, compress(sines, came)))
        return cls(
            base_in_odom=base_in_odom_at_scan,
            lidar_x_m=lx,
            lidar_y_m=ly,
            first_rad=first,
            step_rad=scan.angle_increment_rad,
            xs_m=tuple([lx + x for x in xs]) if lx else xs,
            ys_m=tuple([ly + y for y in ys]) if ly else ys,
            before=tuple(accumulate(came, initial=0)),
            nearest_m=nearest_m - hypot(lx, ly) if ranges else None,
        )

    @property
    def beams(self) -> int:
        """Return how many beams the scan had."""
        return len(self.before) - 1

    @property
    def returns(self) -> int:
        """Return how many beams came back."""
        return self.before[-1]

    def sector(self, middle_rad: float, half_rad: float) -> Sector:
        """Count the beams within ``half_rad`` of a direction of ``base`` at the scan."""
        before = self.before
        beams = returned = 0
        for start, end in self._runs(middle_rad, half_rad):
            beams += end - start
            returned += before[end] - before[start]
        return Sector(beams, returned, self._covers(middle_rad, half_rad))

    def points_within(self, middle_rad: float, half_rad: float) -> Points:
        """Return x and y of the points whose beams lie within ``half_rad`` of a direction."""
        xs: tuple[float, ...] = ()
        ys: tuple[float, ...] = ()
        for start, end in self._runs(middle_rad, half_rad):
            low, high = self.before[start], self.before[end]
            xs += self.xs_m[low:high]
            ys += self.ys_m[low:high]
        return xs, ys

    @property
    def points(self) -> Points:
        """Return x and y of all points, in ``base`` at the scan [m]."""
        return self.xs_m, self.ys_m

    @property
    def whole(self) -> bool:
        """Tell whether the lidar sees all round."""
        return self.beams * self.step_rad >= tau - 1e-6

    def _runs(self, middle_rad: float, half_rad: float) -> list[tuple[int, int]]:
        """Return the runs of beam numbers within a range of directions, none counted twice."""
        count, step = self.beams, self.step_rad
        width = min(max(half_rad, 0.0), pi - 1e-9)
        start = _turned(middle_rad - width - self.first_rad)
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
        start = _turned(middle_rad - half_rad - self.first_rad + self.step_rad)
        return start + 2 * half_rad <= field + self.step_rad


@lru_cache(maxsize=8)
def _rays(
    first_rad: float, step_rad: float, count: int
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the beams' cosines and sines; a lidar's are the same in every scan."""
    angles = [first_rad + index * step_rad for index in range(count)]
    return tuple(map(cos, angles)), tuple(map(sin, angles))


def _turned(angle_rad: float) -> float:
    """Bring an angle into [0, 2 pi); what is not a number becomes 0."""
    turned = angle_rad % tau if -1e6 <= angle_rad <= 1e6 else 0.0
    return turned if turned < tau else 0.0
