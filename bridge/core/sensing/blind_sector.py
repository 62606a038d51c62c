"""Tell a hole in the lidar from what is black, open or far: by what turns with the robot.

A surface that returns nothing lies in the room: as the robot turns or drives, its silence moves
through the lidar's directions, a little from scan to scan. A hole lies in the lidar: it comes at
once, as wide as it is, beside beams that go on as before, and it stays in the same directions
however the robot turns. So, in bins of 3 degrees of ``base`` (a slow lidar's scans of its last 360
degrees begin elsewhere each time), without a map:

- bins that fall silent together within one scan, where nothing else changed, and stay so for 0.2 s
  are dead. Where a door or a person goes, what is beside the silence is seen farther off than
  before: then it was there that something went, and what it hid is black;
- bins that stay silent through 15 degrees of a turn on the spot are dead where the silence is as
  wide as they are: one that lies in the room had moved on, and left them fewer;
- no beam of a bin has ever returned since the start, between edges that are near: it is unproven.

Dead is so until something comes back. Pure; ages run on the bridge's clock.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, floor, pi, tau
from typing import TYPE_CHECKING

from bridge.core.state_senses import SectorMemory, SectorScan, SectorTurn
from wire import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bridge.core.geometry.lidar_scan import ScanPicture

BINS = 120
"""Of 3 degrees; a lidar with fewer beams has one a beam."""
LEAST_RAD = 0.2
"""A narrower hole hides nothing that a disc could hit: its sides see it first. 11.5 degrees."""
NEAR_SHARE, REACHED_SHARE, SEEN_SHARE = 0.7, 0.85, 0.95
"""Of the lidar's range: silence may be where that ends unless both edges are so near, for what was
never proven, or one is, for what was seen; and what was seen farther off may have faded. A corridor
2 m wide fades out between edges at 0.86."""
SEEN_S, RECENT_S = 0.2, 0.35
"""So long nothing comes where something was seen; scans farther apart are not compared."""
FARTHER_M, FARTHER_SHARE = 0.3, 0.15
"""Where a beam reaches so much farther than in the scan before, what it hit has gone."""
TURN_RAD, ON_SPOT_M, SLACK_RAD = 0.27, 0.05, 0.11
"""So far a turn goes in which a silence of the room moves by five bins, or by three where the robot
drives as far as this around a thing half a metre away; two bins may be the edges' noise."""
AHEAD_RAD = pi / 3
"""To each side of the way: beyond it the disc passes what the beams ahead have seen before."""

COARSE_RAD = 0.045
"""Between two beams: 2.6 degrees, more than any lidar that Pons reads; told once."""


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
        had = SectorMemory(bins=count)
    shift = round(picture.first_rad * count / tau) % count
    far_m = _farthest(picture, count, shift)
    yaw_rad, high_m = picture.base_in_odom.yaw_rad, picture.range_max_m
    scan = SectorScan(far_m, picture.first_rad, yaw_rad, now_s)
    seen = _mask([far >= 0.0 for far in far_m])
    alive = had.alive | seen
    beams = _with_beams(picture.step_rad, picture.beams, count)
    silent = _turn_bins(beams, -shift, count) & ~seen
    least = max(2, ceil(LEAST_RAD * count / tau - 1e-9))
    bounded, enclosed = [], 0
    for run in runs(silent, count, least):
        edges = far_m[run[0] - 1], far_m[(run[1] + 1) % count]
        if 0.0 <= min(edges) <= REACHED_SHARE * high_m:
            bounded.append(run)
            if max(edges) <= NEAR_SHARE * high_m:
                enclosed |= _bits(run, count)
    gone = _still_gone(had, silent, now_s, least)
    fell = _fell_silent(had, scan, bounded, SEEN_SHARE * high_m, least)
    gone = (*gone, (now_s, fell)) if fell else gone
    dead = had.dead
    for since_s, mask in gone:
        if now_s - since_s >= SEEN_S - 1e-6:
            dead |= mask
    turn, fixed = _watch_turn(had.turn, silent, yaw_rad, travelled_m, count, least)
    dead = (dead | fixed) & silent
    blind = dead | (enclosed & ~alive)
    ahead_rad = behind_rad = 0.0
    if blind:
        middles = _middles(picture.first_rad, picture.step_rad, count, shift)
        ahead_rad, behind_rad = (
            width * tau / count if width >= least else 0.0
            for width in ((blind & _toward(way, middles)).bit_count() for way in (0.0, pi))
        )
    return SectorMemory(
        count, alive, dead, (scan, *had.scans[:1]), gone, turn, ahead_rad, behind_rad
    )


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


def _still_gone(
    had: SectorMemory, silent: int, now_s: float, least: int
) -> tuple[tuple[float, int], ...]:
    """Return what fell silent together, has not been found dead yet, and is silent still."""
    if not had.gone or now_s - had.scans[0].at_s > RECENT_S:
        return ()
    last_s = had.scans[0].at_s
    kept = ((at_s, mask & silent) for at_s, mask in had.gone if last_s - at_s < SEEN_S - 1e-6)
    return tuple(one for one in kept if one[1].bit_count() >= least)


def _fell_silent(
    had: SectorMemory,
    scan: SectorScan,
    bounded: list[tuple[int, int]],
    within_m: float,
    least: int,
) -> int:
    """Return the bins of each silence in which many fell silent since the scan before.

    Of a scan that begins elsewhere than the one before a part is old: that one's own is asked, too.
    """
    if not bounded or not had.scans or scan.at_s - had.scans[0].at_s > RECENT_S:
        return 0
    last, count, found = had.scans[0], had.bins, 0
    asked = had.scans if last.first_rad != scan.first_rad else had.scans[:1]
    expected = 0
    for one in asked:
        bins = wrap(scan.yaw_rad - one.yaw_rad) * count / tau
        near = _mask([0.0 <= far <= within_m for far in one.far_m])
        low, high = floor(bins + 1e-6), ceil(bins - 1e-6)
        expected |= _turn_bins(near, low, count) & _turn_bins(near, high, count)
    for run in bounded:
        bits = _bits(run, count)
        if (bits & expected).bit_count() >= least > _count_uncovered(run, scan, last):
            found |= bits
    return found


def _count_uncovered(run: tuple[int, int], scan: SectorScan, last: SectorScan) -> int:
    """Count the bins beside a silence in which something went away since the scan before."""
    count, uncovered = len(scan.far_m), 0
    shift = round(wrap(scan.yaw_rad - last.yaw_rad) * count / tau)
    for start, step in ((run[0] - 1, -1), (run[1] + 1, 1)):
        for away in range(count // 4):
            index = start + away * step
            far_m, before_m = scan.far_m[index % count], last.far_m[(index + shift) % count]
            if before_m < 0.0 or far_m - before_m <= max(FARTHER_M, FARTHER_SHARE * before_m):
                break
            uncovered += 1
    return uncovered


def _watch_turn(
    turn: SectorTurn | None,
    silent: int,
    yaw_rad: float,
    travelled_m: float,
    count: int,
    least: int,
) -> tuple[SectorTurn, int]:
    """Follow a turn on the spot; return it, and the bins that it shows to turn with the robot."""
    fresh = SectorTurn(yaw_rad, travelled_m, silent, silent)
    if turn is None or travelled_m - turn.travelled_m > ON_SPOT_M:
        return fresh, 0
    through = turn.through & silent
    if abs(wrap(yaw_rad - turn.yaw_rad)) < TURN_RAD:
        return SectorTurn(turn.yaw_rad, turn.travelled_m, turn.began, through), 0
    fixed, slack = 0, floor(SLACK_RAD * count / tau)
    for run in runs(through, count, least):
        bits = _bits(run, count)
        whole = max(_width_at(mask, run[0], count) for mask in (silent, turn.began))
        if bits.bit_count() >= whole - slack:
            fixed |= bits
    return fresh, fixed


def _width_at(mask: int, index: int, count: int) -> int:
    """Return how many bins the run is long in which a set bin lies."""
    whole = runs(mask, count, 1)
    lengths = ((index - first) % count <= (last - first) % count for first, last in whole)
    inside = next((run for run, within in zip(whole, lengths, strict=True) if within), (0, count))
    return (inside[1] - inside[0]) % (count + 1) + 1


def _mask(flags: Sequence[bool]) -> int:
    """Return the bins whose flag is set as a mask."""
    return sum(1 << index for index, flag in enumerate(flags) if flag)


def _turn_bins(mask: int, by: int, count: int) -> int:
    """Return a mask whose bin 0 is another's bin ``by``."""
    by %= count
    return (mask >> by | mask << (count - by)) & ((1 << count) - 1)


def _bits(run: tuple[int, int], count: int) -> int:
    """Return the bins of a run as a mask."""
    first, last = run
    return _turn_bins((1 << (last - first) % count + 1) - 1, -first, count)


def _farthest(picture: ScanPicture, count: int, shift: int) -> tuple[float, ...]:
    """Return the farthest return of each bin [m]; -1 where there is none. Beam 0 is in `shift`."""
    far_m = [-1.0] * count
    high = picture.range_max_m
    for index, r in zip(
        _bin_of(picture.step_rad, picture.beams, count), picture.ranges_m, strict=True
    ):
        if r is not None and far_m[index] < r <= high:
            far_m[index] = r
    return (*far_m[count - shift :], *far_m[: count - shift])


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
