"""Take horizons of the owner's own mission and leg, and latch ``reached`` where it ends.

Owns what a streamed path may look like: every reason against it that holds is named in status
beside the leg, then the caller decides once. What is of another epoch, owner or mission is only
dropped; what the owner says wrongly within its rights is scored (row CMD_BAD).
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING

from bridge.core.authority.message_limits import bad, good
from bridge.core.authority.ownership import note_waypoints, sent_at_if_owner
from bridge.core.geometry.path_profile import prepare, residuals
from wire.bounded_types import MAX_POINTS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bridge.core.geometry.fence import FenceGrid
    from bridge.core.tick_context import TickContext
    from wire import Waypoint, Waypoints
    from wire.geometry import Pose2


def hear_waypoints(tick: TickContext, new: Waypoints) -> None:
    """Follow this horizon from now on, or name why not."""
    sent_s = sent_at_if_owner(tick, new.planner_id, new.epoch, new.seen)
    if sent_s is None:
        return
    s = tick.s
    owner = s.ownership.owner
    if owner is None or owner.kind != "planner" or s.grants.mission != new.mission:
        tick.drop("no_grant")
        return
    if s.ownership.waypoints_seq is not None and not new.seq > s.ownership.waypoints_seq:
        if new.seq < s.ownership.waypoints_seq:
            bad(tick, "seq_backwards")
        else:
            tick.drop("repeated")
        return
    note_waypoints(tick, new.seq)
    if s.leg.mission == new.mission and new.leg < s.leg.leg:
        tick.drop("old_leg")
        return
    refusal = _lateness(tick, new, sent_s)
    if refusal is not None:
        tick.drop(refusal)
        _name_leg(tick, new, refusal)
        return
    refusals = _faults(tick, new)
    if refusals:
        if refusals == ("no_pose",) or _crosses_marks_alone(tick, new, refusals):
            tick.drop(refusals[0])
        else:
            bad(tick, refusals[0])
        tick.reasons.extend(refusals[1:])
        _name_leg(tick, new, refusals[0])
        return
    good(tick)
    _name_leg(tick, new, None)
    _take(tick, new, sent_s)


def has_arrived(tick: TickContext, *, at_end: bool) -> bool:
    """Tell whether the leg, or a horizon of no points, is at its end and the robot stands."""
    s = tick.s
    horizon = s.leg.horizon
    if horizon is None or not tick.still_for(0.0):
        return False
    if not horizon.points:
        return True
    if at_end and horizon.final:
        s.leg = replace(s.leg, reached=True)
        tick.say("reached", f"{horizon.mission} leg {horizon.leg}")
        return True
    return False


def residual(tick: TickContext) -> tuple[float, float]:
    """Return how far the robot is from where the leg ends: metres, radians; 0 where unknown."""
    goal = tick.s.leg.goal
    if goal is None or tick.robot_in_map is None:
        return 0.0, 0.0
    return residuals(goal.x_m, goal.y_m, goal.heading_rad, tick.robot_in_map)


def _lateness(tick: TickContext, new: Waypoints, sent_s: float) -> str | None:
    jumped_s = tick.s.pose.jumped_s
    if not tick.now_s - sent_s <= new.ttl_s:
        return "too_old"
    if jumped_s is not None and not sent_s > jumped_s:
        return "before_jump"
    return None


def _faults(tick: TickContext, new: Waypoints) -> tuple[str, ...]:
    if new.map_id != tick.config.map_id:
        return ("wrong_map",)
    if not new.points:
        return ()
    if tick.robot_in_map is None:
        return ("no_pose",)
    limits = tick.config.robot.limits
    return check_horizon(new.points, tick.robot_in_map, limits.max_speed_mps, tick.fence)


def _crosses_marks_alone(tick: TickContext, new: Waypoints, refusals: tuple[str, ...]) -> bool:
    """Tell whether a horizon is wrong by a mark alone: a planner may not know of it yet."""
    here, fence = tick.robot_in_map, tick.config.fence
    if refusals != ("fence_crossed",) or here is None or fence is tick.fence:
        return False
    return not check_horizon(new.points, here, tick.config.robot.limits.max_speed_mps, fence)


def _name_leg(tick: TickContext, new: Waypoints, refusal: str | None) -> None:
    """Make this the newest leg of its mission; ``reached`` belongs to the leg that earned it."""
    leg = tick.s.leg
    if leg.mission == new.mission and leg.leg == new.leg:
        if leg.refusal != refusal:
            tick.s.leg = replace(leg, refusal=refusal)
        return
    tick.s.leg = replace(
        leg,
        mission=new.mission,
        leg=new.leg,
        reached=False,
        goal=None,
        refusal=refusal,
        horizon=None,
        path=None,
    )


def _take(tick: TickContext, new: Waypoints, sent_s: float) -> None:
    s = tick.s
    before = s.leg
    goal: Waypoint | None = new.points[-1] if new.points and new.final else before.goal
    s.leg = replace(
        before,
        goal=goal,
        horizon=new,
        path=prepare(new.points, tick.config.robot.limits),
        sent_s=sent_s,
    )


def forget_horizon(tick: TickContext) -> None:
    """Follow no horizon until another one comes; leg and ``reached`` stay known."""
    tick.s.leg = replace(tick.s.leg, horizon=None, path=None)


def forget_refusal(tick: TickContext) -> None:
    """Drop the refusal of an epoch that is over; its horizon is void, too."""
    tick.s.leg = replace(tick.s.leg, horizon=None, path=None, refusal=None)


MIN_GAP_M, MAX_GAP_M = 0.05, 0.25
MIN_END_GAP_M = 0.01
"""The first point is where the robot happens to be, the last where the leg happens to end."""
FIRST_WITHIN_M = 0.5
MIN_SPEED_MPS = 0.05

GAP_TOLERANCE_M = 1e-3
"""Coordinates may come rounded to millimetres; a spacing rule has no use for more."""
SPEED_TOLERANCE_MPS = 1e-6
"""A limit that went through a division or a decimal text; the limiter holds the exact bound."""


def check_horizon(
    points: Sequence[Waypoint],
    robot_in_map: Pose2,
    max_speed_mps: float,
    fence: FenceGrid | None,
) -> tuple[str, ...]:
    """Return every reason to refuse a horizon; none means that it may be followed.

    Args:
        points: in ``map``; no points at all is a ramp to a stop and always in order.
        robot_in_map: where the robot is now.
        max_speed_mps: robot.toml's bound on speed, without the caps of the moment.
        fence: bounds the robot's centre; None refuses, since nothing is known to be allowed.
    """
    if not points:
        return ()
    xs, ys = [p.x_m for p in points], [p.y_m for p in points]
    gaps = [hypot(bx - ax, by - ay) for ax, bx, ay, by in zip(xs, xs[1:], ys, ys[1:], strict=False)]
    speeds = [p.speed_mps for p in points]
    checks = (
        ("too_many_points", len(points) <= MAX_POINTS),
        ("first_point_far", _starts_here(points[0], robot_in_map)),
        ("bad_spacing", _is_well_spaced(gaps)),
        ("mixed_direction", _one_direction(speeds)),
        ("bad_speed", _speeds_fit(speeds, max_speed_mps)),
        ("heading_not_last", not [p for p in points[:-1] if p.heading_rad is not None]),
        ("fence_crossed", fence is not None and _keeps_inside(xs, ys, gaps, robot_in_map, fence)),
    )
    return tuple([code for code, fits in checks if not fits])


def _starts_here(first: Waypoint, robot_in_map: Pose2) -> bool:
    return hypot(first.x_m - robot_in_map.x_m, first.y_m - robot_in_map.y_m) <= FIRST_WITHIN_M


def _is_well_spaced(gaps: list[float]) -> bool:
    """Tell whether all points lie well apart; the first and the last gap may be small."""
    low, most = MIN_GAP_M - GAP_TOLERANCE_M, MAX_GAP_M + GAP_TOLERANCE_M
    least = MIN_END_GAP_M - GAP_TOLERANCE_M
    ends = (*gaps[:1], *gaps[-1:])
    return _all_within(ends, least, most) and _all_within(gaps[1:-1], low, most)


def _one_direction(speeds: list[float]) -> bool:
    ahead, back = [v for v in speeds if v > 0.0], [v for v in speeds if v < 0.0]
    return len(speeds) in {len(ahead), len(back)}


def _speeds_fit(speeds: list[float], max_speed_mps: float) -> bool:
    low, high = MIN_SPEED_MPS - SPEED_TOLERANCE_MPS, max_speed_mps + SPEED_TOLERANCE_MPS
    return _all_within(map(abs, speeds), low, high)


def _all_within(values: Iterable[float], low: float, high: float) -> bool:
    """Return whether all values lie within their bounds; NaN does not."""
    return not [value for value in values if not low <= value <= high]


def _keeps_inside(
    xs: list[float], ys: list[float], gaps: list[float], robot_in_map: Pose2, fence: FenceGrid
) -> bool:
    """Test every segment, and the way to the first point unless the robot is already outside.

    A robot outside (pushed, or localized anew) must be able to come back in; the fence's gate
    watches that way, and only inwards.
    """
    x, y = robot_in_map.x_m, robot_in_map.y_m
    # Around the segment's start, as far as is known; saves most of the tests.
    clear_m = fence.margin_m(x, y) - hypot(xs[0] - x, ys[0] - y)
    if not clear_m > 0.0:
        if fence.allows(x, y) and fence.crosses(x, y, xs[0], ys[0]):
            return False
        if not fence.allows(xs[0], ys[0]):
            return False
    for i, gap_m in enumerate(gaps):
        if not gap_m < clear_m:
            clear_m = fence.margin_m(xs[i], ys[i])
            if not gap_m < clear_m and fence.crosses(xs[i], ys[i], xs[i + 1], ys[i + 1]):
                return False
        clear_m -= gap_m  # of the next segment's start; below zero it is measured anew
    return True
