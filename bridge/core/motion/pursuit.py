"""Follow a prepared path: regulated pure pursuit, turning in place where a curve would not do.

Owns what velocity a path asks for. Progress along a path only rises, so a point that was missed is
never orbited: what is left at the end is made good by turning towards it and driving straight,
three times at most. Limits, gates and rates come after; knows no map, no modes and no time.
"""

from __future__ import annotations

from bisect import bisect_right
from math import atan2, cos, hypot, inf, pi, sin, sqrt
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import saturate
from bridge.core.geometry.path_profile import (
    PLANNED_DECEL,
    SLOWEST_MPS,
    TURN_RADIUS_M,
    Path,
    regulate,
    residuals,
)
from bridge.core.geometry.stopping import speed_within
from bridge.core.state_motion import FollowState
from wire.geometry import MAX_COORDINATE_M, STILL, Pose2, Twist2, wrap
from wire.value import value

if TYPE_CHECKING:
    from wire.robot import Base, Limits

REACHED_M, REACHED_RAD = 0.10, 0.10
"""A leg's end counts as reached within these; the follower goes on until it is better."""
LOOK_S, LOOK_MIN_M, LOOK_MAX_M = 0.8, 0.25, 0.6
TURN_ABOVE_RAD, TURN_BELOW_RAD = 1.05, 0.15
"""Turn in place if the path leads more than 60 degrees aside, until it lies nearly ahead."""
SETTLED_M, SETTLED_RAD = 0.03, 0.02
UNSETTLED_RAD = 0.06
_MISSED_M = 0.07  # beside the end by less, one leaves it at that
_WINDOW_M = 0.5  # progress is looked for this far ahead, so that a path may come back near itself
_NEAR_END_M = 0.05
_TRIES = 3
_GIVEN_UP_M = 0.3  # an end further off than this is another end: the horizon has moved on
_STOP_FIRST_MPS = 0.1


@value
class PursuitCommand:
    """Answer one tick of following."""

    state: FollowState
    target: Twist2
    residual_m: float
    """To the end: straight or along the path, whichever is more. 0 for a path without points."""
    residual_rad: float
    """Off the heading asked for at the end; 0 where none is."""
    at_end: bool
    """Within what counts as reached. Whether the robot stands is for the caller to see."""


def carry_over(state: FollowState) -> FollowState:
    """Return the state for the next horizon of the same leg: progress anew, the rest goes on."""
    return FollowState(0.0, state.turning, state.settled, state.heading_done, state.tries)


def is_reached(residual_m: float, residual_rad: float) -> bool:
    """Return whether residuals count as reached; NaN does not."""
    return residual_m <= REACHED_M and residual_rad <= REACHED_RAD


def look_ahead_m(
    speed_mps: float, seconds: float = LOOK_S, low: float = LOOK_MIN_M, high: float = LOOK_MAX_M
) -> float:
    """Return how far ahead on the path to aim at a speed [m]."""
    ahead = abs(speed_mps) * seconds
    return ahead if low <= ahead <= high else (high if ahead > high else low)


def follow(
    state: FollowState,
    path: Path,
    robot_in_map: Pose2,
    sent: Twist2,
    base: Base,
    limits: Limits,
    lag_s: float,
) -> PursuitCommand:
    """Return the velocity that the path asks for, within robot.toml's limits.

    Args:
        state: :data:`NEW` for a path that has just come.
        path: the accepted horizon; without points it asks for standstill.
        robot_in_map: where the robot is.
        sent: what was sent last; the look ahead grows with it.
        base: wheel geometry.
        limits: robot.toml's bounds.
        lag_s: of the drive.
    """
    here = abs(robot_in_map.x_m) + abs(robot_in_map.y_m) + abs(robot_in_map.yaw_rad)
    if not (path.xs_m and here <= 3 * MAX_COORDINATE_M):
        return PursuitCommand(state, STILL, 0.0, 0.0, False)
    along = max(state.along_m, _progress(path, state.along_m, robot_in_map))
    away, residual_rad = residuals(path.xs_m[-1], path.ys_m[-1], path.heading_rad, robot_in_map)
    residual_m = max(away, path.length_m - along)
    view = _view(path, along, away, robot_in_map, sent)
    moved = _judge(state, view, along, residual_rad)
    reaction = lag_s + limits.max_decel_mps2 / (2 * limits.stop_jerk_mps3) + 0.02
    if moved.settled:
        error = 0.0
        if path.heading_rad is not None and not moved.heading_done:
            error = wrap(path.heading_rad - robot_in_map.yaw_rad)
        target = _turn(error, sent, base, limits, reaction)
    elif moved.turning:
        target = _turn(view.aside_rad, sent, base, limits, reaction)
    else:
        target = _drive(path, view, along, limits, reaction)
    return PursuitCommand(
        moved,
        saturate(target, base, limits),
        residual_m,
        residual_rad,
        is_reached(residual_m, residual_rad),
    )


@value
class _View:
    """Hold where the path leads, seen in the direction of travel."""

    aim_m: float
    aside_rad: float
    """Direction of the aim; left is positive."""
    ending: bool
    """The aim is the end, with nothing of the path left but the way to it."""
    away_m: float
    """Straight distance to the end."""
    rest_m: float
    """What is left to go."""


def _view(path: Path, along: float, away: float, robot: Pose2, sent: Twist2) -> _View:
    heading = robot.yaw_rad + pi if path.backwards else robot.yaw_rad
    rest = path.length_m - along
    ending = rest <= _NEAR_END_M
    x, y = _point(path, along + (inf if ending else look_ahead_m(sent.v_mps)))
    dx, dy = x - robot.x_m, y - robot.y_m
    aside = wrap(atan2(dy, dx) - heading)
    if ending:
        rest = max(0.0, away * cos(aside))
    return _View(hypot(dx, dy), aside, ending, away, rest)


def _judge(state: FollowState, view: _View, along: float, residual_rad: float) -> FollowState:
    """Decide between driving, turning in place and having settled, with hysteresis."""
    settled, turning, tries = state.settled, state.turning, state.tries
    if settled:
        settled = view.away_m <= (_GIVEN_UP_M if tries >= _TRIES else REACHED_M)
        tries = tries if view.away_m <= _GIVEN_UP_M else 0
    elif view.ending and view.away_m <= SETTLED_M:
        settled = True
    if settled:
        limit = UNSETTLED_RAD if state.heading_done else SETTLED_RAD
        return FollowState(along, False, True, residual_rad <= limit, tries)
    above = TURN_BELOW_RAD if turning else TURN_ABOVE_RAD
    turns = abs(view.aside_rad) > above
    if turns and not turning and view.ending:
        if view.away_m <= _MISSED_M or tries >= _TRIES:
            return FollowState(along, False, True, residual_rad <= SETTLED_RAD, tries)
        tries += 1
    return FollowState(along, turns, False, False, tries)


def _drive(path: Path, view: _View, along: float, limits: Limits, reaction: float) -> Twist2:
    """Aim at the look-ahead point: the circle to it has the curve 2 sin(aside) / distance."""
    curve = 2 * sin(view.aside_rad) / max(view.aim_m, LOOK_MIN_M)
    speed = _speed(path, along, limits)
    slowest = min(speed, SLOWEST_MPS)
    speed = regulate(speed, curve, TURN_RADIUS_M, slowest) * max(0.25, cos(view.aside_rad))
    speed = min(speed, speed_within(view.rest_m, PLANNED_DECEL * limits.max_decel_mps2, reaction))
    return Twist2(-speed if path.backwards else speed, speed * curve)


def _speed(path: Path, along: float, limits: Limits) -> float:
    """Return the speed the path allows here, braking in time for the next point included."""
    i = min(bisect_right(path.along_m, along), len(path.along_m) - 1)
    gap = max(0.0, path.along_m[i] - along)
    cap = max(path.speeds_mps[i], path.speeds_mps[i - 1] if i else 0.0)
    if i == len(path.along_m) - 1:
        return cap  # what brakes at the end is the rest of the way
    decel = PLANNED_DECEL * limits.max_decel_mps2
    return min(cap, sqrt(path.exits_mps[i] * path.exits_mps[i] + 2 * decel * gap))


def _turn(error: float, sent: Twist2, base: Base, limits: Limits, reaction: float) -> Twist2:
    """Turn in place by an error, braking in time; a robot that still drives stops first."""
    if not abs(sent.v_mps) <= _STOP_FIRST_MPS or error == 0.0:
        return STILL
    side = 1.0 if error > 0.0 else -1.0
    if abs(error) > pi - 0.3 and sent.w_radps != 0.0:
        side = 1.0 if sent.w_radps > 0.0 else -1.0  # either way is as far: keep to one
    decel = PLANNED_DECEL * limits.max_decel_mps2 / (base.wheel_separation_m / 2)
    return Twist2(0.0, side * min(limits.max_turn_radps, speed_within(abs(error), decel, reaction)))


def _point(path: Path, along: float) -> tuple[float, float]:
    """Return the point at a length along the path; beyond the end, the end."""
    lengths = path.along_m
    if not along < lengths[-1]:
        return path.xs_m[-1], path.ys_m[-1]
    i = max(1, bisect_right(lengths, along))
    share = (along - lengths[i - 1]) / (lengths[i] - lengths[i - 1])
    xa, ya = path.xs_m[i - 1], path.ys_m[i - 1]
    return xa + share * (path.xs_m[i] - xa), ya + share * (path.ys_m[i] - ya)


def _progress(path: Path, along: float, robot: Pose2) -> float:
    """Return the length of the point nearest to the robot, from where it was to a window ahead."""
    lengths, xs, ys = path.along_m, path.xs_m, path.ys_m
    x, y, until = robot.x_m, robot.y_m, along + _WINDOW_M
    first = max(0, bisect_right(lengths, along) - 1)
    best, best_square = along, inf
    for i in range(first, len(lengths) - 1):
        start = lengths[i]
        if start > until:
            break
        gap = lengths[i + 1] - start
        if gap > 0.0:
            xa, ya = xs[i], ys[i]
            dx, dy = (xs[i + 1] - xa) / gap, (ys[i + 1] - ya) / gap
            px, py = x - xa, y - ya
            on = px * dx + py * dy
            if not on > 0.0:
                on = 0.0
            elif on > gap:
                on = gap
            px, py = px - on * dx, py - on * dy
            square = px * px + py * py
            if square < best_square:
                best, best_square = start + on, square
    return best
