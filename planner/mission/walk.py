"""Walk the running mission's plan: begin steps, ask for routes, believe only the bridge's word.

A motion step is done when the bridge says that this very leg was reached, the robot stands, and its
pose lies inside the room's outline. Nothing moves or speaks before the journal holds its beginning.
"""

from __future__ import annotations

from planner.mission.effects import AskRoute, SayAloud
from planner.mission.queue import (
    end_running,
    finish,
    next_up,
    note_step,
    pause_running,
    settle_walk,
)
from planner.mission.records import Mission, Target, Walk
from planner.mission.sight import cannot_move, standing
from planner.mission.turn import Turn
from planner.mission.verdict import MOTION, accepted_at, ended, spot_at, success
from planner.plan import Code, GoalState, StepRecord, StepState
from planner.world.polygon import contains
from wire import Pose2

MAX_ROUTES = 5
"""Routes of one step that may be lost (off the path, refused by the bridge, short of the room)."""
MAX_DETOURS_FAILED = 3
RETRY_S = 1.0
DETOUR_AFTER_S = 3.0
DETOUR_MOST_S = 30.0
TRANSIENT = frozenset({"route_timed_out", "route_worker_died", "route_worker_unavailable"})


def start_next(turn: Turn) -> None:
    """Give the robot to the next in the queue, as long as it is free."""
    while (mission := next_up(turn)) is not None:
        turn.set(queue=tuple(i for i in turn.book.queue if i != mission.id), running=mission.id)
        turn.put(mission, state=GoalState.RUNNING, reason=None, outcome=None)
        begin_step(turn)


def begin_step(turn: Turn) -> None:
    """Begin the current step of the running mission, or end a mission that has no more."""
    mission = turn.running
    if mission is None:
        return
    if mission.step >= len(mission.steps):
        _succeed(turn, mission)
        return
    step = mission.steps[mission.step]
    if step.kind in MOTION:
        _begin_drive(turn, mission, step)
    elif step.kind == "wait":
        _note_running(turn, mission)
        until_s = turn.now_s + (step.seconds or 0.0)
        turn.set(walk=Walk("wait", turn.next_entry, until_s=until_s))
    elif step.kind == "say":
        _begin_say(turn, mission, step)
    else:  # refused when it was planned; here for a journal that an older program wrote
        end_running(turn, GoalState.FAILED, Code.NO_CAPABILITY, step.kind)


def _note_running(turn: Turn, mission: Mission) -> None:
    note_step(turn, mission, state=StepState.RUNNING, reason=None)


def _begin_say(turn: Turn, mission: Mission, step: StepRecord) -> None:
    if step.state is StepState.RUNNING:  # begun before a crash or pause: perhaps said already
        finish_step(turn, StepState.SKIPPED, reason="perhaps_said")
        return
    _note_running(turn, mission)
    turn.set(walk=Walk("say", turn.next_entry))


def _begin_drive(turn: Turn, mission: Mission, step: StepRecord) -> None:
    cause = cannot_move(turn.book.status)
    if cause is not None:
        turn.set(walk=None)
        pause_running(turn, cause)
        return
    goal, heading = _goal_of(turn, mission, step)
    if goal is None:
        end_running(turn, GoalState.FAILED, Code.NO_ROUTE, "no_route")
        return
    _note_running(turn, mission)
    turn.set(walk=Walk("drive", turn.next_entry, goal=goal, heading=heading))
    ask_route(turn, obstacles=False)


def target_of(turn: Turn, step: StepRecord) -> Target | None:
    """Return the room or place that a step names."""
    facts = turn.book.facts
    return facts.targets.get(facts.home if step.kind == "return_home" else step.place or "")


def _goal_of(turn: Turn, mission: Mission, step: StepRecord) -> tuple[Pose2 | None, bool]:
    if step.kind == "come_back":
        return accepted_at(mission), True
    target = target_of(turn, step)
    return (None, False) if target is None else (target.pose, not target.room)


def ask_route(turn: Turn, *, obstacles: bool) -> None:
    """Have a way searched from where the robot is; without a pose, as soon as there is one."""
    mission, walk, status = turn.running, turn.book.walk, turn.book.status
    if mission is None or walk is None or walk.goal is None:
        return
    start = status.base_in_map if status is not None else None
    if start is None:
        turn.walk(retry_s=turn.now_s + RETRY_S)
        return
    ticket = turn.book.tickets + 1
    turn.set(tickets=ticket)
    turn.walk(ticket=ticket, ticket_obstacles=obstacles, retry_s=None, route_when_standing=False)
    turn.emit(AskRoute(mission.id, ticket, start, walk.goal, walk.heading, obstacles))


def on_routed(turn: Turn, mission_id: str, ticket: int, failure: str | None) -> None:
    """Take the route that was asked for; any other is forgotten."""
    mission, walk = turn.running, turn.book.walk
    if mission is None or walk is None or mission.id != mission_id or walk.ticket != ticket:
        return
    turn.walk(ticket=None)
    if failure is None:
        _new_leg(turn, mission)
    elif walk.ticket_obstacles:
        _detour_failed(turn, walk)
    elif failure in TRANSIENT and walk.routes < MAX_ROUTES:
        turn.walk(routes=walk.routes + 1, retry_s=turn.now_s + RETRY_S)
    else:
        end_running(turn, GoalState.FAILED, Code.NO_ROUTE, "no_route")


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
        end_running(turn, GoalState.FAILED, Code.BLOCKED, "blocked")
        return
    turn.walk(
        detours_failed=walk.detours_failed + 1,
        retry_s=turn.now_s + detour_pause_s(walk.detours_failed + 1) if walk.leg is None else None,
    )


def detour_pause_s(tried: int) -> float:
    """Return how long to wait before the next way round is searched [s]: 3, 6, 12 … 30."""
    return min(DETOUR_MOST_S, DETOUR_AFTER_S * 2.0**tried)


def on_arrival(turn: Turn) -> bool:
    """End the step if the bridge says that its leg is done; say whether that happened."""
    mission, walk, status = turn.running, turn.book.walk, turn.book.status
    if mission is None or walk is None or status is None or walk.leg is None:
        return False
    leg = status.leg
    ours = leg is not None and leg.mission == mission.id and leg.leg == walk.leg
    if not (ours and leg is not None and leg.reached and standing(status)):
        return False
    pose = status.base_in_map
    if pose is None:
        return False
    target = target_of(turn, mission.steps[mission.step])
    outside = (
        target is not None
        and target.polygon is not None
        and target.room
        and not contains(target.polygon, pose.x_m, pose.y_m)
    )
    if outside:
        lost_route(turn)
        return True
    place = target.id if target is not None else None
    spot = spot_at(turn.book.facts, pose, place)
    finish_step(turn, StepState.SUCCEEDED, reached=spot, residual_m=round(leg.residual_m, 4))
    return True


def lost_route(turn: Turn) -> None:
    """Stand, and route again once standing; give up after so many."""
    walk = turn.book.walk
    if walk is None:
        return
    if walk.routes >= MAX_ROUTES:
        end_running(turn, GoalState.FAILED, Code.NO_ROUTE, "no_route")
        return
    turn.walk(leg=None, ticket=None, routes=walk.routes + 1, route_when_standing=True)


def finish_step(turn: Turn, state: StepState, **record: object) -> None:
    """Write the end of a step and begin the next."""
    mission = settle_walk(turn)
    if mission is None:
        return
    mission = note_step(turn, mission, state=state, **record)
    turn.put(mission, step=mission.step + 1)
    begin_step(turn)


def speak_if_safe(turn: Turn) -> None:
    """Say the words of a step whose beginning is on disk."""
    mission, walk = turn.running, turn.book.walk
    if mission is None or walk is None or walk.kind != "say" or turn.book.safe < walk.record:
        return
    turn.emit(SayAloud(mission.id, mission.steps[mission.step].text or ""))
    finish_step(turn, StepState.SUCCEEDED)


def end_wait_if_due(turn: Turn) -> None:
    """End a wait whose time is over."""
    walk = turn.book.walk
    if walk is not None and walk.until_s is not None and turn.now_s >= walk.until_s:
        finish_step(turn, StepState.SUCCEEDED)


def _succeed(turn: Turn, mission: Mission) -> None:
    code, said = success(turn.book.facts, mission)
    now_unix_s = turn.now_s + turn.book.wall_offset_s
    outcome = ended(
        turn.book.facts, mission, None, turn.book.status, now_unix_s, code=code, said=said
    )
    finish(turn, mission, GoalState.SUCCEEDED, outcome)
