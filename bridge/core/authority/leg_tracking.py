"""Take horizons of the owner's own mission and leg, and latch ``reached`` where it ends.

Every refusal is named in status beside the leg. What is of another epoch, owner or mission is only
dropped; what the owner says wrongly within its rights is scored (row CMD_BAD).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.horizon_checks import check_horizon
from bridge.core.authority.message_score import bad, good
from bridge.core.authority.ownership import note_waypoints, sent_at_if_owner
from bridge.core.geometry.path_profile import prepare, residuals

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext
    from wire import Waypoint, Waypoints


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
        if refusals != ("no_pose",):
            bad(tick, refusals[0])
        else:
            tick.drop("no_pose")
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
    return check_horizon(new.points, tick.robot_in_map, limits.max_speed_mps, tick.config.fence)


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
