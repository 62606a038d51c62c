"""Take the routes that a leg asked for, or the code of none, and the leg's end.

Which rung asks for which stands in ``recovery_steps``. A route that nobody waits for any more is
forgotten. A leg is done when the bridge says that this very leg was reached, the robot stands, and
its pose lies inside the room's outline: its step goes on then.

One who explores is told a spot to look from, or that no frontier is left. From then on the leg is
one by route, so that it recovers where its way is shut, as any other does. On the way it is asked
now and then whether to look from elsewhere, as the map grows: what the robot was to look at often
comes into view long before it is there. Nothing stops for that question.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot

from planner.bridge_client.bridge_status import standing
from planner.mission import legs, recovery_steps
from planner.mission.activity import Driving, LegHolds, Manoeuvre, RoutePurpose
from planner.mission.events import Routed
from planner.mission.outcomes import spot_at
from planner.mission.queue import note_step, settle_activity
from planner.mission.recovery import PASSING_S, Recovery, aside_s, passes_m, rung_of
from planner.mission.route_doubts import take_doubted
from planner.mission.scene import scene_of
from planner.mission.state import Mission, Progress
from planner.mission.step_execution import carry_out, go_on
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.plan import Code
from planner.site.polygon import contains
from planner.skills import Fail, Way, act_of
from planner.skills.skill_state import ExploreState
from wire import Pose2

SHORT_M = 0.05
"""A straight way that ends so near to its goal is whole."""
MOVED_M = 0.2
"""A route that ends farther from its goal than this ends elsewhere."""
EXACT_M = 0.05
"""A route that ends farther from a person's point than this does not lead to it."""
OCCUPIED = "goal_occupied"
"""The route search's code where something not on the map leaves no floor beside the goal."""
MAX_APPROACHES = 2
TRANSIENT = frozenset({"route_timed_out", "route_worker_died", "route_worker_unavailable"})
TURNED_S, SLOWLY_MPS = 12.0, 0.2
"""Beside what stands 0.06 m away the gate lets the robot turn at 0.3 rad/s; then it drives off."""
HOLDS_S = 2.0
"""Before one that makes way a robot stands so long, and longer while no way leads past it."""


def on_routed(turn: Transaction, routed: Routed) -> None:
    """Take the route that was asked for; any other is forgotten."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None or (mission.id, leg.ticket) != (routed.id, routed.ticket):
        return
    failure, short_m = routed.failure, routed.short_m
    turn.change(ticket=None)
    leg = turn.driving or leg
    if leg.purpose in _TAKEN_BESIDE:
        _TAKEN_BESIDE[leg.purpose](turn, mission, leg, routed)
    elif leg.manoeuvre is not None:
        _take_manoeuvre(turn, mission, leg, leg.manoeuvre, routed)
    elif failure is None and leg.act.way is Way.STRAIGHT and not short_m <= SHORT_M:
        legs.take_short(turn, leg, short_m)
    elif failure is None and leg.act.exact and not short_m <= EXACT_M:
        legs.wait_beside(turn, mission, leg)
    elif failure is None:
        _take_route(turn, mission, leg, routed)
    elif leg.act.way is not Way.ROUTE and leg.purpose is RoutePurpose.DETOUR:
        legs.detour_failed(turn, leg)
    elif failure == OCCUPIED and leg.act.way is Way.ROUTE:
        legs.wait_beside(turn, mission, leg)
    elif leg.purpose is RoutePurpose.DETOUR:
        _no_way_round(turn, mission, leg, failure)
    elif failure in TRANSIENT and leg.routes < legs.MAX_ROUTES:
        turn.change(routes=leg.routes + 1, retry_s=turn.now_s + legs.RETRY_S)
    elif mission.recovery.shut and failure == "no_route":
        fail_step(turn, recovery_steps.way_shut(turn, mission))
    else:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))


def _take_manoeuvre(
    turn: Transaction, mission: Mission, leg: Driving, own: Manoeuvre, routed: Routed
) -> None:
    if own.is_early:
        _take_early(turn, mission, own, routed)
    elif routed.failure is not None:
        recovery_steps.end_manoeuvre(turn, leg, own)
    elif own.way is Way.ASIDE and not routed.length_m > 0.0:
        # It can be passed where it is; a leg that is streamed goes on by itself.
        until_s = turn.now_s + aside_s(mission.recovery)
        turn.change(manoeuvre=replace(own, part=1, until_s=until_s, stays=leg.leg is not None))
    else:
        _begin_manoeuvre(turn, mission, own, routed)


def _begin_manoeuvre(turn: Transaction, mission: Mission, own: Manoeuvre, routed: Routed) -> None:
    if own.way is Way.ASIDE and passes_m(mission.recovery) > 0.0:
        until_s = turn.now_s + TURNED_S + routed.length_m / SLOWLY_MPS
        turn.change(manoeuvre=replace(own, until_s=max(own.until_s, until_s)))
    legs.new_leg(turn, mission)


def _take_early(turn: Transaction, mission: Mission, own: Manoeuvre, routed: Routed) -> None:
    """Make way before one who comes is there; else stand: it makes way, or passes here.

    Two that both drive towards each other stop too late.
    """
    if routed.failure is None and routed.length_m > 0.0:
        noted = recovery_steps.note_recovery(turn, mission, own.rung.recovery)
        _begin_manoeuvre(turn, noted, own, routed)
        return
    recovery_steps.note_recovery(turn, mission, Recovery.WAIT)
    seconds = HOLDS_S if routed.failure is not None else PASSING_S
    own = replace(own, part=1, until_s=turn.now_s + seconds, is_early=False)
    turn.change(manoeuvre=own, leg=None)


def _take_route(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Stream a route; one round something that ends short of its goal moves the goal, once."""
    if leg.act.way is Way.EXPLORE:
        take_viewpoint(turn, mission, leg, routed)
        return
    short_m, end_m = routed.short_m, routed.end_m
    detour = leg.purpose is RoutePurpose.DETOUR
    moved = detour and leg.act.way is Way.ROUTE and short_m > MOVED_M and end_m is not None
    if not moved:
        legs.new_leg(turn, mission)
        if detour:
            recovery_steps.next_rung(turn)
        return
    record = mission.recovery
    if record.approaches + 1 >= MAX_APPROACHES or end_m is None:
        legs.give_up_goal(turn, mission, leg)
        return
    update = {
        "approaches": record.approaches + 1,
        "goal": (leg.act.goal.x_m, leg.act.goal.y_m),
        "goal_moved": end_m,
    }
    mission = turn.put(mission, recovery=record.model_copy(update=update))
    legs.new_leg(turn, mission)
    turn.change(rung_since_s=None, occupied_since_s=None)


def _no_way_round(turn: Transaction, mission: Mission, leg: Driving, failure: str) -> None:
    """Go on up the ladder; a search that only broke is tried again."""
    if failure in TRANSIENT and leg.routes < legs.MAX_ROUTES:
        turn.change(routes=leg.routes + 1, rung_since_s=turn.now_s)
        turn.change(retry_s=turn.now_s + legs.RETRY_S if leg.leg is None else None)
    elif leg.leg is None and _waits_on(turn, mission, leg):
        turn.change(retry_s=turn.now_s + legs.RETRY_S)
    else:
        recovery_steps.skip_rung(turn, leg)


def _waits_on(turn: Transaction, mission: Progress, leg: LegHolds) -> bool:
    """Tell whether the wait that is in hand goes on: what stands there may leave any moment."""
    rung, since_s = rung_of(mission.recovery), leg.rung_since_s
    waits = rung.recovery is Recovery.WAIT
    return waits and since_s is not None and turn.now_s - since_s < rung.seconds


def on_arrival(turn: Transaction) -> bool:
    """Go on in the step if the bridge says that its leg is done; say whether that happened."""
    driving, leg, status = turn.leg, legs.told_of_leg(turn), turn.book.status
    pose = turn.book.pose
    if leg is None or status is None or pose is None or not (leg.reached and standing(status)):
        return False
    if _is_outside(turn, driving, pose):
        legs.abandon_route(turn)
        return True
    mission = settle_activity(turn)
    state = driving.act.then or mission.skill_state
    mission = turn.put(mission, part=mission.part + 1, skill_state=state)
    figures = {"reached": spot_at(turn.book.facts, pose, driving.act.target)}
    residuals = {
        "residual_m": round(leg.residual_m, 4),
        "residual_rad": round(leg.residual_rad, 4) if driving.act.heading else None,
    }
    mission = note_step(turn, mission, **figures, **residuals)
    step = mission.steps[mission.step]
    if step.kind == "patrol" and not step.look:
        mission = note_step(turn, mission, visited=mission.part)
    carry_out(turn, mission, act_of(scene_of(turn, mission)))
    return True


def _is_outside(turn: Transaction, driving: Driving, pose: Pose2) -> bool:
    """Tell whether the leg ended short of the room that it was to."""
    target = turn.book.facts.targets.get(driving.act.target or "")
    if target is None or not target.room or target.polygon is None:
        return False
    return not contains(target.polygon, pose.x_m, pose.y_m)


AGAIN_S = 3.0
"""The map is drawn anew every 2 s."""
ELSEWHERE_M = 0.3


def reconsider_viewpoint(turn: Transaction) -> None:
    """Ask whether to look from elsewhere, for a leg that explores and is driven undisturbed."""
    leg, now_s = turn.driving, turn.now_s
    if leg is None or leg.leg is None or not isinstance(leg.act.state, ExploreState):
        return
    if leg.ticket is None and now_s - max(leg.since_s, leg.explore_asked_s) >= AGAIN_S:
        turn.change(explore_asked_s=now_s)
        legs.ask_route(turn, RoutePurpose.EXPLORE)


def take_better_viewpoint(
    turn: Transaction, mission: Mission, leg: Driving, routed: Routed
) -> None:
    """Turn to another spot, or end where nothing is left to look at; else the leg goes on."""
    floor, end_m = routed.floor, routed.end_m
    if floor is None or end_m is None or leg.leg is None:
        return
    off_m = hypot(end_m[0] - leg.act.goal.x_m, end_m[1] - leg.act.goal.y_m)
    if floor.explored or off_m > ELSEWHERE_M:
        take_viewpoint(turn, mission, leg, routed)


def take_viewpoint(turn: Transaction, mission: Mission, leg: Driving, routed: Routed) -> None:
    """Drive to where the route ends, or tell the skill that all was explored."""
    act, floor, end_m = leg.act, routed.floor, routed.end_m
    state = act.state
    if not isinstance(state, ExploreState) or floor is None or end_m is None:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))
        return
    known_m2 = round(floor.known_m2, 1)
    if floor.explored:
        go_on(turn, state.but(known_m2=known_m2, explored=True))
        return
    act = replace(
        act,
        way=Way.ROUTE,
        goal=Pose2(*end_m, act.goal.yaw_rad),
        state=state.but(known_m2=known_m2),
        then=act.then.but(known_m2=known_m2) if act.then is not None else None,
        otherwise=act.otherwise.but(known_m2=known_m2) if act.otherwise is not None else None,
    )
    turn.change(act=act)
    legs.new_leg(turn, mission)


_TAKEN_BESIDE = {
    RoutePurpose.DOUBT: take_doubted,
    RoutePurpose.KEEP_RIGHT: take_doubted,
    RoutePurpose.EXPLORE: take_better_viewpoint,
}
"""Who takes the answer to a search without which the leg goes on."""
