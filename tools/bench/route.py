"""Time the route search and whole routes: ``python -m tools.bench.route``. Prints tables only.

Beside the time stands the longest silence of a second thread, which is what a heartbeat in the same
process would have suffered; the search runs in a process of its own because of that column.
"""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from itertools import permutations
from pathlib import Path
from statistics import median
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from maps.cell_array import cell_array
from planner.navigation import RouteLimits, RouteRequest
from planner.navigation.costmap import Costmap, static_costmap
from planner.navigation.raster import distance_m
from planner.navigation.router import Router
from planner.navigation.search import Lattice, costs_to, find_path
from planner.site import FREE, Site, load_map

ROOT = Path(__file__).resolve().parents[2]
FOREIGN = ROOT.parent / "shared" / "data" / "maps"
PAIRS = 7
T = TypeVar("T")


def wavefront(cost: NDArray[np.float64], goal: int, width: int) -> NDArray[np.float64]:
    """Return the cost from every cell to the goal, a band of two cells at a time, in numpy."""
    free = np.isfinite(cost)
    steps = []
    for row, column in [(0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)]:
        beside = free & np.roll(free, -row * width) & np.roll(free, -column)
        steps.append((row * width + column, float(np.hypot(row, column)) / 2, beside))
    best = np.full(len(cost), np.inf)
    best[goal], edge, until = 0.0, np.array([goal]), 2.0
    while edge.size:
        now = edge[best[edge] < until]
        if not now.size:
            until = float(best[edge].min()) + 2.0
            continue
        found = [edge[best[edge] >= until]]
        for step, half, allowed in steps:
            here = now[allowed[now]]
            there = here + step
            total = best[here] + half * (cost[here] + cost[there])
            better = total < best[there]
            best[there[better]] = total[better]
            found.append(there[better])
        edge = np.unique(np.concatenate(found))
    return best


def measure_silence(work: Callable[[], T]) -> tuple[T, float, float]:
    """Return the result, its time and the longest silence of another thread [ms]."""
    silences, done = [0.0], threading.Event()

    def tick() -> None:
        last_s = time.perf_counter()
        while not done.wait(0.001):
            now_s = time.perf_counter()
            silences.append(now_s - last_s - 0.001)
            last_s = now_s

    thread = threading.Thread(target=tick)
    thread.start()
    began_s = time.perf_counter()
    result = work()
    took_s = time.perf_counter() - began_s
    time.sleep(0.003)
    done.set()
    thread.join()
    return result, took_s * 1e3, max(silences) * 1e3


def costmaps() -> Iterator[tuple[str, Costmap]]:
    """Yield our sites, and maps made by others where they lie beside the checkout."""
    for name in ("two_room", "home"):
        yield name, static_costmap(Site.load(ROOT / "sites" / name), RouteLimits().radius_m)
    for name in ("aws_small_house/map.yaml", "nav2_depot/depot.yaml"):
        if not (FOREIGN / name).is_file():
            print(f"{name}: not beside this checkout, left out")
            continue
        grid = load_map(FOREIGN / name).grid
        cells = cell_array(grid)
        room = distance_m(cells == FREE, grid.resolution_m)
        # No fence bounds these; a robot of 0.22 m, for which their doors were made.
        yield name, Costmap(grid, 0.22, cells != FREE, room, np.full_like(room, 9.0))


def searches(costmap: Costmap) -> dict[str, list[tuple[float, float]]]:
    """Return (time, silence) [ms] of each search between random cells of the largest floor."""
    lattice = Lattice.of(costmap.cost)
    flat, width = np.array(lattice.cost), lattice.stride
    largest = int(np.argmax(np.bincount(costmap.labels.ravel())[1:])) + 1
    cells = np.flatnonzero(np.pad(costmap.labels, 1).ravel() == largest).tolist()
    chance = random.Random(3)
    table: dict[str, list[tuple[float, float]]] = {}
    for _ in range(PAIRS):
        start, goal = chance.sample(cells, 2)
        known, *slow = measure_silence(partial(costs_to, lattice, goal))
        table.setdefault("costs to a goal", []).append((slow[0], slow[1]))
        candidates: dict[str, Callable[[], object]] = {
            "A*": partial(find_path, lattice, start, goal),
            "A*, costs known": partial(find_path, lattice, start, goal, known),
            "numpy wavefront": partial(wavefront, flat, goal, width),
        }
        for name, work in candidates.items():
            table.setdefault(name, []).append(measure_silence(work)[1:])
    return table


def routes(name: str) -> None:
    """Print the time of whole routes between all places of one of our sites."""
    site = Site.load(ROOT / "sites" / name)
    router = Router(site, RouteLimits())
    for what in ("as started", "costs known"):
        took = sorted(
            router.route(RouteRequest(a.pose, b.pose)).took_s * 1e3
            for a, b in permutations(site.places, 2)
        )
        p99 = took[int(0.99 * (len(took) - 1))]
        print(f"{name:12} {what:12} n {len(took):4} p50 {median(took):6.1f} p99 {p99:6.1f} ms")
        for _ in router.warm():
            pass


def main() -> None:
    """Print both tables."""
    print("search between random cells [ms]: p50, max, longest silence of another thread")
    for name, costmap in costmaps():
        print(f"{name}: {costmap.grid.width} x {costmap.grid.height} cells")
        for what, rows in searches(costmap).items():
            took, silent = zip(*rows, strict=True)
            print(f"  {what:18} {median(took):8.1f} {max(took):8.1f} {max(silent):8.1f}")
    print("whole routes between places: costmap, search, shaping, waypoints")
    for name in ("two_room", "home"):
        routes(name)


if __name__ == "__main__":
    main()
