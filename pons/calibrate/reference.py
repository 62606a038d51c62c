"""Say from outside how far the robot moved: the simulator's truth, the lidar, or a person's tape.

Each reference looks before a run and after it, standing both times. Which one it was stands in the
evidence.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import fmean, median
from typing import TYPE_CHECKING

from pons.calibrate.clearance import points_of
from pons.calibrate.errors import CalibrationRefusal, RunLost
from pons.calibrate.wall import wall_ahead
from wire import distance

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pons.calibrate.track import DriveTrack
    from wire import RobotDescription, Scan, SimTruth

TRUTH, LIDAR, MEASURED = "truth", "lidar", "measured"
SPOKEN = {
    TRUTH: "the simulator's truth",
    LIDAR: "the lidar",
    MEASURED: "a person's measure",
}
SCANS = 5
"""Taken standing and averaged beam by beam."""

SEARCH_RAD = 0.35
FINE_RAD = 0.0005


@dataclass(frozen=True, slots=True)
class WallLook:
    """Hold the wall as seen while standing."""

    truth: SimTruth | None
    scans: tuple[Scan, ...]


def went_m(
    kind: str, before: WallLook, after: WallLook, robot: RobotDescription, ask: Callable[[], float]
) -> float:
    """Return how far the robot went along its heading, without sign [m].

    Raises:
        CalibrationRefusal: the reference cannot say.
        RunLost: this run's wall or truth got lost.
    """
    if kind == MEASURED:
        return ask()
    if kind == TRUTH:
        if before.truth is None or after.truth is None:
            raise CalibrationRefusal("no_truth")
        return distance(before.truth.base_in_map, after.truth.base_in_map)
    return abs(wall_m(before.scans, robot) - wall_m(after.scans, robot))


def turned_rad(
    kind: str,
    track: DriveTrack,
    before: WallLook,
    after: WallLook,
    robot: RobotDescription,
    near_rad: float,
) -> float:
    """Return how far the robot turned in a run, by truth or by matching scans.

    Args:
        kind: which reference; a person measures distances alone, so the lidar serves for turns.
        track: the run.
        before: a look before it.
        after: a look after it.
        robot: places the lidar.
        near_rad: what the wheels say: a scan shows a turn but for whole ones.
    """
    if kind == TRUTH:
        if track.truth is None:
            raise CalibrationRefusal("no_truth")
        return track.true_turn_rad
    return near_rad + matched_rad(before.scans, after.scans, near_rad)


def wall_m(scans: Sequence[Scan], robot: RobotDescription) -> float:
    """Return the distance along the heading to the flat wall ahead [m].

    Raises:
        CalibrationRefusal: ``no_wall``: what is ahead is not flat, or nothing is.
    """
    points = [point for scan in scans for point in points_of(scan, robot)]
    return wall_ahead(points, len(scans)).distance_m


def matched_rad(before: Sequence[Scan], after: Sequence[Scan], near_rad: float) -> float:
    """Return by how much the robot turned more than the wheels say [rad].

    On the spot a turn only shifts the beams, so the shift at which both scans agree best is
    searched, first coarsely, then finely; ranges between beams are interpolated.

    Raises:
        RunLost: no shift fits.
    """
    old, new = _median_scan(before), _median_scan(after)
    step = before[0].angle_increment_rad

    def worst(more_rad: float) -> float:
        return _disagreement(old, new, (near_rad + more_rad) / step)

    coarse = min(_steps(-SEARCH_RAD, SEARCH_RAD, step), key=worst)
    fine = min(_steps(coarse - step, coarse + step, FINE_RAD), key=worst)
    if not worst(fine) <= 0.1:
        raise RunLost("run_lost", f"scans before and after differ by {worst(fine):.2f} m")
    return fine


def _steps(low: float, high: float, by: float) -> list[float]:
    return [low + n * by for n in range(round((high - low) / by) + 1)]


def _median_scan(scans: Sequence[Scan]) -> list[float | None]:
    """Return the median of each beam; None where it mostly did not come back."""
    beams: list[float | None] = []
    for ranges in zip(*(scan.ranges_m for scan in scans), strict=True):
        came = [value for value in ranges if value is not None]
        beams.append(median(came) if 2 * len(came) > len(ranges) else None)
    return beams


def _disagreement(old: list[float | None], new: list[float | None], shift: float) -> float:
    """Return the mean distance between scans, edges left out, where a beam sees a turn by shift."""
    count = len(old)
    whole = int(shift // 1)
    part = shift - whole
    off: list[float] = []
    for index, seen in enumerate(new):
        low, high = old[(index + whole) % count], old[(index + whole + 1) % count]
        if seen is not None and low is not None and high is not None and abs(low - high) < 0.1:
            off.append(abs(low + part * (high - low) - seen))
    off.sort()
    kept = off[: max(1, int(0.8 * len(off)))]
    return fmean(kept) if len(kept) > count // 4 else 100.0
