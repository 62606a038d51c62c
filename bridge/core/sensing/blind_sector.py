"""Find a sector of the lidar from which nothing comes although something must be there.

Silence of some beams may be a black sofa, a mirror, an open door; those stay where they are while
the robot turns and drives. A hole in the lidar turns with it. Two signs tell the two apart, both
without a map, from bins of 3 degrees, counted in ``base`` (a slow lidar's scans of its last 360
degrees begin elsewhere each time):

- what other beams, or the same a moment ago, saw returns nothing now, for 0.2 s: such a bin is
  dead until something comes back from it;
- no beam of a bin has ever returned since the start: such a bin is unproven.

The lidar's range may end in a silence, too, so the first sign counts only where one of its edges is
near, the second where both are. Pure; ages run on the bridge's clock.
"""

from __future__ import annotations

from functools import lru_cache
from math import atan2, ceil, cos, floor, hypot, pi, sin, tau
from typing import TYPE_CHECKING

from bridge.core.state_senses import SectorMemory
from wire import compose
from wire.geometry import Pose2

if TYPE_CHECKING:
    from bridge.core.geometry.lidar_scan import ScanPicture

BINS = 120
"""Of 3 degrees; a lidar with fewer beams has one a beam."""
LEAST_RAD = 0.2
"""A narrower hole hides nothing that a disc could hit: its sides see it first. 11.5 degrees."""
NEAR_SHARE, REACHED_SHARE = 0.7, 0.85
"""Of the lidar's range: silence may be where that ends unless both edges are so near, for what was
never proven, or one is, for what was seen. A corridor 2 m wide fades out between edges at 0.86."""
KEPT_M = 0.3
"""Of way driven: what was seen longer ago is seen from too far aside to be missed."""
SEEN_S, RECENT_S = 0.2, 0.35
"""So long nothing comes where something was seen; and how far back scans are compared."""
AHEAD_RAD = pi / 3
"""To each side of the way: beyond it the disc passes what the beams ahead have seen before."""

COARSE_RAD = 0.045
"""Between two beams: 2.6 degrees, more than any lidar that Pons reads; told once."""

Point = tuple[float, float, float]
"""x and y in ``odom`` [m], and the odometer's reading when it was seen [m]."""


def watch_sectors(
    had: SectorMemory, picture: ScanPicture, travelled_m: float, now_s: float
) -> SectorMemory:
    """Return the memory after one more scan.

    Args:
        had: the memory before it.
        picture: of the scan.
        travelled_m: the odometer's reading.
        now_s: the bridge's clock.
    """
    count = min(BINS, max(1, round(tau / picture.step_rad))) if picture.step_rad > 0.0 else 0
    if picture.beams == 0 or count < 3:
        return had
    if had.bins != count:
        had = SectorMemory(bins=count, points=(None,) * count)
    shift = round(picture.first_rad * count / tau) % count
    far_m = _farthest(picture, count, shift)
    seen = sum(1 << index for index, far in enumerate(far_m) if far >= 0.0)
    beams = _with_beams(picture.step_rad, picture.beams, count)
    silent = (beams << shift | beams >> (count - shift)) & ((1 << count) - 1) & ~seen
    middles = _middles(picture.first_rad, picture.step_rad, count, shift)
    lidar_in_odom = compose(picture.base_in_odom, Pose2(picture.lidar_x_m, picture.lidar_y_m, 0.0))
    points = _remember_points(had.points, far_m, middles, lidar_in_odom, travelled_m)
    alive = had.alive | seen
    least = max(2, ceil(LEAST_RAD * count / tau - 1e-9))
    bounded = enclosed = 0
    for run in runs(silent, count, least):
        edges = far_m[run[0] - 1], far_m[(run[1] + 1) % count]
        if 0.0 <= min(edges) <= REACHED_SHARE * picture.range_max_m:
            bounded |= _bits(run, count)
            if max(edges) <= NEAR_SHARE * picture.range_max_m:
                enclosed |= _bits(run, count)
    if not (bounded or had.dead):
        return SectorMemory(count, alive, 0, points)
    missed = 0
    if bounded:
        missed = bounded & _expected_bins(points, lidar_in_odom, middles, picture, travelled_m)
    recent = tuple(one for one in (*had.recent, (now_s, missed)) if now_s - one[0] <= RECENT_S)
    lasting = missed if now_s - recent[0][0] >= SEEN_S - 1e-6 else 0
    for _, mask in recent:
        lasting &= mask
    dead = had.dead
    for run in runs(lasting, count, least):
        dead |= _bits(run, count)
    dead &= silent
    blind = dead | (enclosed & ~alive)
    widths = [
        (blind & _toward(way_rad, middles)).bit_count() * tau / count for way_rad in (0.0, pi)
    ]
    wide = [width if width >= least * tau / count - 1e-9 else 0.0 for width in widths]
    return SectorMemory(count, alive, dead, points, recent, wide[0], wide[1])


def coarse_words(step_rad: float) -> str:
    """Say what slips between beams so far apart."""
    return (
        f"{step_rad * 180.0 / pi:.0f} degrees between beams: what is narrower than "
        f"{step_rad:.2f} m slips between two at 1 m"
    )


def runs(mask: int, count: int, least: int) -> list[tuple[int, int]]:
    """Return first and last bin of each run of at least so many bins set; the turn has no end."""
    if mask == 0 or mask.bit_count() < least or mask == (1 << count) - 1:
        return []
    start = next(index for index in range(count) if not mask >> index & 1)
    found, begun = [], None
    for step in range(1, count + 1):
        index = (start + step) % count
        if mask >> index & 1:
            begun = step if begun is None else begun
        elif begun is not None:
            if step - begun >= least:
                found.append(((start + begun) % count, (index - 1) % count))
            begun = None
    return found


def _bits(run: tuple[int, int], count: int) -> int:
    """Return the bins of a run as a mask."""
    first, last = run
    return sum(1 << (first + step) % count for step in range((last - first) % count + 1))


def _farthest(picture: ScanPicture, count: int, shift: int) -> list[float]:
    """Return the farthest return of each bin [m]; -1 where there is none. Beam 0 is in `shift`."""
    far_m = [-1.0] * count
    high = picture.range_max_m
    for index, r in zip(
        _bin_of(picture.step_rad, picture.beams, count), picture.ranges_m, strict=True
    ):
        if r is not None and far_m[index] < r <= high:
            far_m[index] = r
    return far_m[count - shift :] + far_m[: count - shift]


def _remember_points(
    points: tuple[Point | None, ...],
    far_m: list[float],
    middles: tuple[float, ...],
    lidar_in_odom: Pose2,
    travelled_m: float,
) -> tuple[Point | None, ...]:
    """Return the newest point seen in each direction of ``odom``."""
    kept, count = list(points), len(points)
    x_m, y_m, yaw_rad = lidar_in_odom.x_m, lidar_in_odom.y_m, lidar_in_odom.yaw_rad
    for far, middle in zip(far_m, middles, strict=True):
        if far >= 0.0:
            angle = yaw_rad + middle
            place = (x_m + far * cos(angle), y_m + far * sin(angle), travelled_m)
            kept[floor(angle * count / tau) % count] = place
    return tuple(kept)


def _expected_bins(
    points: tuple[Point | None, ...],
    lidar_in_odom: Pose2,
    middles: tuple[float, ...],
    picture: ScanPicture,
    travelled_m: float,
) -> int:
    """Return the bins in which remembered points lie within reach, a bin to each side of each."""
    mask, nearest_m, farthest_m = 0, picture.range_min_m, 0.9 * picture.range_max_m
    first_rad, count = middles[0], len(middles)
    for point in points:
        if point is None or travelled_m - point[2] > KEPT_M:
            continue
        dx, dy = point[0] - lidar_in_odom.x_m, point[1] - lidar_in_odom.y_m
        if nearest_m < hypot(dx, dy) < farthest_m:
            angle = atan2(dy, dx) - lidar_in_odom.yaw_rad - first_rad
            index = round(angle * count / tau) % count
            mask |= 1 << index | 1 << (index + 1) % count | 1 << (index - 1) % count
    return mask


@lru_cache(maxsize=8)
def _bin_of(step_rad: float, beams: int, count: int) -> tuple[int, ...]:
    """Return each beam's bin, counted from that of beam 0, which begins half a step before it."""
    return tuple(floor((beam + 0.5) * step_rad * count / tau) % count for beam in range(beams))


@lru_cache(maxsize=8)
def _with_beams(step_rad: float, beams: int, count: int) -> int:
    """Return the bins in which the lidar has a beam, counted from that of beam 0."""
    return sum(1 << index for index in set(_bin_of(step_rad, beams, count)))


@lru_cache(maxsize=8)
def _middles(first_rad: float, step_rad: float, count: int, shift: int) -> tuple[float, ...]:
    """Return each bin's middle, in ``base``."""
    first_rad -= step_rad / 2
    return tuple(
        first_rad + ((index - shift) % count + 0.5) * tau / count for index in range(count)
    )


@lru_cache(maxsize=8)
def _toward(way_rad: float, middles: tuple[float, ...]) -> int:
    """Return the bins near a way of the robot."""
    return sum(
        1 << index
        for index, middle in enumerate(middles)
        if abs((middle - way_rad + pi) % tau - pi) <= AHEAD_RAD
    )
