"""Ask for the ways of the running step's legs, number the legs, and give up what leads nowhere.

A leg is one way to one goal. A route may lead round what stands in it; a straight way and a spin go
on or end. Nothing is streamed before the journal holds the beginning: see ``wish``.
"""

from __future__ import annotations

from planner.mission.effects import AskRoute
from planner.mission.skills import Cannot, Way, no_room
from planner.mission.state import Mission, Walk
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Turn
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


def ask_route(turn: Turn, *, detour: bool) -> None:
    """Have a way searched from where the robot is; without a pose, as soon as there is one."""
    mission, walk, status = turn.running, turn.book.walk, turn.book.status
    if mission is None or walk is None or walk.goal is None:
        return
    start = status.base_in_map if status is not None else None
    if start is None:
        turn.walk(retry_s=turn.now_s + RETRY_S)
        return
    ticket, way, goal = turn.book.tickets + 1, walk.way, walk.goal
    if way is Way.SPIN:
        goal = Pose2(start.x_m, start.y_m, goal.yaw_rad)
    turn.set(tickets=ticket)
    turn.walk(ticket=ticket, ticket_detour=detour, retry_s=None, route_when_standing=False)
    seen = detour or way is Way.STRAIGHT
    turn.emit(AskRoute(mission.id, ticket, start, goal, walk.heading, seen, way))


def on_routed(
    turn: Turn, mission_id: str, ticket: int, failure: str | None, short_m: float
) -> None:
    """Take the route that was asked for; any other is forgotten."""
    mission, walk = turn.running, turn.book.walk
    if mission is None or walk is None or mission.id != mission_id or walk.ticket != ticket:
        return
    turn.walk(ticket=None)
    if failure is None and walk.way is Way.STRAIGHT and not short_m <= SHORT_M:
        _short(turn, walk, short_m)
    elif failure is None:
        _new_leg(turn, mission)
    elif walk.ticket_detour:
        _detour_failed(turn, walk)
    elif failure in TRANSIENT and walk.routes < MAX_ROUTES:
        turn.walk(routes=walk.routes + 1, retry_s=turn.now_s + RETRY_S)
    else:
        fail_step(turn, Cannot(Code.NO_ROUTE, "no_route"))


def _short(turn: Turn, walk: Walk, short_m: float) -> None:
    """Judge a straight way that ends early: under way something may leave again, at first not."""
    pose = turn.book.status.base_in_map if turn.book.status is not None else None
    if walk.leg is not None or walk.ticket_detour or pose is None or walk.goal is None:
        _detour_failed(turn, walk)
    else:
        fail_step(turn, no_room(walk.goal, pose, short_m))


def _new_leg(turn: Turn, mission: Mission) -> None:
    """Number the leg above every one that bridge or journal know: reached is latched by leg."""
    status = turn.book.status
    known = status.leg if status is not None else None
    floor = known.leg if known is not None and known.mission == mission.id else 0
    leg = max(mission.leg, floor) + 1
    turn.put(mission, leg=leg)
    turn.walk(leg=leg, refused_since_s=None, idle_since_s=None, jumped=False)


def _detour_failed(turn: Turn, walk: Walk) -> None:
    if walk.detours_failed + 1 >= MAX_DETOURS_FAILED:
        fail_step(turn, Cannot(Code.BLOCKED, "blocked"))
        return
    turn.walk(
        detours_failed=walk.detours_failed + 1,
        retry_s=turn.now_s + detour_pause_s(walk.detours_failed + 1) if walk.leg is None else None,
    )


def detour_pause_s(tried: int) -> float:
    """Return how long to wait before the next way round is searched [s]: 3, 6, 12 … 30."""
    return min(DETOUR_MOST_S, DETOUR_AFTER_S * 2.0**tried)


def detour_if_due(turn: Turn, walk: Walk, blocked_since_s: float) -> None:
    """Ask for a way round; the old horizon streams on until there is one."""
    due_s = detour_pause_s(walk.detours) if walk.detours else DETOUR_AFTER_S
    if turn.now_s - blocked_since_s < due_s:
        return
    if walk.way is not Way.ROUTE and walk.detours >= MAX_DETOURS_FAILED:
        fail_step(turn, Cannot(Code.BLOCKED, "blocked"))
        return
    # The wait for the next try begins now, and grows: the world may just need time.
    turn.walk(detours=walk.detours + 1, blocked_since_s=turn.now_s)
    ask_route(turn, detour=True)


def lost_route(turn: Turn) -> None:
    """Stand, and route again once standing; give up after so many."""
    walk = turn.book.walk
    if walk is None:
        return
    if walk.routes >= MAX_ROUTES:
        fail_step(turn, Cannot(Code.NO_ROUTE, "no_route"))
        return
    turn.walk(leg=None, ticket=None, routes=walk.routes + 1, route_when_standing=True)
