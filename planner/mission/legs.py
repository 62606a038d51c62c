"""Ask for the ways of the running step's legs, number the legs, and measure what is done of them.

A leg is one way to one goal. A route may lead round what stands in it; a straight way and a spin go
on or end. Nothing is streamed before the journal holds the beginning: see ``motion_request``.

Law of a turn or a move, also across pauses, crashes and other goals: what is left is left from
where the robot stands when its goal goes on, wherever others drove it meanwhile. So the amount is
settled as soon as an interrupted robot stands, or when another goal takes it: by the map from where
the step began, with odometry counting whole turns. Where a hand steered first, the map says nothing
of the step any more: what odometry counted stands.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, sin

from planner.language.catalogue import say
from planner.mission.account import place_name
from planner.mission.activity import Driving, LegRoutes, RoutePurpose
from planner.mission.effects import AskRoute
from planner.mission.queue import finish, standing_hold
from planner.mission.recovery import passes_m, shut_now, waits_for_other
from planner.mission.spoken_status import tell_occupied
from planner.mission.state import Mission
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.navigation.route import RouteRequest
from planner.plan import Code, Outcome, PauseReason
from planner.skills import Fail, Way, no_room
from planner.skills.measured_motions import along, turned_rad
from wire import LegReport, Mode, Pose2, Status

MAX_ROUTES = 5
"""Routes of one leg that may be lost (off the path, refused by the bridge, short of the room)."""
NAV2_ROUTES = 2
"""Nav2 has tried, with recoveries of its own, before it says no."""
MAX_DETOURS_FAILED = 3
RETRY_S = 1.0
_ROUND = (Way.ROUTE, Way.EXPLORE)
"""Ways that lead round what is known to stand."""
DETOUR_AFTER_S = 3.0
DETOUR_MOST_S = 30.0


def ask_route(
    turn: Transaction, purpose: RoutePurpose = RoutePurpose.LEG, *, keep_right_m: float = 0.0
) -> None:
    """Have a way searched from where the robot is; without a pose, as soon as there is one."""
    mission, leg, start = turn.at_work, turn.leg, turn.book.pose
    if start is None:
        turn.change(retry_s=turn.now_s + RETRY_S)
        return
    own, record = leg.manoeuvre, mission.recovery
    ticket, way, goal = turn.take_ticket(), leg.act.way, record.aim(leg.act.goal)
    if own is not None:
        way, goal = own.way, own.goal
    if purpose is RoutePurpose.EXPLORE:
        way = Way.EXPLORE
    if way is Way.SPIN:
        goal = Pose2(start.x_m, start.y_m, goal.yaw_rad)
    turn.change(ticket=ticket, purpose=purpose, retry_s=None, route_when_standing=False)
    shut = shut_now(record, turn.now_unix_s) if way in _ROUND else ()
    seen = purpose is RoutePurpose.DETOUR or way is Way.STRAIGHT or bool(shut)
    heading = leg.act.heading if own is None else way is Way.SPIN
    speed_mps = own.rung.speed_mps if own is not None and way is Way.STRAIGHT else None
    request = RouteRequest(
        *(start, goal),
        straight=way is Way.STRAIGHT,
        aside=way is Way.ASIDE,
        explore=way is Way.EXPLORE,
        strict=purpose in (RoutePurpose.DOUBT, RoutePurpose.KEEP_RIGHT),
        keep_right_m=keep_right_m,
    )
    if own is None and way is Way.ROUTE:
        request = replace(request, sees=leg.act.sees, sees_from_m=leg.act.sees_from_m)
    if own is not None and way is Way.ASIDE:
        wide_m, waits = passes_m(record), waits_for_other(record)
        request = replace(request, passes_m=wide_m, strict=wide_m > 0.0 and waits)
    turn.emit(AskRoute(mission.id, ticket, request, heading, seen, way, shut, speed_mps))


def take_short(turn: Transaction, leg: Driving, short_m: float) -> None:
    """Judge a straight way that ends early: under way something may leave again, at first not."""
    pose = turn.book.pose
    if leg.leg is not None or leg.purpose is RoutePurpose.DETOUR or pose is None:
        detour_failed(turn, leg)
    else:
        fail_step(turn, no_room(leg.act.goal, pose, short_m))


def new_leg(turn: Transaction, mission: Mission) -> None:
    """Number the leg above every one that bridge or journal know: reached is latched by leg."""
    status = turn.book.status
    known = status.leg if status is not None else None
    floor = known.leg if known is not None and known.mission == mission.grant_name else 0
    leg = max(mission.leg, floor) + 1
    turn.put(mission, leg=leg)
    turn.change(leg=leg, refused_since_s=None, idle_since_s=None, jumped=False)


def told_of_leg(turn: Transaction) -> LegReport | None:
    """Return what the bridge says of the very leg that is driven; None: nothing."""
    told = turn.book.status.leg if turn.book.status is not None else None
    ours = (turn.at_work.grant_name, turn.leg.leg)
    return told if told is not None and (told.mission, told.leg) == ours else None


def detour_failed(turn: Transaction, leg: LegRoutes) -> None:
    """Try a straight way or a spin again later; after three failures in a row it is blocked."""
    if leg.detours_failed + 1 >= MAX_DETOURS_FAILED:
        fail_step(turn, Fail(Code.BLOCKED, "blocked"))
        return
    turn.change(
        detours_failed=leg.detours_failed + 1,
        retry_s=turn.now_s + detour_pause_s(leg.detours_failed + 1) if leg.leg is None else None,
    )


def detour_pause_s(tried: int) -> float:
    """Return how long to wait before the next way round is searched [s]: 3, 6, 12 … 30."""
    return min(DETOUR_MOST_S, DETOUR_AFTER_S * 2.0**tried)


def detour_if_due(turn: Transaction, leg: LegRoutes, blocked_since_s: float) -> None:
    """Have a straight way or a spin tried again; the old horizon streams on until it is there."""
    due_s = detour_pause_s(leg.detours) if leg.detours else DETOUR_AFTER_S
    if turn.now_s - blocked_since_s < due_s:
        return
    if leg.detours >= MAX_DETOURS_FAILED:
        fail_step(turn, Fail(Code.BLOCKED, "blocked"))
        return
    # The wait for the next try begins now, and grows: the world may just need time.
    turn.change(detours=leg.detours + 1, blocked_since_s=turn.now_s)
    ask_route(turn, RoutePurpose.DETOUR)


def abandon_route(turn: Transaction) -> None:
    """Stand, and route again once standing; give up after so many."""
    leg = turn.leg
    if leg.routes >= (NAV2_ROUTES if turn.book.nav2 else MAX_ROUTES):
        fail_step(turn, _give_up_reason(turn))
        return
    turn.change(leg=None, ticket=None, routes=leg.routes + 1, route_when_standing=True)


def _give_up_reason(turn: Transaction) -> Fail:
    """Say why a leg is given up: by Nav2's word where Nav2 drives, else for want of a way."""
    status = turn.book.status
    why = status.leg.refusal if status is not None and status.leg is not None else None
    if not turn.book.nav2 or why is None:
        return Fail(Code.NO_ROUTE, "no_route")
    return Fail(Code.NOT_REACHED, why, say(f"nav2.{why.removeprefix('nav2_')}"))


BY_AMOUNT = frozenset({"turn", "move"})
"""Steps that are measured from where they began."""
STEERED = say("goal.steered")


def measure_from(turn: Transaction, mission: Mission, pose: Pose2 | None) -> Mission:
    """Note where a measured step begins, or began: the way done lies behind the robot."""
    step = mission.current_step
    if step is None or pose is None or step.kind not in BY_AMOUNT or mission.began_at is not None:
        return mission
    gone_m, turned = (0.0, mission.done) if step.kind == "turn" else (mission.done, 0.0)
    began = (
        pose.x_m - gone_m * cos(pose.yaw_rad),
        pose.y_m - gone_m * sin(pose.yaw_rad),
        pose.yaw_rad - turned,
    )
    return turn.put(mission, began_at=began)


def settle_amounts(turn: Transaction, pose: Pose2 | None) -> None:
    """Settle what is done of every interrupted step, while the robot is where it left off."""
    if pose is None:
        return
    for mission in tuple(turn.book.missions.values()):
        step = mission.current_step
        if mission.began_at is None or mission.id == turn.book.running:
            continue
        done = mission.done
        if step is not None and step.kind == "turn":
            done = turned_rad(pose, Pose2(*mission.began_at), done)
        elif step is not None and step.kind == "move":
            done = along(pose, Pose2(*mission.began_at))
        turn.put(mission, done=round(done, 5), began_at=None)


def hand_steers(turn: Transaction, status: Status) -> bool:
    """Tell whether a hand steers now, or has and no person has acted since."""
    return status.mode is Mode.TELEOP or standing_hold(turn) == PauseReason.TELEOP.value


def forget_beginnings(turn: Transaction) -> None:
    """Measure no step across a way that a hand steered.

    What odometry counted until the pause is done. A planner that died counted nothing: how far its
    step came is not known, and better unfinished than done twice.
    """
    for mission in tuple(turn.book.missions.values()):
        if mission.began_at is None or mission.has_ended:
            continue
        if mission.reason == PauseReason.PLANNER_RESTARTED.value:
            said = Outcome(code=Code.NOT_REACHED, message=STEERED)
            finish(turn, mission, GoalFact.PROGRESS_UNKNOWN, said, "steered_meanwhile")
        else:
            turn.put(mission, began_at=None)


OCCUPIED_S = 10.0
"""A goal on which something stands is waited for so long."""
OCCUPIED_RETRY_S = 2.0


def wait_beside(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Wait for what stands on the goal to leave; after ten seconds give the goal up."""
    since_s = leg.occupied_since_s if leg.occupied_since_s is not None else turn.now_s
    if turn.now_s - since_s >= OCCUPIED_S:
        give_up_goal(turn, mission, leg)
        return
    turn.change(occupied_since_s=since_s, rung_since_s=turn.now_s)
    turn.change(retry_s=turn.now_s + OCCUPIED_RETRY_S if leg.leg is None else None)


def look_for_room(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Look again now and then for room beside the goal; give it up after ten seconds."""
    since_s = leg.occupied_since_s
    if since_s is not None and turn.now_s - since_s >= OCCUPIED_S:
        give_up_goal(turn, mission, leg)
    elif leg.rung_since_s is not None and turn.now_s - leg.rung_since_s >= OCCUPIED_RETRY_S:
        turn.change(rung_since_s=turn.now_s)
        ask_route(turn, RoutePurpose.DETOUR)


def give_up_goal(turn: Transaction, mission: Mission, leg: Driving) -> None:
    """Fail the step, with how near the robot came."""
    pose, goal = turn.book.pose, leg.act.goal
    near_m = hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m) if pose is not None else 0.0
    name = place_name(turn.book.facts, mission, mission.current_step)
    said = tell_occupied(name, near_m)
    fail_step(turn, Fail(Code.GOAL_OCCUPIED, "goal_occupied", said))
