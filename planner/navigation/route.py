"""Define the route search's request and result. Data only: no numpy, no process."""

from __future__ import annotations

from dataclasses import dataclass

from planner.language.catalogue import pair_up
from processes.worker_protocol import WorkerFailure
from wire.geometry import Pose2
from wire.robot import RobotDescription

REASONS = pair_up(
    "route_failure",
    (
        "no_route",
        "start_blocked",
        "goal_blocked",
        "goal_occupied",
        "start_outside_map",
        "goal_outside_map",
        "route_timed_out",
        "route_worker_died",
        "route_worker_unavailable",
        "route_request_malformed",
    ),
)
"""Every code with its sentence in English and Chinese."""


class RouteFailure(WorkerFailure):
    """Say why there is no route. Nothing was moved and nothing is lost: ask again later."""

    reasons = REASONS


@dataclass(frozen=True, slots=True)
class RouteLimits:
    """Hold what the robot's description says about driving; waypoints never ask for more."""

    radius_m: float = 0.30  # the disc that holds the whole robot
    max_speed_mps: float = 0.5
    max_turn_radps: float = 1.0
    max_decel_mps2: float = 1.0
    max_lateral_mps2: float = 0.5

    @classmethod
    def of(cls, robot: RobotDescription, max_speed_mps: float | None = None) -> RouteLimits:
        """Take the limits from a robot's description; the owner's speed limit where it is lower."""
        own_mps = robot.limits.max_speed_mps
        return cls(
            radius_m=robot.base.radius_m,
            max_speed_mps=own_mps if max_speed_mps is None else min(max_speed_mps, own_mps),
            max_turn_radps=robot.limits.max_turn_radps,
            max_decel_mps2=robot.limits.max_decel_mps2,
            max_lateral_mps2=robot.limits.max_lateral_mps2,
        )


@dataclass(frozen=True, slots=True)
class RouteRequest:
    """Ask for a way between two poses in ``map``."""

    start: Pose2
    goal: Pose2
    obstacles: tuple[tuple[float, float], ...] = ()  # recent lidar points in ``map`` [m]
    straight: bool = False  # go straight, as far as floor is free, backwards if the goal is behind
    aside: bool = False  # go where somebody who stands at the goal can walk past
    passes_m: float = 0.0  # the radius of who is to pass, where it is wider than a person
    strict: bool = False  # fail, where the only way leads through what is remembered; where the
    # one who is to pass could stand aside with a shorter way
    keep_right_m: float = 0.0  # so far leave room on the left, for somebody who comes
    explore: bool = False  # go where the map's next frontier is seen from; the goal means nothing
    sees: tuple[float, float] | None = None  # the end is to see this point of the map, and face it
    sees_from_m: float = 0.0  # and to stand no nearer to it
    survey: bool = False  # measure how narrow the way gets, for a person to read


MIN_SPEED_MPS = 0.05
"""The slowest speed that the bridge takes for a speed."""


@dataclass(frozen=True, slots=True)
class RoutePoint:
    """Give one point of a route in ``map`` and the speed to pass it at; its sign is the direction.

    Only a straight way goes backwards, and then all of it does.
    """

    x_m: float
    y_m: float
    speed_mps: float


@dataclass(frozen=True, slots=True)
class FloorReport:
    """Say how much floor the map shows, and whether a frontier was left to go to."""

    known_m2: float
    explored: bool  # nothing is left: the route is where the robot stands


@dataclass(frozen=True, slots=True)
class RouteSurvey:
    """Say how narrow a way gets, and what of it is not known."""

    narrowest_m: float | None  # from thing to thing across the way; None: over 1.5 m everywhere
    narrowest_at: tuple[float, float] | None
    suspect_m: float  # of it leads through what may still stand there
    hoped: bool = False  # it is open only if something that was seen has gone


@dataclass(frozen=True, slots=True)
class RouteResult:
    """Hold a route: from where the robot stood to the goal, or to the nearest free floor."""

    points: tuple[RoutePoint, ...]  # 0.05 to 0.25 m apart; at least one
    length_m: float
    moved_goal_m: float  # from the goal to where the route ends, for want of free floor; 0 as asked
    start_escaped: bool  # the way begins by leaving a place too near to an obstacle
    took_s: float  # in the search itself
    floor: FloorReport | None = None  # to a request to explore
    faces: tuple[float, float] | None = None  # what the end sees, and is to face
    survey: RouteSurvey | None = None  # where it was asked for


@dataclass(frozen=True, slots=True)
class ScanObservation:
    """Show the route search one scan, and the way that the robot is on."""

    base_in_map: Pose2
    lidar_in_base: Pose2
    first_rad: float
    step_rad: float
    range_min_m: float
    ranges_m: tuple[float | None, ...]
    at_s: float  # on the planner's clock; never goes back
    ahead: tuple[
        tuple[float, float], ...
    ] = ()  # points of the way from the robot on, in ``map`` [m]


WIDE_M = 0.33
"""The radius of a disc, as the tracker draws it, that holds more than a person: perhaps a robot."""


def is_wide(radius_m: float) -> bool:
    """Tell whether a disc holds more than a person."""
    return radius_m > WIDE_M


@dataclass(frozen=True, slots=True)
class Mover:
    """Show something that moves: a disc in ``map`` with its velocity."""

    number: int
    x_m: float
    y_m: float
    vx_mps: float
    vy_mps: float
    radius_m: float


@dataclass(frozen=True, slots=True)
class ObstacleReport:
    """Say what the obstacle layer holds after a scan."""

    version: int  # rises with each scan
    blocked_ahead_m: float | None  # along ``ahead`` to where standing things close it; None: open
    movers: tuple[Mover, ...]
    cells: bytes  # columns and rows of cells that hold something, pairs of u16, little endian
    suspicions: bytes  # the same of cells where something may still stand
