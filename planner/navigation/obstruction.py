"""Find what stands in a robot's way: from the lidar's points and the path ahead, and no search.

Mathematics on points of ``map`` [m], without numpy: the planner's own process calls this while the
robot is blocked. What the map explains is no obstruction. Only the side that faces the lidar is
seen, so an obstruction is a line between the two ends of that side.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan2, ceil, cos, hypot, pi, sin
from typing import TypeAlias

from maps.grid import FREE, GridMap
from wire import Pose2, Scan, compose
from wire.lidar_config import LidarConfig
from wire.margins import OBSTACLE_MARGIN_M

Point: TypeAlias = tuple[float, float]

AHEAD_M = 1.5
"""What stands farther along the path does not hold the robot yet: its gate looks 1.0 m ahead."""
SLACK_M = 0.10
"""On each side of the strip that the gate keeps free, for the errors of pose and lidar."""
EXPLAINED_M = 0.12
"""A point this near to an occupied cell is the map's own wall."""
GAP_M = 0.30
"""Points nearer to each other than this are one thing: nothing drives between them."""
WIDEST_M = 3.0
LEAST_SHARE = 0.8
"""Of the beams towards a place; so many must pass it before it counts as open."""
BEHIND_M = 0.30
"""A beam passes a place that ends so far behind it."""
NARROW_AHEAD_M = 0.6
"""A gap between walls of the map holds the robot that stands in it or right before it."""
NARROW_SPARE_M = 0.05
"""On each side beyond the gate's margin: what pose, path and lidar err by together."""
ROUND_M = 0.05
"""The points of a round thing lie so near to its circle: the lidar's noise, and the pose's."""
ROUND_SHARE = 1.4
"""Of the radius, what is seen of the width at least: less is a leg or the edge of something."""
SEEN_M = 3.5
"""Farther away than this a door's width is a handful of beams."""


@dataclass(frozen=True, slots=True)
class Obstruction:
    """Describe one thing in the way by the ends of its near side, in ``map`` [m]."""

    start: Point
    end: Point
    gap: bool = False
    """Nothing stands there: the map's own walls leave too little room between the two ends."""
    is_round: bool = False
    """Its near side is as round and as wide as the robot that sees it: perhaps another one."""

    @property
    def middle(self) -> Point:
        """Return the middle of the near side."""
        return (self.start[0] + self.end[0]) / 2, (self.start[1] + self.end[1]) / 2

    @property
    def width_m(self) -> float:
        """Return the length of the near side."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])


def find_obstruction(
    points: Sequence[Point],
    path: Sequence[Point],
    robot_xy_m: Point,
    radius_m: float,
    grid: GridMap,
) -> Obstruction | None:
    """Return what stands in the next 1.5 m of the path, the nearest first; None: nothing seen.

    Args:
        points: the newest scan's returns in ``map``.
        path: the path's points, all of them, in their order.
        robot_xy_m: the robot's centre.
        radius_m: of the disc that holds the robot.
        grid: the map that explains walls.
    """
    ahead = _ahead(path, robot_xy_m)
    news = [point for point in points if not _is_explained(grid, point)]
    reach_m = radius_m + OBSTACLE_MARGIN_M + SLACK_M
    met = [point for point in news if any(_away_m(point, at) <= reach_m for at in ahead)]
    if not met:
        return None
    seed = min(met, key=lambda point: _away_m(point, robot_xy_m))
    return _side(_grow(seed, news), robot_xy_m, radius_m)


def find_narrow(
    path: Sequence[Point], robot_xy_m: Point, radius_m: float, grid: GridMap
) -> Obstruction | None:
    """Return the narrowest gap between the map's walls in the next 0.6 m of the path.

    None: the walls leave the disc its margin and 0.05 m more on each side. Arguments as of
    ``find_obstruction``.
    """
    ahead = _ahead(path, robot_xy_m, NARROW_AHEAD_M)
    enough_m = 2.0 * (radius_m + OBSTACLE_MARGIN_M + NARROW_SPARE_M)
    narrowest: Obstruction | None = None
    for at, then in pairwise(ahead):
        if at == then:
            continue
        aside_rad = atan2(then[1] - at[1], then[0] - at[0]) + pi / 2
        left = _wall_from(at, aside_rad, enough_m, grid)
        right = _wall_from(at, aside_rad + pi, enough_m, grid)
        if left is None or right is None:
            continue
        gap = Obstruction(left, right, gap=True)
        if gap.width_m < (narrowest.width_m if narrowest else enough_m):
            narrowest = gap
    return narrowest


def points_of(obstruction: Obstruction, spacing_m: float = 0.05) -> tuple[Point, ...]:
    """Return points along an obstruction's near side, as obstacles of a route request."""
    count = max(1, ceil(obstruction.width_m / spacing_m))
    (ax, ay), (bx, by) = obstruction.start, obstruction.end
    return tuple((ax + (bx - ax) * i / count, ay + (by - ay) * i / count) for i in range(count + 1))


def is_seen_open(
    obstruction: Obstruction, scan: Scan, lidar: LidarConfig, robot_in_map: Pose2
) -> bool:
    """Tell whether the beams towards where something stood now pass that place.

    A beam without a return says nothing here: glass and black cloth give none either.
    """
    lidar_in_map = compose(robot_in_map, Pose2(lidar.x_m, lidar.y_m, lidar.yaw_rad))
    here = (lidar_in_map.x_m, lidar_in_map.y_m)
    if not _away_m(obstruction.middle, here) <= SEEN_M:
        return False
    passed = total = 0
    for index, range_m in enumerate(scan.ranges_m):
        angle = lidar_in_map.yaw_rad + scan.angle_min_rad + index * scan.angle_increment_rad
        at_m = _crossing_m(obstruction, here, angle)
        if at_m is None:
            continue
        total += 1
        passed += range_m is not None and range_m >= at_m + BEHIND_M
    return total > 0 and passed >= LEAST_SHARE * total


def _crossing_m(obstruction: Obstruction, here: Point, angle_rad: float) -> float | None:
    """Return at which range a beam crosses the near side, or None where it passes beside it."""
    first = _bearing(here, obstruction.start, angle_rad)
    last = _bearing(here, obstruction.end, angle_rad)
    if not (first * last <= 0.0 and abs(first - last) < pi):
        return None
    near_m = _away_m(here, obstruction.start)
    far_m = _away_m(here, obstruction.end)
    share = first / (first - last) if first != last else 0.5
    return near_m + share * (far_m - near_m)


def _bearing(here: Point, there: Point, angle_rad: float) -> float:
    """Return the bearing of a point less an angle, between -pi and pi."""
    bearing = atan2(there[1] - here[1], there[0] - here[0]) - angle_rad
    return atan2(sin(bearing), cos(bearing))


def _wall_from(at: Point, towards_rad: float, most_m: float, grid: GridMap) -> Point | None:
    """Return where a line from a point meets a cell that is not free; None: nowhere so near."""
    step_m = grid.resolution_m / 2
    for index in range(1, ceil(most_m / step_m) + 1):
        x_m = at[0] + index * step_m * cos(towards_rad)
        y_m = at[1] + index * step_m * sin(towards_rad)
        if grid.at(x_m, y_m) != FREE:
            return x_m, y_m
    return None


def _ahead(path: Sequence[Point], robot_xy_m: Point, most_m: float = AHEAD_M) -> list[Point]:
    """Return so much of the path as begins nearest to the robot, and the robot before it."""
    if not path:
        return []
    nearest = min(range(len(path)), key=lambda index: _away_m(path[index], robot_xy_m))
    ahead, gone_m = [robot_xy_m], 0.0
    for point in path[nearest:]:
        gone_m += _away_m(point, ahead[-1])
        if gone_m > most_m:
            break
        ahead.append(point)
    return ahead


def _is_explained(grid: GridMap, point: Point) -> bool:
    """Tell whether a cell that is not free lies within 0.12 m of a point."""
    reach = ceil(EXPLAINED_M / grid.resolution_m)
    for column in range(-reach, reach + 1):
        for row in range(-reach, reach + 1):
            dx, dy = column * grid.resolution_m, row * grid.resolution_m
            near = hypot(dx, dy) <= EXPLAINED_M
            if near and grid.at(point[0] + dx, point[1] + dy) != FREE:
                return True
    return False


def _grow(seed: Point, points: Sequence[Point]) -> list[Point]:
    """Return the points that hang together with one of them."""
    thing, edge = [seed], [seed]
    rest = [p for p in points if p != seed and _away_m(p, seed) <= WIDEST_M]
    while edge:
        at = edge.pop()
        joined = [point for point in rest if _away_m(point, at) <= GAP_M]
        rest = [point for point in rest if _away_m(point, at) > GAP_M]
        thing += joined
        edge += joined
    return thing


def _side(thing: Sequence[Point], robot_xy_m: Point, radius_m: float) -> Obstruction:
    """Return the side that the robot sees: between the outermost bearings."""
    nearest = min(thing, key=lambda point: _away_m(point, robot_xy_m))
    towards = atan2(nearest[1] - robot_xy_m[1], nearest[0] - robot_xy_m[0])
    around = sorted(thing, key=lambda point: _bearing(robot_xy_m, point, towards))
    side = Obstruction(around[0], around[-1])
    (x_m, y_m), (mx_m, my_m) = robot_xy_m, side.middle
    share = (_away_m(nearest, robot_xy_m) + radius_m) / max(_away_m(side.middle, robot_xy_m), 0.01)
    centre = x_m + share * (mx_m - x_m), y_m + share * (my_m - y_m)
    is_round = side.width_m >= ROUND_SHARE * radius_m and all(
        abs(_away_m(point, centre) - radius_m) <= ROUND_M for point in thing
    )
    return replace(side, is_round=is_round)


def _away_m(a: Point, b: Point) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])
