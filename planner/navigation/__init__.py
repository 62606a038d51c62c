"""Make waypoints: find a way over the map, and cut the horizon that is streamed. One door.

Nothing here imports numpy or OpenCV, so the planner's own process stays light and its loop is never
held: the search runs behind :class:`RouteWorker`. Who wants it in his own process, as the lockstep
harness does, imports ``planner.navigation.router`` by name.
"""

from planner.navigation.horizon import Horizon, LegPath, cut
from planner.navigation.process_client import RouteWorker
from planner.navigation.route import (
    FloorReport,
    Mover,
    ObstacleReport,
    RouteFailure,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
    RouteSurvey,
    ScanObservation,
)

__all__ = [
    "FloorReport",
    "Horizon",
    "LegPath",
    "Mover",
    "ObstacleReport",
    "RouteFailure",
    "RouteLimits",
    "RoutePoint",
    "RouteRequest",
    "RouteResult",
    "RouteSurvey",
    "RouteWorker",
    "ScanObservation",
    "cut",
]
