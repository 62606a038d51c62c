"""Make waypoints: find a way over the map, and cut the horizon that is streamed. One door.

Nothing here imports numpy or OpenCV, so the planner's own process stays light and its loop is never
held: the search runs behind :class:`RouteWorker`. Who wants it in his own process, as the lockstep
harness does, imports ``planner.route.router`` by name.
"""

from planner.route.horizon import Horizon, LegPath, cut
from planner.route.request import (
    RouteFailure,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
)
from planner.route.worker import RouteWorker

__all__ = [
    "Horizon",
    "LegPath",
    "RouteFailure",
    "RouteLimits",
    "RoutePoint",
    "RouteRequest",
    "RouteResult",
    "RouteWorker",
    "cut",
]
