"""Cut the rolling horizon out of a leg's path. Pure: told the pose and the progress, no time.

Laws of every message: the first point is the robot's projection on the path, within 0.3 m of it;
points are 0.05 to 0.25 m apart, the first and the last gap 0.01 to 0.25; all speeds are of one
direction (a straight way may go backwards); only the leg's last point may carry a heading. Progress
never falls, and is sought only a little ahead, so a path that crosses itself is followed in its
order.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import copysign, hypot

from planner.navigation.route import MIN_SPEED_MPS, RoutePoint
from wire import MAX_POINTS, Pose2, Waypoint

OFF_PATH_M = 0.3
"""Farther than this from its path the robot stands and a route is sought anew."""
WINDOW_M = 0.6
"""Sought ahead of the last progress: more than a second at full speed, ten of the mission's ticks;
a robot farther along than that is found off its path, which is safe."""
AHEAD_S = 3.0
AHEAD_M = 1.5
"""At least this far, so that the bridge always sees a good way past its stopping distance."""
MIN_GAP_M = 0.01


@dataclass(frozen=True, slots=True)
class LegPath:
    """Hold a leg's whole path, measured once."""

    points: tuple[RoutePoint, ...]
    along_m: tuple[float, ...]  # from the first point to each
    heading_rad: float | None  # wanted at the end, or whatever it comes to

    @classmethod
    def of(cls, points: Sequence[RoutePoint], heading_rad: float | None = None) -> LegPath:
        """Measure a route; it has at least one point.

        Raises:
            ValueError: there is no point.
        """
        if not points:
            raise ValueError("a leg needs at least one point")
        along_m = [0.0]
        for a, b in pairwise(points):
            along_m.append(along_m[-1] + hypot(b.x_m - a.x_m, b.y_m - a.y_m))
        return cls(tuple(points), tuple(along_m), heading_rad)

    def scale_speed(self, share: float) -> LegPath:
        """Return the path with its fastest speed cut to a share of itself, and no point faster."""
        fastest_mps = max(abs(point.speed_mps) for point in self.points)
        cap_mps = max(share * fastest_mps, MIN_SPEED_MPS)
        points = tuple(
            replace(p, speed_mps=copysign(min(abs(p.speed_mps), cap_mps), p.speed_mps))
            for p in self.points
        )
        return replace(self, points=points)

    @property
    def length_m(self) -> float:
        """Return the length from the first point to the last."""
        return self.along_m[-1]


@dataclass(frozen=True, slots=True)
class Horizon:
    """Hold what to send now. No points: ramp to a stop."""

    points: tuple[Waypoint, ...]
    final: bool  # the last point is the leg's end
    progress_m: float  # along the leg; hand it back with the next pose
    away_m: float  # from the robot to the path
    off_path: bool  # too far away: stand, and route again


def cut(path: LegPath, robot_in_map: Pose2, progress_m: float) -> Horizon:
    """Return the horizon for a robot that had come ``progress_m`` along the leg."""
    nearest_m, away_m = _project(path, robot_in_map, progress_m)
    # Written as the accepting condition: a pose that is not finite is off the path.
    if not away_m <= OFF_PATH_M:
        return Horizon((), final=False, progress_m=progress_m, away_m=away_m, off_path=True)
    points, final = _points_from(path, nearest_m)
    return Horizon(points, final=final, progress_m=nearest_m, away_m=away_m, off_path=False)


def _project(path: LegPath, robot: Pose2, progress_m: float) -> tuple[float, float]:
    """Return how far along the nearest point in the window lies, and how far away it is [m]."""
    low_m = min(max(progress_m, 0.0), path.length_m)
    high_m = min(low_m + WINDOW_M, path.length_m)
    best_m, best_away_m = low_m, _away_m(path, robot, low_m)
    first = max(0, bisect_right(path.along_m, low_m) - 1)
    for index in range(first, len(path.points) - 1):
        start_m, end_m = path.along_m[index], path.along_m[index + 1]
        if start_m > high_m:
            break
        a, b = path.points[index], path.points[index + 1]
        dx, dy = b.x_m - a.x_m, b.y_m - a.y_m
        gap_m = end_m - start_m
        if not gap_m > 0.0:
            continue
        foot_m = start_m + ((robot.x_m - a.x_m) * dx + (robot.y_m - a.y_m) * dy) / gap_m
        at_m = min(max(foot_m, start_m, low_m), end_m, high_m)
        away_m = _away_m(path, robot, at_m)
        if away_m < best_away_m:
            best_m, best_away_m = at_m, away_m
    return best_m, best_away_m


def _away_m(path: LegPath, robot: Pose2, at_m: float) -> float:
    x_m, y_m, _ = _at(path, at_m)
    return hypot(robot.x_m - x_m, robot.y_m - y_m)


def _at(path: LegPath, at_m: float) -> tuple[float, float, float]:
    """Return x [m], y [m] and speed [m/s] at a distance along the path."""
    index = min(bisect_right(path.along_m, at_m), len(path.points) - 1)
    b = path.points[index]
    a = path.points[max(0, index - 1)]
    gap_m = path.along_m[index] - path.along_m[max(0, index - 1)]
    share = (at_m - path.along_m[max(0, index - 1)]) / gap_m if gap_m > 0.0 else 1.0
    share = min(1.0, max(0.0, share))
    return (
        a.x_m + share * (b.x_m - a.x_m),
        a.y_m + share * (b.y_m - a.y_m),
        min(a.speed_mps, b.speed_mps, key=abs),
    )


def _points_from(path: LegPath, start_m: float) -> tuple[tuple[Waypoint, ...], bool]:
    end = len(path.points)
    follow = bisect_right(path.along_m, start_m + MIN_GAP_M)
    points = [_first(path, start_m, follow)]
    speed_mps = _at(path, start_m)[2]
    wanted_m = start_m + max(AHEAD_M, AHEAD_S * abs(speed_mps))
    while follow < end and len(points) < MAX_POINTS and path.along_m[follow - 1] < wanted_m:
        points.append(_waypoint(path, follow))
        follow += 1
    return tuple(points), follow == end


def _first(path: LegPath, start_m: float, follow: int) -> Waypoint:
    """Return the projection, or the vertex that lies less than the least gap ahead of it."""
    if path.along_m[follow - 1] >= start_m:
        return _waypoint(path, follow - 1)
    x_m, y_m, speed_mps = _at(path, start_m)
    return Waypoint(x_m=x_m, y_m=y_m, speed_mps=speed_mps)


def _waypoint(path: LegPath, index: int) -> Waypoint:
    point = path.points[index]
    is_last = index == len(path.points) - 1
    return Waypoint(
        x_m=point.x_m,
        y_m=point.y_m,
        speed_mps=point.speed_mps,
        heading_rad=path.heading_rad if is_last else None,
    )
