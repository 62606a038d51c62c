"""Choose where a route begins and ends when what was asked for is blocked. Knows the costmap."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot

import numpy as np
from numpy.typing import NDArray

from maps import FREE, OCCUPIED
from maps.cell_array import cell_array
from planner.navigation.costmap import Costmap
from planner.navigation.route import RouteFailure, RouteRequest
from planner.navigation.smoothing import sample
from planner.site import Site
from wire import Pose2

ESCAPE_M = 0.6
"""A robot squeezed in deeper than this does not stand where the map says."""
GOAL_MOVE_M = 0.5
ROOM_M = 0.10
"""Kept clear about a robot that stands: the bridge's gate stops it 0.05 m before anything, and the
pose and the map's cells err by about as much."""
SHIFT_M = 0.15
"""A goal is moved by so much for the sake of room; what is meant by it stays the same."""

SEES_M = 1.6
"""So far from a point on mapped furniture the way may end, where just that is gone to: half a bed,
and room to stand."""
DEEP_M = 1.3
"""So deep in furniture a point may lie; what is deeper lies behind it."""
SIGHT_STEP = 0.25
"""Of a cell: steps of a line of sight."""

Cell = tuple[int, int]
Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Ends:
    """Hold the free cells (column, row) between which to search."""

    start: Cell
    goal: Cell
    start_escaped: bool
    goal_moved: bool
    faces_m: Point | None = None
    """What the goal is to see and to face; None: nothing in particular."""


@dataclass(frozen=True, slots=True)
class _Near:
    """List free cells around a point, the nearest first."""

    columns: NDArray[np.intp]
    rows: NDArray[np.intp]
    away_m: NDArray[np.float64]

    def keep(self, wanted: NDArray[np.bool_]) -> _Near:
        return _Near(self.columns[wanted], self.rows[wanted], self.away_m[wanted])

    def before(self, wanted: NDArray[np.bool_]) -> _Near:
        """Put the cells that are wanted before all others, in the order that they have."""
        order = np.argsort(~wanted, kind="stable")
        return _Near(self.columns[order], self.rows[order], self.away_m[order])

    def first(self) -> Cell:
        return int(self.columns[0]), int(self.rows[0])


def choose_ends(
    costmap: Costmap, site: Site, request: RouteRequest, mapped: Costmap | None = None
) -> Ends:
    """Find the nearest free start and goal that are joined by free floor.

    Args:
        costmap: what is known now.
        site: whose rooms bound how far a goal may be moved.
        request: from where to where.
        mapped: the map alone. A goal that is free on it, and not now, has something standing on it;
            then only floor on the robot's side of it will do, since what lies behind is not seen. A
            goal that is not free on it lies in furniture or too near to a wall: the end then sees
            it on the map, so that it is not on a wall's other side.

    Raises:
        RouteFailure: ``start_outside_map``, ``goal_outside_map``, ``goal_blocked``,
            ``goal_occupied`` (by what is not on the map),
            ``start_blocked`` or ``no_route``.
    """
    start_m, goal_m = _xy(costmap, request, "start"), _xy(costmap, request, "goal")
    sight = _sight(costmap if mapped is None else mapped, site, request, goal_m)
    goals = _goals(costmap, site, goal_m, _seen_from(costmap, mapped, start_m, goal_m), sight)
    starts = _starts(costmap, start_m)
    labels = costmap.labels
    joined = starts.keep(
        np.isin(labels[starts.rows, starts.columns], labels[goals.rows, goals.columns])
    )
    if len(joined.rows) == 0:
        raise RouteFailure("no_route", "no free floor joins them")
    start = joined.first()
    goal = goals.keep(labels[goals.rows, goals.columns] == labels[start[1], start[0]]).first()
    return Ends(
        start,
        goal,
        start_escaped=start != costmap.grid.cell_of(*start_m),
        goal_moved=goal != costmap.grid.cell_of(*goal_m),
        faces_m=sight.at_m if sight is not None and sight.faces else None,
    )


@dataclass(frozen=True, slots=True)
class _Sight:
    """Say what the end of a way is to see on the map."""

    at_m: Point
    from_m: float = 0.0
    """No nearer to it."""
    reach_m: float = GOAL_MOVE_M
    """How far the goal may be moved for it."""
    faces: bool = True
    in_furniture: bool = False
    """It lies on what stands there by the map: seen is then the outside of that."""

    def seen_from(self, costmap: Costmap, site: Site, near: _Near) -> NDArray[np.bool_]:
        """Tell from which cells it is seen: free floor, then perhaps what it lies in, and it.

        A wall that furniture stands against can't be told from it: where rooms are known, it is
        seen from its own room alone.
        """
        grid = costmap.grid
        x_m = grid.origin_x_m + (near.columns + 0.5) * grid.resolution_m
        y_m = grid.origin_y_m + (near.rows + 0.5) * grid.resolution_m
        away_m = np.hypot(x_m - self.at_m[0], y_m - self.at_m[1])
        solid = _solid_on_lines(site, np.stack([x_m, y_m], axis=1), self.at_m)
        once = (np.diff(solid.astype(np.int8), axis=1) >= 0).all(axis=1)
        deep_m = solid.mean(axis=1) * away_m
        seen = once & (deep_m <= DEEP_M) & (away_m >= self.from_m)
        room = site.room_at(*self.at_m) if self.in_furniture else None
        if room is not None:
            cells = zip(x_m.tolist(), y_m.tolist(), strict=True)
            seen &= np.array([room.contains(*xy) for xy in cells], np.bool_)
        return np.asarray(seen, np.bool_)


def _solid_on_lines(site: Site, starts: NDArray[np.float64], end_m: Point) -> NDArray[np.bool_]:
    """Return what is not free floor along the lines from points (n, 2) to one, shape (n, steps)."""
    grid = site.grid
    longest_m = float(np.hypot(*(starts - np.asarray(end_m)).T).max(initial=0.0))
    steps = max(2, ceil(longest_m / (SIGHT_STEP * grid.resolution_m)) + 1)
    share = np.linspace(0.0, 1.0, steps)
    x_m = starts[:, :1] + share * (end_m[0] - starts[:, :1])
    y_m = starts[:, 1:] + share * (end_m[1] - starts[:, 1:])
    column = ((x_m - grid.origin_x_m) / grid.resolution_m).astype(np.intp)
    row = ((y_m - grid.origin_y_m) / grid.resolution_m).astype(np.intp)
    cells = cell_array(grid)
    inside = (column >= 0) & (column < grid.width) & (row >= 0) & (row < grid.height)
    found = cells[np.clip(row, 0, grid.height - 1), np.clip(column, 0, grid.width - 1)]
    return np.asarray(~inside | (found != FREE), np.bool_)


def _sight(mapped: Costmap, site: Site, request: RouteRequest, goal_m: Point) -> _Sight | None:
    """Return what the end is to see: as asked for, else a goal that the map leaves no room at."""
    at_m = request.sees or goal_m
    column, row = mapped.grid.cell_of(*goal_m)
    if request.sees is None and mapped.free[row, column]:
        return None
    if not mapped.grid.contains(*at_m):
        raise RouteFailure("goal_outside_map", f"({at_m[0]:.2f}, {at_m[1]:.2f})")
    furniture = site.grid.at(*at_m) == OCCUPIED
    far = furniture and request.sees == goal_m
    reach_m = SEES_M if far else GOAL_MOVE_M
    faces = request.sees is not None
    return _Sight(at_m, request.sees_from_m, reach_m, faces, furniture)


def _xy(costmap: Costmap, request: RouteRequest, which: str) -> tuple[float, float]:
    pose = request.start if which == "start" else request.goal
    if not costmap.grid.contains(pose.x_m, pose.y_m):
        raise RouteFailure(f"{which}_outside_map", f"({pose.x_m:.2f}, {pose.y_m:.2f})")
    return pose.x_m, pose.y_m


def _seen_from(
    costmap: Costmap,
    mapped: Costmap | None,
    start_m: tuple[float, float],
    goal_m: tuple[float, float],
) -> tuple[float, float] | None:
    """Return from where a goal is seen on which something stands; None: nothing does."""
    column, row = costmap.grid.cell_of(*goal_m)
    stands = mapped is not None and mapped.free[row, column] and not costmap.free[row, column]
    return start_m if stands else None


def end_cells(costmap: Costmap, site: Site, goal: Pose2) -> tuple[NDArray[np.intp], ...]:
    """Return rows and columns of the cells at which a way to a goal may end; none where none is."""
    request, at_m = RouteRequest(goal, goal), (goal.x_m, goal.y_m)
    try:
        near = _goals(costmap, site, at_m, None, _sight(costmap, site, request, at_m))
    except RouteFailure:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    return near.rows, near.columns


def _goals(
    costmap: Costmap,
    site: Site,
    goal_m: tuple[float, float],
    seen_from_m: tuple[float, float] | None = None,
    sight: _Sight | None = None,
) -> _Near:
    """List where to end: with room to stand, where that is about as near as any free floor."""
    column, row = costmap.grid.cell_of(*goal_m)
    stands = costmap.clearance_m >= costmap.radius_m + ROOM_M
    here = _only(column, row)
    sees = sight is None or bool(sight.seen_from(costmap, site, here)[0])
    if costmap.free[row, column] and stands[row, column] and sees:
        return here
    near = _free_near(costmap, goal_m, GOAL_MOVE_M if sight is None else sight.reach_m)
    if sight is not None:
        near = near.keep(sight.seen_from(costmap, site, near))
    if seen_from_m is not None:
        near = near.keep(_on_this_side(costmap, near, goal_m, seen_from_m))
    room = site.room_at(*goal_m)
    if room is not None and not (sight is not None and sight.in_furniture):
        # Half a metre may reach through a wall; what was meant is on this side of it.
        centres = [
            costmap.grid.centre_of(*cell) for cell in zip(near.columns, near.rows, strict=True)
        ]
        near = near.keep(np.array([room.contains(*xy) for xy in centres], bool))
    if len(near.rows) == 0:
        reach_m = GOAL_MOVE_M if sight is None else sight.reach_m
        unseen = "" if sight is None else f" that sees ({sight.at_m[0]:.2f}, {sight.at_m[1]:.2f})"
        text = f"({goal_m[0]:.2f}, {goal_m[1]:.2f}), none within {reach_m} m{unseen}"
        raise RouteFailure("goal_blocked" if seen_from_m is None else "goal_occupied", text)
    roomy = stands[near.rows, near.columns] & (near.away_m <= near.away_m[0] + SHIFT_M)
    if costmap.free[row, column] and not roomy.any() and sees:
        return here
    return near.before(roomy)


def _on_this_side(
    costmap: Costmap, near: _Near, goal_m: tuple[float, float], seen_from_m: tuple[float, float]
) -> NDArray[np.bool_]:
    """Tell of each cell whether it lies on the side of the goal that faces a point."""
    x_m, y_m = costmap.grid.centre_of(near.columns, near.rows)  # type: ignore[arg-type]
    towards = (seen_from_m[0] - goal_m[0], seen_from_m[1] - goal_m[1])
    side = (x_m - goal_m[0]) * towards[0] + (y_m - goal_m[1]) * towards[1]
    return np.asarray(side >= 0.0, np.bool_)


def choose_start(costmap: Costmap, request: RouteRequest) -> Cell:
    """Return the nearest free cell to begin in.

    Raises:
        RouteFailure: ``start_outside_map`` or ``start_blocked``.
    """
    return _starts(costmap, _xy(costmap, request, "start")).first()


def _starts(costmap: Costmap, start_m: tuple[float, float]) -> _Near:
    column, row = costmap.grid.cell_of(*start_m)
    if costmap.free[row, column]:
        return _only(column, row)
    near = _free_near(costmap, start_m, ESCAPE_M)
    near = near.keep(
        np.array(
            [
                _leads_out(costmap, start_m, cell)
                for cell in zip(near.columns, near.rows, strict=True)
            ],
            bool,
        )
    )
    if len(near.rows) == 0:
        text = f"({start_m[0]:.2f}, {start_m[1]:.2f}), none within {ESCAPE_M} m"
        raise RouteFailure("start_blocked", text)
    return near


def _leads_out(costmap: Costmap, start_m: tuple[float, float], cell: Cell) -> bool:
    """Tell whether a straight line leaves the tight spot without coming nearer to any obstacle."""
    line = sample(np.asarray(start_m), np.asarray(costmap.grid.centre_of(*cell)))
    clearance_m = costmap.clearance_at(line)
    # One cell of tolerance: clearance is known per cell, and the pose to a few centimetres.
    lowest_m = max(0.0, float(clearance_m[0]) - costmap.grid.resolution_m)
    inside = costmap.fence_gap_at(line) > 0.0
    leaves_fence = inside[:-1] & ~inside[1:]
    return bool((clearance_m >= lowest_m).all() and not leaves_fence.any())


def _free_near(costmap: Costmap, xy_m: tuple[float, float], reach_m: float) -> _Near:
    grid = costmap.grid
    column, row = grid.cell_of(*xy_m)
    reach = ceil(reach_m / grid.resolution_m)
    left, low = max(0, column - reach), max(0, row - reach)
    window = costmap.free[low : row + reach + 1, left : column + reach + 1]
    rows, columns = np.nonzero(window)
    rows, columns = rows + low, columns + left
    x_m = grid.origin_x_m + (columns + 0.5) * grid.resolution_m
    y_m = grid.origin_y_m + (rows + 0.5) * grid.resolution_m
    away_m = np.hypot(x_m - xy_m[0], y_m - xy_m[1])
    order = np.argsort(away_m, kind="stable")
    return _Near(columns[order], rows[order], away_m[order]).keep(away_m[order] <= reach_m)


def _only(column: int, row: int) -> _Near:
    return _Near(np.array([column]), np.array([row]), np.zeros(1))


def moved_m(costmap: Costmap, request: RouteRequest, ends: Ends) -> float:
    """Return how far the goal was moved [m]."""
    if not ends.goal_moved:
        return 0.0
    x_m, y_m = costmap.grid.centre_of(*ends.goal)
    return hypot(x_m - request.goal.x_m, y_m - request.goal.y_m)
