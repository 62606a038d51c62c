"""Judge each bridge status for the running mission: stop, pause, fail, route anew, arrive, go on.

Levels, not events: whatever stands in the newest status is judged anew, so a lost status loses
nothing. The order is the law: what a person or a fault demands comes before any progress.
"""

from __future__ import annotations

from planner.bridge_client import bridge_status
from planner.mission import legs
from planner.mission.activity import (
    AskingImage,
    Driving,
    Observing,
    Retrying,
    RoutePurpose,
    Waiting,
)
from planner.mission.leg_routes import on_arrival, reconsider_viewpoint
from planner.mission.open_questions import end_unanswered
from planner.mission.outcomes import moves
from planner.mission.perception_events import end_if_due, on_standing, stand_while_blind
from planner.mission.queue import end_running, hold_queue, pause_running, standing_hold
from planner.mission.recovery_steps import leave_silence, recover, watch_manoeuvre
from planner.mission.state import Mission
from planner.mission.step_execution import begin_step
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.plan import Code, PauseReason, fault
from planner.skills import Fail, Way
from planner.skills.drive_to_place import place_gone
from wire import Mode, Status

SILENCE_S = 5.0
"""After so long without a word from the bridge nothing goes on unasked."""
ROW_S = 30.0
OBSTACLE_S = 300.0
PATIENCE_S = 20.0
"""What stands in the way of a leg that its step can do without is waited for so long."""
IDLE_S = 30.0
"""A leg that is streamed and neither followed nor explained by a row for so long is given up."""
REFUSED_S = 0.5
NAV2_BLOCKED_S = 60.0
"""So long Nav2's own recoveries have for what the bridge lets it not drive into."""


def on_status(turn: Transaction, status: Status, off_path: bool, left_m: float | None) -> None:
    """Judge one status; ``left_m`` is the way left on the path that is streamed."""
    before = turn.book.status
    if before is not None and before.boot == status.boot and status.seq <= before.seq:
        return  # late or repeated: the newest word stands
    silent_s = turn.now_s - turn.book.status_s
    turn.set(status=status, status_s=turn.now_s)
    if standing_hold(turn) is not None:
        hold_queue(turn)
    if legs.hand_steers(turn, status):
        legs.forget_beginnings(turn)
    elif bridge_status.standing(status):
        legs.settle_amounts(turn, status.base_in_map)
    if turn.running is None:
        return
    _measure(turn, before, status, min(silent_s, SILENCE_S), left_m)
    if not _interrupt(turn, status, silent_s):
        _progress(turn, status, off_path)


def on_tick(turn: Transaction) -> None:
    """Let time pass: waits end, silence is noticed, a question is not waited on for ever."""
    end_unanswered(turn)
    if turn.running is None:
        return
    moving = isinstance(turn.book.activity, (Driving, Retrying))
    if moving and turn.now_s - turn.book.status_s > SILENCE_S:
        pause_running(turn, fault("BRAIN_GONE"))
        return
    end_if_due(turn)


def _measure(
    turn: Transaction, before: Status | None, status: Status, since_s: float, left_m: float | None
) -> None:
    """Add up the odometry, the time that the leg was followed, and the limits met."""
    activity, mission = turn.book.activity, turn.at_work
    if activity is None:
        return
    turning = mission.steps[mission.step].kind == "turn"
    turn.change(
        metres=activity.metres + bridge_status.driven_m(before, status),
        amount=activity.amount + bridge_status.amount_done(before, status, turning=turning),
    )
    if not isinstance(activity, Driving):
        return
    limited, moving_s = activity.limited, activity.moving_s
    if status.leg is not None and status.leg.following and activity.leg == status.leg.leg:
        limited = {**limited, status.limits.by: limited.get(status.limits.by, 0) + 1}
        if not (status.blocked or bridge_status.holding_rows(status)):
            moving_s += since_s
    turn.change(limited=limited, moving_s=moving_s, left_m=left_m)


def _interrupt(turn: Transaction, status: Status, silent_s: float) -> bool:
    """Pause or fail the running mission where something stronger than its plan says so."""
    hold = standing_hold(turn)
    if hold is not None:
        pause_running(turn, _fault_reason(status) if hold == "fault" else hold)
        return True
    mission = turn.at_work
    if not any(map(moves, mission.steps_ahead)):
        return False
    if silent_s > SILENCE_S:
        pause_running(turn, fault("BRAIN_GONE"))
        return True
    cause = bridge_status.cannot_move(status)
    if cause is not None:
        pause_running(turn, cause)
        return True
    return _end_spent(turn, mission, status) or _held_too_long(turn, status)


def _fault_reason(status: Status) -> str:
    """Name what holds: a protective stop by its own name, anything else by its row."""
    if status.mode is Mode.ESTOPPED:
        return PauseReason.ESTOP.value
    rows = bridge_status.holding_rows(status) or status.rows
    return fault(max(rows, key=lambda r: r.for_s).row if rows else "HELD")


def _end_spent(turn: Transaction, mission: Mission, status: Status) -> bool:
    # Rows outlive the mission they were about; only a row seen on our own leg is ours.
    ours = status.leg is not None and status.leg.mission == mission.grant_name
    code = bridge_status.refused_grant(status, mission.grant_name) if status.grant is None else None
    if not (status.operator_metres > 0.0 and status.operator_seconds > 0.0):
        if code == "operator_budget" or (ours and bridge_status.shows(status, "BUDGET")):
            pause_running(turn, PauseReason.BUDGET.value)  # goes on once a person has acted
            return True
    elif code == "budget" or (ours and bridge_status.shows(status, "BUDGET")):
        end_running(turn, GoalFact.STEP_FAILS, Code.OUT_OF_BUDGET, "budget")
        return True
    if ours and bridge_status.shows(status, "STUCK"):
        end_running(turn, GoalFact.STEP_FAILS, Code.FAULT, "stuck", row="STUCK")
        return True
    return False


def _held_too_long(turn: Transaction, status: Status) -> bool:
    activity = turn.book.activity
    if not isinstance(activity, (Driving, Retrying)):
        return False
    rows = bridge_status.holding_rows(status)
    if not (rows or status.blocked):
        turn.change(row_since_s=None)
        return False
    since_s = activity.row_since_s if activity.row_since_s is not None else turn.now_s
    turn.change(row_since_s=since_s)
    others = [r for r in rows if r.row not in bridge_status.GATES]
    spare = isinstance(activity, Driving) and activity.act.otherwise is not None
    if spare and not others and turn.now_s - since_s > PATIENCE_S:
        fail_step(turn, Fail(Code.BLOCKED, "blocked"))  # the step goes on without this leg
        return True
    if turn.now_s - since_s <= (ROW_S if others else OBSTACLE_S):
        return False
    worst = max(others, key=lambda r: r.for_s, default=None)
    pause_running(turn, fault(worst.row) if worst is not None else PauseReason.BLOCKED.value)
    return True


def _progress(turn: Transaction, status: Status, off_path: bool) -> None:
    if isinstance(turn.book.activity, Waiting):
        end_if_due(turn)
    match turn.book.activity:
        case Observing() | AskingImage():
            on_standing(turn)
        case Retrying(retry_s=retry_s) if turn.now_s >= retry_s and not bridge_status.shows(
            status, "POSE_JUMP"
        ):
            begin_step(turn)
        case Driving() as leg:
            _drive_on(turn, leg, status, off_path)


def _drive_on(turn: Transaction, leg: Driving, status: Status, off_path: bool) -> None:
    """Arrive, or see that the way is still one: searched, streamed, followed, within its limits."""
    if stand_while_blind(turn):
        return
    if (leg.manoeuvre is None and on_arrival(turn)) or _off_limits(turn, leg):
        return
    if bridge_status.shows(status, "POSE_JUMP"):
        if not leg.jumped:
            jump = {"jumped": True, "leg": None, "ticket": None, "manoeuvre": None}
            turn.change(**jump, route_when_standing=True)
        leg = turn.driving or leg
    if leg.manoeuvre is not None:
        watch_manoeuvre(turn, leg, status)
    elif off_path and leg.leg is not None:
        legs.abandon_route(turn)
    elif leg.route_when_standing:
        if bridge_status.standing(status) and not bridge_status.shows(status, "POSE_JUMP"):
            legs.ask_route(turn)
    elif leg.retry_s is not None and turn.now_s >= leg.retry_s and leg.ticket is None:
        climbed = turn.at_work.recovery.ladders > 0
        again = leg.detours_failed > 0 or leg.occupied_since_s is not None or climbed
        legs.ask_route(turn, RoutePurpose.DETOUR if again else RoutePurpose.LEG)
    elif leg.leg is not None:
        _watch_leg(turn, status, leg)


def _off_limits(turn: Transaction, leg: Driving) -> bool:
    """End a leg whose place is gone, or that spends more than its skill's budget."""
    act = leg.act
    if act.target is not None and act.target not in turn.book.facts.targets:
        fail_step(turn, place_gone(turn.book.facts, act.target))
    elif act.limit_s is not None and not leg.moving_s <= act.limit_s:
        fail_step(turn, Fail(Code.BLOCKED, "too_slow"))
    elif act.limit_m is not None and not leg.metres <= act.limit_m:
        fail_step(turn, Fail(Code.BLOCKED, "too_far"))
    else:
        return False
    return True


def _watch_leg(turn: Transaction, status: Status, driving: Driving) -> None:
    """Follow the leg that is streamed: blocked, refused, or forgotten by the bridge."""
    leg = legs.told_of_leg(turn)
    refused = leg is not None and leg.refusal is not None
    follows = leg is not None and leg.following
    quiet = not (follows or status.blocked or bridge_status.holding_rows(status))
    blocked_s = _since(driving.blocked_since_s, status.blocked, turn.now_s)
    refused_s = _since(driving.refused_since_s, refused, turn.now_s)
    idle_s = _since(driving.idle_since_s, quiet, turn.now_s)
    turn.change(blocked_since_s=blocked_s, refused_since_s=refused_s, idle_since_s=idle_s)
    if refused_s is not None and turn.now_s - refused_s > REFUSED_S:
        turn.change(refused_since_s=None)
        legs.abandon_route(turn)
    elif idle_s is not None and turn.now_s - idle_s > IDLE_S:
        pause_running(turn, PauseReason.BLOCKED.value)
    elif turn.book.nav2:
        if blocked_s is not None and turn.now_s - blocked_s > NAV2_BLOCKED_S:
            fail_step(turn, Fail(Code.BLOCKED, "blocked"))
    elif driving.act.way is Way.ROUTE:
        _recover_or_go_on(turn, status)
    elif blocked_s is not None and driving.ticket is None:
        legs.detour_if_due(turn, driving, blocked_s)


def _recover_or_go_on(turn: Transaction, status: Status) -> None:
    leg = turn.leg
    if leg.ticket is not None:
        return
    rows = {row.row for row in bridge_status.holding_rows(status)} - bridge_status.GATES
    if rows == {bridge_status.SILENT_SECTOR}:
        leave_silence(turn, leg, status)
    if rows:
        return
    if status.blocked:
        recover(turn, leg, status)
    else:
        turn.change(occupied_since_s=None)  # what stood on its goal has left
        reconsider_viewpoint(turn)


def _since(since_s: float | None, true_now: bool, now_s: float) -> float | None:
    if not true_now:
        return None
    return since_s if since_s is not None else now_s
