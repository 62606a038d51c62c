"""Judge by one scan whether there is room to calibrate, and which way. Pure geometry.

Frame ``base``: x forward, y left. The robot is the disc of robot.toml; free lengths are counted
from its edge, as the bridge does.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, cos, hypot, sin, tau
from typing import TYPE_CHECKING

from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.wall import Points, wall_ahead
from wire import Pose2, transform, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from wire import RobotDescription, Scan

ASIDE_M = 0.05
"""Kept free on either side of the disc."""
END_M = 0.30
"""Beyond a run's end: the bridge slows down where it could not stop, and a run must be even."""
BEHIND_M = 0.25
"""Behind a run's beginning, for the way back."""
SPARE_M = 0.06
"""A heading to turn to has so much more ahead, behind and on either side than is needed, for a turn
ends some degrees off; the one that is faced has half of it, for each run looks anew."""
LONGEST_M, SHORTEST_M = 1.2, 0.75
OFF = 1.12
"""A radius may be so much larger than robot.toml believes."""
RETURNS = 0.5
HEADINGS = 144
REAL_TURN_RAD, PAST_RAD = 0.3, 0.45
"""A shorter turn may be no turn: it ends before it is fast, and the motor's dead zone is not known
yet. So what is nearer is gone past by so much, and then come back to."""
TURN_COSTS_M = 0.1
"""Of a run's length, for each radian that is turned."""
EVERYWHERE = tuple(wrap(index * tau / HEADINGS) for index in range(HEADINGS))
WALL_WORTH_M, SQUARE = 0.3, 0.3
"""A wall ahead that stands across, or nearly, is worth so much of a run's length: the lidar can
measure against it."""


@dataclass(frozen=True, slots=True)
class ClearWay:
    """Name a heading to drive back and forth in, and how far."""

    heading_rad: float
    run_m: float
    wall: bool = False
    """The lidar can measure against what is ahead."""

    @property
    def turns_rad(self) -> tuple[float, ...]:
        """Return the turns that lead there, each a real one; none where it is ahead."""
        if self.heading_rad == 0.0:
            return ()
        if abs(self.heading_rad) >= REAL_TURN_RAD:
            return (self.heading_rad,)
        past_rad = copysign(PAST_RAD, self.heading_rad)
        return (self.heading_rad + past_rad, -past_rad)

    @property
    def worth_m(self) -> float:
        """Return how long a run it gives, less what the turning costs; more before a wall."""
        wall_m = WALL_WORTH_M if self.wall else 0.0
        return self.run_m + wall_m - TURN_COSTS_M * sum(map(abs, self.turns_rad))


def points_of(scan: Scan, robot: RobotDescription) -> Points:
    """Return where beams came back, in ``base`` [m].

    Raises:
        CalibrationRefusal: ``no_lidar``: fewer than half of them did.
    """
    lidar_in_base = Pose2(robot.lidar.x_m, robot.lidar.y_m, robot.lidar.yaw_rad)
    points: Points = []
    for index, range_m in enumerate(scan.ranges_m):
        if range_m is not None:
            angle = scan.angle_min_rad + index * scan.angle_increment_rad
            points.append(transform(lidar_in_base, range_m * cos(angle), range_m * sin(angle)))
    if not len(points) >= RETURNS * len(scan.ranges_m) > 0:
        text = f"{len(points)} of {len(scan.ranges_m)} beams came back"
        raise CalibrationRefusal("no_lidar", text)
    return points


def seen_along(points: Points, heading_rad: float) -> Points:
    """Return the points as a robot would see them that had turned to a heading."""
    c, s = cos(heading_rad), sin(heading_rad)
    return [(x * c + y * s, y * c - x * s) for x, y in points]


def free_m(points: Points, radius_m: float, spare_m: float = 0.0) -> tuple[float, float]:
    """Return the free lengths ahead and behind from the disc's edge, less what is to be spared."""
    ahead = behind = 100.0
    aside = radius_m + ASIDE_M + spare_m
    for x, y in points:
        if -aside <= y <= aside:
            if x > 0.0:
                ahead = min(ahead, x)
            else:
                behind = min(behind, -x)
    edge = radius_m + spare_m
    return max(0.0, ahead - edge), max(0.0, behind - edge)


def needed_m(run_m: float) -> float:
    """Return the free length that a run of so many believed metres needs ahead."""
    return OFF * run_m + END_M


def clear_to_turn(points: Points, radius_m: float) -> None:
    """See that the robot may turn on the spot.

    Raises:
        CalibrationRefusal: ``no_room``.
    """
    nearest = min(hypot(x, y) for x, y in points)
    if not nearest >= radius_m + ASIDE_M:
        needs_m = radius_m + ASIDE_M
        text = f"something is {nearest:.2f} m from the middle; turning needs {needs_m:.2f} m"
        raise CalibrationRefusal("no_room", text)


def best_way(points: Points, radius_m: float, headings: Sequence[float] = EVERYWHERE) -> ClearWay:
    """Choose the heading that needs the least turning among those with room for a long run.

    Raises:
        CalibrationRefusal: ``no_room``, with what the best heading has.
    """
    clear_to_turn(points, radius_m)
    best = max((_way(points, radius_m, heading) for heading in headings), key=lambda w: w.worth_m)
    if not best.run_m >= SHORTEST_M:
        had = max(free_m(seen_along(points, heading), radius_m)[0] for heading in headings)
        text = (
            f"{had:.2f} m are free at best; a run needs {needed_m(SHORTEST_M) + SPARE_M:.2f} m "
            f"ahead and {BEHIND_M + SPARE_M:.2f} m behind"
        )
        raise CalibrationRefusal("no_room", text)
    return best


def _way(points: Points, radius_m: float, heading_rad: float) -> ClearWay:
    seen = seen_along(points, heading_rad)
    ahead, behind = free_m(seen, radius_m, SPARE_M if heading_rad else SPARE_M / 2)
    run_m = min(LONGEST_M, (ahead - END_M) / OFF) if behind >= BEHIND_M else 0.0
    return ClearWay(heading_rad, run_m, run_m >= SHORTEST_M and _has_a_wall(seen))


def _has_a_wall(seen: Points) -> bool:
    try:
        return abs(wall_ahead(seen).slope) <= SQUARE
    except CalibrationRefusal:
        return False
