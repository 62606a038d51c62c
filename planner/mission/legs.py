"""Ask for the ways of the running step's legs, number the legs, and give up what leads nowhere.

A leg is one way to one goal. A route may lead round what stands in it; a straight way and a spin go
on or end. Nothing is streamed before the journal holds the beginning: see ``motion_request``.
"""

from __future__ import annotations

from planner.mission.activity import Driving
from planner.mission.effects import AskRoute
from planner.mission.skills import Fail, Way, no_room
from planner.mission.state import Mission
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.plan import Code
from wire import Pose2

MAX_ROUTES = 5
"""Routes of one leg that may be lost (off the path, refused by the bridge, short of the room)."""
MAX_DETOURS_FAILED = 3
RETRY_S = 1.0
DETOUR_AFTER_S = 3.0
DETOUR_MOST_S = 30.0
SHORT_M = 0.05
"""A straight way that ends so near to its goal is whole."""
TRANSIENT = frozenset({"route_timed_out", "route_worker_died", "route_worker_unavailable"})


def ask_route(turn: Transaction, *, detour: bool) -> None:
    """Have a way searched from where the robot is; without a pose, as soon as there is one."""
    mission, leg, status = turn.running, turn.driving, turn.book.status
    if mission is None or leg is None:
        return
    start = status.base_in_map if status is not None else None
    if start is None:
        turn.change(retry_s=turn.now_s + RETRY_S)
        return
    ticket, way, goal = turn.book.tickets + 1, leg.way, leg.goal
    if way is Way.SPIN:
        goal = Pose2(start.x_m, start.y_m, goal.yaw_rad)
    turn.set(tickets=ticket)
    turn.change(ticket=ticket, ticket_detour=detour, retry_s=None, route_when_standing=False)
    seen = detour or way is Way.STRAIGHT
    turn.emit(AskRoute(mission.id, ticket, start, goal, leg.heading, seen, way))


def on_routed(
    turn: Transaction, mission_id: str, ticket: int, failure: str | None, short_m: float
) -> None:
    """Take the route that was asked for; any other is forgotten."""
    mission, leg = turn.running, turn.driving
    if mission is None or leg is None or mission.id != mission_id or leg.ticket != ticket:
        return
    turn.change(ticket=None)
    if failure is None and leg.way is Way.STRAIGHT and not short_m <= SHORT_M:
        _short(turn, leg, short_m)
    elif failure is None:
        _new_leg(turn, mission)
    elif leg.ticket_detour:
        _detour_failed(turn, leg)
    elif failure in TRANSIENT and leg.routes < MAX_ROUTES:
        turn.change(routes=leg.routes + 1, retry_s=turn.now_s + RETRY_S)
    else:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))


def _short(turn: Transaction, leg: Driving, short_m: float) -> None:
    """Judge a straight way that ends early: under way something may leave again, at first not."""
    pose = turn.book.status.base_in_map if turn.book.status is not None else None
    if leg.leg is not None or leg.ticket_detour or pose is None:
        _detour_failed(turn, leg)
    else:
        fail_step(turn, no_room(leg.goal, pose, short_m))


def _new_leg(turn: Transaction, mission: Mission) -> None:
    """Number the leg above every one that bridge or journal know: reached is latched by leg."""
    status = turn.book.status
    known = status.leg if status is not None else None
    floor = known.leg if known is not None and known.mission == mission.id else 0
    leg = max(mission.leg, floor) + 1
    turn.put(mission, leg=leg)
    turn.change(leg=leg, refused_since_s=None, idle_since_s=None, jumped=False)


def _detour_failed(turn: Transaction, leg: Driving) -> None:
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


def detour_if_due(turn: Transaction, leg: Driving, blocked_since_s: float) -> None:
    """Ask for a way round; the old horizon streams on until there is one."""
    due_s = detour_pause_s(leg.detours) if leg.detours else DETOUR_AFTER_S
    if turn.now_s - blocked_since_s < due_s:
        return
    if leg.way is not Way.ROUTE and leg.detours >= MAX_DETOURS_FAILED:
        fail_step(turn, Fail(Code.BLOCKED, "blocked"))
        return
    # The wait for the next try begins now, and grows: the world may just need time.
    turn.change(detours=leg.detours + 1, blocked_since_s=turn.now_s)
    ask_route(turn, detour=True)


def abandon_route(turn: Transaction) -> None:
    """Stand, and route again once standing; give up after so many."""
    leg = turn.driving
    if leg is None:
        return
    if leg.routes >= MAX_ROUTES:
        fail_step(turn, Fail(Code.NO_ROUTE, "no_route"))
        return
    turn.change(leg=None, ticket=None, routes=leg.routes + 1, route_when_standing=True)
