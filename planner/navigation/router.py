"""Turn a request into a route: the one place where the pieces meet. No processes, no sockets.

Brings numpy and OpenCV along, so the planner's own process uses :class:`RouteWorker` instead; the
worker, the lockstep harness and benches use this.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from math import hypot, isfinite
from time import perf_counter

import numpy as np

from planner.navigation.bay import find_bay
from planner.navigation.coarse_search import SearchFloor, floor_of
from planner.navigation.costmap import Costmap, static_costmap
from planner.navigation.frontier import FrontierMemory, find_frontiers, known_m2
from planner.navigation.keep_right import keep_right
from planner.navigation.obstacle_memory import ObstacleMemory
from planner.navigation.pocket import choose_pocket, keep_off
from planner.navigation.route import (
    MIN_SPEED_MPS,
    FloorReport,
    ObstacleReport,
    RouteFailure,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
    ScanObservation,
)
from planner.navigation.search import costs_in_slices, costs_to
from planner.navigation.smoothing import Line, densify, is_free, relax, straighten
from planner.navigation.start_and_goal import Cell, Ends, choose_ends, choose_start, moved_m
from planner.navigation.straight_line import BACK_MPS, backwards, straight_line
from planner.navigation.way_survey import survey
from planner.navigation.waypoints import evenly, speeds, thin
from planner.site import Site
from wire import Pose2

MAX_FIELD_BYTES = 64_000_000
"""All exact costs kept: 130 places on a home of 10 x 12 m, none that matter on a huge map."""

_CLOSED = frozenset({"no_route", "start_blocked", "goal_blocked", "goal_occupied"})
LANDMARKS = 8
"""Exact costs to so many cells bound the cost between any two: a search to a goal that nobody named
then looks at little more than with exact costs to it (ADR 0040)."""

PART_M2 = 0.3
"""For the robot's middle: a part of the floor that is smaller leads nowhere."""

MAX_OUTSIDE_M = 0.28
"""A horizon begins within 0.3 m of the robot, and inside the fence."""


class Router:
    """Find routes on one site for one robot. The map's part of the work is done once."""

    def __init__(self, site: Site, limits: RouteLimits) -> None:
        """Prepare the costmap of the map as it is."""
        self._site = site
        self._limits = limits
        self._mapped = static_costmap(site, limits.radius_m)
        self._floor = self._floor_of(self._mapped)
        self._fields: dict[int, array[float]] = {}

    def new_memory(self) -> ObstacleMemory:
        """Return a memory of obstacles on this map in which nothing was seen."""
        return ObstacleMemory(self._mapped.occupied.shape)

    def observe(self, memory: ObstacleMemory, seen: ScanObservation) -> ObstacleReport:
        """Take a scan into a memory; say what it holds then, and whether the way is open.

        What moves closes no way: the bridge stops for it, and it goes on.
        """
        memory.observe(self._mapped, seen)
        return memory.report(self._mapped, seen.ahead)

    def warm(self) -> Iterator[None]:
        """Work out the exact cost to every place, a few milliseconds at each turn.

        The first turn drives home in thought, so that the first real request finds all it needs.
        """
        with suppress(RouteFailure):
            self.route(RouteRequest(self._site.places[0].pose, self._site.home.pose))
        yield
        lattice = self._floor.lattice
        size = 4 * len(lattice.cost)
        for place in self._site.places[: MAX_FIELD_BYTES // size]:
            column, row = self._site.grid.cell_of(place.pose.x_m, place.pose.y_m)
            if self._mapped.free[row, column]:
                goal = self._floor.index((column, row))
                self._fields[goal] = yield from costs_in_slices(lattice, goal)
        yield from self._warm_landmarks(MAX_FIELD_BYTES // size)

    def _warm_landmarks(self, most: int) -> Iterator[None]:
        """Add fields to cells far from all that have one, until enough tell where any goal lies."""
        while 0 < len(self._fields) < min(LANDMARKS, most):
            nearest = np.min([np.asarray(field) for field in self._fields.values()], axis=0)
            yield
            far = int(np.argmax(np.where(np.isfinite(nearest), nearest, -1.0)))
            if far in self._fields:
                return
            self._fields[far] = yield from costs_in_slices(self._floor.lattice, far)

    @property
    def goals_known(self) -> int:
        """Return to how many goals the exact costs are worked out."""
        return len(self._fields)

    def route(
        self,
        request: RouteRequest,
        clock: Callable[[], float] = perf_counter,
        memory: ObstacleMemory | None = None,
        frontiers: FrontierMemory | None = None,
    ) -> RouteResult:
        """Find the way, around what the memory holds; to explore, past the frontiers visited.

        Raises:
            RouteFailure: there is none; the code says why.
        """
        began_s = clock()
        _check(request)
        start_m = (request.start.x_m, request.start.y_m)
        layered = self._mapped if memory is None else memory.costmap(self._mapped)
        seen = request.obstacles if memory is None else memory.leave_movers_out(request.obstacles)
        costmap = layered.with_obstacles(seen, start_m)
        if request.straight:
            return self._straight(costmap, request, began_s, clock)
        if request.explore:
            return self._explore(costmap, request, frontiers or FrontierMemory(), began_s, clock)
        if request.aside:
            person_m = (request.goal.x_m, request.goal.y_m)
            if request.passes_m > 0.0:
                costmap = keep_off(costmap, start_m, person_m)
                bay_m = choose_pocket(self._mapped, costmap, request, self._price_from)
            else:
                bay_m = find_bay(self._mapped, costmap, start_m, person_m)
            if bay_m == start_m:
                here = RoutePoint(*bay_m, MIN_SPEED_MPS)
                return RouteResult((here,), 0.0, 0.0, False, clock() - began_s)
            aside = replace(request, goal=Pose2(*bay_m, request.start.yaw_rad), aside=False)
            return self._find(costmap, aside, began_s, clock)
        try:
            return self._find(costmap, request, began_s, clock)
        except RouteFailure as failure:
            has_hope = memory is not None and layered is not self._mapped and not request.strict
            if memory is None or not has_hope or failure.code not in _CLOSED:
                raise
        # No way by what is remembered: then perhaps it is gone, and worth a look.
        hopeful = memory.hopeful_costmap(self._mapped).with_obstacles(seen, start_m)
        try:
            return _mark_hoped(self._find(hopeful, request, began_s, clock))
        except RouteFailure as failure:
            if request.obstacles or failure.code not in _CLOSED:
                raise
        # A first way, and somebody stands in the only door: the robot drives up to it and waits
        # there (docs/adr/0041), instead of failing before it has tried.
        patient = memory.patient_costmap(self._mapped)
        return _mark_hoped(self._find(patient, request, began_s, clock))

    def _find(
        self, costmap: Costmap, request: RouteRequest, began_s: float, clock: Callable[[], float]
    ) -> RouteResult:
        ends = choose_ends(costmap, self._site, request, self._mapped)
        line = self._line(costmap, request, ends)
        if request.keep_right_m > 0.0:
            line = keep_right(costmap, line, request.keep_right_m)
        return RouteResult(
            points=self._points(costmap, line),
            length_m=float(np.hypot(*np.diff(line, axis=0).T).sum()),
            moved_goal_m=moved_m(costmap, request, ends),
            start_escaped=ends.start_escaped,
            took_s=clock() - began_s,
            faces=ends.faces_m,
            survey=survey(costmap, line) if request.survey else None,
        )

    def _explore(
        self,
        costmap: Costmap,
        request: RouteRequest,
        memory: FrontierMemory,
        began_s: float,
        clock: Callable[[], float],
    ) -> RouteResult:
        """Find the way to where the best frontier is seen from; stay where there is none."""
        grid, start = self._site.grid, choose_start(costmap, request)
        price_m, part = self._price_from(costmap, start), costmap.labels[start[1], start[0]]

        def way_m(cell: Cell) -> float:
            joined = costmap.labels[cell[1], cell[0]] == part
            return price_m(cell) if joined else float("inf")

        memory.note_start((request.start.x_m, request.start.y_m), grid)
        frontier = memory.choose(find_frontiers(grid, costmap, way_m))
        if frontier is None:
            # Somebody in a door, on the map or not, does not make what lies behind it explored.
            if memory.leaves_out(find_frontiers(grid, costmap, _way_elsewhere(costmap, start))):
                raise RouteFailure("no_route", "what is left lies behind what stands in the way")
            memory.forget()
        report = FloorReport(known_m2(grid), explored=frontier is None)
        if frontier is None:
            here = RoutePoint(request.start.x_m, request.start.y_m, MIN_SPEED_MPS)
            return RouteResult((here,), 0.0, 0.0, False, clock() - began_s, report)
        goal = Pose2(*frontier.stand, request.start.yaw_rad)
        found = self._find(costmap, replace(request, goal=goal, explore=False), began_s, clock)
        return replace(found, floor=report)

    def _price_from(self, costmap: Costmap, start: Cell) -> Callable[[Cell], float]:
        """Return the price of the way from a cell to another, in metres of open floor."""
        floor = self._floor if costmap is self._mapped else self._floor_of(costmap)
        field = costs_to(floor.lattice, floor.index(start))
        step_m = floor.cells_a_step * costmap.grid.resolution_m
        return lambda cell: field[floor.index(cell)] * step_m

    def _straight(
        self, costmap: Costmap, request: RouteRequest, began_s: float, clock: Callable[[], float]
    ) -> RouteResult:
        line = straight_line(costmap, request)
        points = self._points(costmap, line)
        if backwards(request):
            points = tuple(
                RoutePoint(point.x_m, point.y_m, -min(point.speed_mps, BACK_MPS))
                for point in points
            )
        goal_m = np.asarray((request.goal.x_m, request.goal.y_m))
        return RouteResult(
            points=points,
            length_m=float(np.hypot(*np.diff(line, axis=0).T).sum()),
            moved_goal_m=float(hypot(*(goal_m - line[-1]))),
            start_escaped=False,
            took_s=clock() - began_s,
            survey=survey(costmap, line) if request.survey else None,
        )

    def _line(self, costmap: Costmap, request: RouteRequest, ends: Ends) -> Line:
        cells = self._search(costmap, ends.start, ends.goal)
        line = np.asarray([costmap.grid.centre_of(*cell) for cell in cells])
        start_m = np.asarray((request.start.x_m, request.start.y_m))
        if not ends.goal_moved:
            line[-1] = (request.goal.x_m, request.goal.y_m)
        if not ends.start_escaped:
            line = np.concatenate([[start_m], line[1:] if len(line) > 1 else line])
            return _smooth(costmap, line)
        return np.concatenate([self._way_out(start_m, line[0]), _smooth(costmap, line)[1:]])

    def _way_out(self, start_m: Line, free_m: Line) -> Line:
        """Return the straight way from a tight spot to free floor, without what the bridge refuses.

        The bridge lets a robot outside the fence come back in, but takes no point outside it.
        """
        out = evenly(np.stack([start_m, free_m]))
        inside = [self._site.fence.allows(x_m, y_m) for x_m, y_m in out.tolist()]
        out = np.asarray(out[inside], np.float64)
        if len(out) == 0 or hypot(*(out[0] - start_m)) > MAX_OUTSIDE_M:
            raise RouteFailure("start_blocked", f"more than {MAX_OUTSIDE_M} m outside the fence")
        return out

    def _search(self, costmap: Costmap, start: Cell, goal: Cell) -> list[Cell]:
        floor = self._floor if costmap is self._mapped else self._floor_of(costmap)
        # Obstacles only ever raise costs, so what the map says is never more than the truth.
        path = floor.find_path(start, goal, self._fields)
        if path is None:
            raise RouteFailure("no_route", "no free floor joins them")
        return path

    def _floor_of(self, costmap: Costmap) -> SearchFloor:
        return floor_of(costmap.cost, costmap.grid.resolution_m, self._limits.radius_m)

    def _points(self, costmap: Costmap, line: Line) -> tuple[RoutePoint, ...]:
        fence = self._site.fence
        zone_mps = np.asarray([fence.max_speed_mps(x_m, y_m) for x_m, y_m in line.tolist()])
        wanted = speeds(costmap, line, zone_mps, self._limits)
        return tuple(
            RoutePoint(x_m, y_m, speed_mps)
            for (x_m, y_m), speed_mps in zip(line.tolist(), wanted.tolist(), strict=True)
        )


def _mark_hoped(found: RouteResult) -> RouteResult:
    """Return a way with its survey told that it is open only by hope."""
    told = found.survey
    return found if told is None else replace(found, survey=replace(told, hoped=True))


def _way_elsewhere(costmap: Costmap, start: Cell) -> Callable[[Cell], float]:
    """Return a price that is nothing on each part of the floor but the robot's own.

    Pockets between furniture, and floor seen through a gap in a wall, are no such parts.
    """
    labels = costmap.labels
    cells = np.bincount(labels.ravel())
    cells[labels[start[1], start[0]]] = 0
    fewest = PART_M2 / costmap.grid.resolution_m**2
    return lambda cell: 0.0 if cells[labels[cell[1], cell[0]]] >= fewest else float("inf")


def _smooth(costmap: Costmap, line: Line) -> Line:
    """Return the best-shaped version of a way of cells that stays on free floor."""
    straight = straighten(costmap, line)
    for smooth in (evenly(relax(costmap, densify(straight))), evenly(straight, 0.06)):
        if is_free(costmap, smooth):
            return smooth
    return thin(line)


def _check(request: RouteRequest) -> None:
    ends = [(pose.x_m, pose.y_m) for pose in (request.start, request.goal)]
    ends += [request.sees] if request.sees is not None else []
    if not all(isfinite(x_m) and isfinite(y_m) for x_m, y_m in ends):
        raise RouteFailure("route_request_malformed", "a coordinate is not a finite number")
