"""Take what the eyes and memory say into the running step; legs after what moves are laid again.

Levels, not events: only the newest sight counts, and a lost one loses nothing. A picture counts for
a gaze when it was taken after the robot stood. Nothing moves by a sight alone: what follows from it
is the skill's next act, carried out like any other. A leg that is driven to see ends, standing,
while nothing is seen: it would lead blindly.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from typing import TYPE_CHECKING

from planner import skills
from planner.bridge_client.bridge_status import standing
from planner.language.catalogue import message, say, say_or_quote
from planner.mission.activity import (
    AskingImage,
    AwaitingAnswer,
    CallingTool,
    Driving,
    LookingUp,
    Observing,
    Waiting,
)
from planner.mission.effects import KeepPicture, SavePicture
from planner.mission.legs import ask_route
from planner.mission.outcomes import looks_into
from planner.mission.queue import settle_activity
from planner.mission.scene import scene_of
from planner.mission.step_execution import carry_out, finish_step, go_on
from planner.mission.step_failure import fail_step
from planner.mission.transaction import Transaction
from planner.perception.snapshot import Sight
from planner.plan import Code, StepState
from planner.skills.conditions import judge_recalled
from planner.skills.object_matching import fresh, list_confirmed
from planner.skills.skill_state import LookState, PatrolState, ToolState
from wire import wrap

if TYPE_CHECKING:
    from planner.mission.events import Recalled, ToolAnswered
    from planner.mission.state import Mission


SETTLE_S = 0.15
"""A picture taken so soon after the robot came to stand may be smeared, and its pose late."""
ASK_S = 0.5
"""A skill is asked again because of what is seen no more often."""
SAME_M, SAME_RAD = 0.25, 0.15
"""A goal that moved by less is the same."""
SEEN_S = 1.0
LOOKING = frozenset({"find", "count", "look", "follow", "go_to_object"})
"""Steps in which nothing is driven but to see, or up to what is seen."""
MORE = 2
"""Where something was seen and is not sure, a gaze takes so many times its looks."""


def on_sight(turn: Transaction, sight: Sight, classes: tuple[str, ...]) -> None:
    """Take the newest word of the eyes."""
    eyes = turn.book.eyes
    if classes and classes != eyes.classes:
        turn.set(eyes=replace(eyes, classes=classes))
    turn.set(sight=sight)
    if turn.running is None or stand_while_blind(turn):
        return
    activity = turn.book.activity
    if isinstance(activity, Observing) and _counts(activity, sight):
        seq = sight.look.seq if sight.look is not None else -1
        activity = replace(activity, looked=activity.looked + 1, look_seq=seq)
        turn.set(activity=activity)
        if _has_enough(turn, activity, sight):
            _end_gaze(turn, activity)
            return
    if isinstance(activity, (Driving, Observing)) and _is_due(turn, activity, sight):
        _ask_skill_again(turn, activity)


def stand_while_blind(turn: Transaction) -> bool:
    """Give up a leg for the eyes' sake while they see nothing, and wait for them; say if so."""
    mission, leg = turn.running, turn.driving
    if turn.book.sight.blind is None or mission is None or leg is None:
        return False
    act, kind = leg.act, mission.steps[mission.step].kind
    if not (act.watch or act.wanted is not None or kind in LOOKING):
        return False
    gaze = skills.Observe(1, state=act.state, then=act.state, watch=act.watch)
    carry_out(turn, settle_activity(turn), gaze)
    return True


def on_told(turn: Transaction, mission_id: str, ticket: int, answer: skills.ImageAnswer) -> None:
    """Take the answer about the picture, if somebody still waits for it."""
    activity = turn.book.activity
    if isinstance(activity, AskingImage) and _goal_awaiting(turn, mission_id, ticket) is not None:
        go_on(turn, activity.act.then, answer=answer)


def _goal_awaiting(turn: Transaction, mission_id: str, ticket: int) -> Mission | None:
    """Return the running goal, if it still waits for the answer to this question."""
    mission, activity = turn.running, turn.book.activity
    waits = isinstance(activity, AwaitingAnswer) and activity.ticket == ticket
    return mission if waits and mission is not None and mission.id == mission_id else None


def on_standing(turn: Transaction) -> None:
    """Let pictures count once the robot stands; end a gaze whose time is over."""
    activity, status = turn.book.activity, turn.book.status
    waits = isinstance(activity, Observing) and activity.standing_s is None
    if waits and status is not None and standing(status):
        turn.change(standing_s=turn.now_s + SETTLE_S)
    end_if_due(turn)


def end_if_due(turn: Transaction) -> None:
    """End a wait or a gaze at its time, or the wait for an answer; a gaze at nothing fails."""
    activity = turn.book.activity
    if not isinstance(activity, (Waiting, Observing, AwaitingAnswer)):
        return
    if turn.now_s < activity.until_s:
        return
    mission = turn.at_work
    step = mission.steps[mission.step]
    match activity:
        case Waiting():
            finish_step(turn, StepState.SUCCEEDED)
        case AskingImage():
            go_on(turn, activity.act.then, answer=skills.ImageAnswer(failure="timed_out"))
        case Observing() if activity.looked > 0:
            _end_gaze(turn, activity)
        case Observing():
            why = turn.book.sight.blind or "camera_silent"
            said = message(Code.BLIND, why=say_or_quote("blind", why))
            fail_step(turn, skills.Fail(Code.BLIND, why, said))
        case CallingTool():
            said = message(Code.TOOL_FAILED, call=step.tool, why=say("tool_problem.timeout"))
            fail_step(turn, skills.Fail(Code.TOOL_FAILED, "timeout", said))
        case _:
            code = Code.MEMORY_UNAVAILABLE
            carry_out(turn, mission, judge_recalled(step.role, code, message(code)))


def _end_gaze(turn: Transaction, gaze: Observing) -> None:
    """Go on after a gaze; its picture is kept for people at a patrol's stop, else for a model."""
    mission, then = turn.at_work, gaze.act.then
    if isinstance(then, PatrolState):
        stop = len(then.stops)
        place = mission.steps[mission.step].places[stop]
        inward = looks_into(turn.book.facts, place, turn.book.pose)
        turn.emit(SavePicture(mission.id, mission.step, stop, place, gaze.look_seq, inward))
    faced = then.faced if isinstance(then, LookState) else ()
    if faced and turn.book.eyes.model:
        turn.emit(KeepPicture(mission.id, len(faced) - 1, gaze.look_seq))
    go_on(turn, then, gazed_s=gaze.standing_s)


def _counts(gaze: Observing, sight: Sight) -> bool:
    look = sight.look
    if look is None or sight.blind is not None or look.seq == gaze.look_seq:
        return False
    return gaze.standing_s is not None and look.taken_s >= gaze.standing_s


def _has_enough(turn: Transaction, gaze: Observing, sight: Sight) -> bool:
    """Return whether a gaze has found its object, or as many pictures as it was to."""
    since_s = gaze.standing_s if gaze.standing_s is not None else turn.now_s
    if gaze.act.wanted is None:
        return gaze.looked >= gaze.act.looks
    if list_confirmed(sight, gaze.act.wanted, since_s):
        return True
    unsure = bool(fresh(sight, gaze.act.wanted, since_s))
    return gaze.looked >= gaze.act.looks * (MORE if unsure else 1)


def _is_due(turn: Transaction, activity: Driving | Observing, sight: Sight) -> bool:
    """Return whether the sight now is a reason to ask the skill."""
    if turn.now_s - activity.asked_s < ASK_S:
        return False
    if isinstance(activity, Observing):
        return activity.act.watch
    # Its way is being searched, or was lost: no new one before it stands.
    busy = activity.manoeuvre is not None or activity.ticket is not None
    if busy or activity.route_when_standing:
        return False
    if activity.act.watch or activity.act.wanted is None:
        return activity.act.watch
    return bool(list_confirmed(sight, activity.act.wanted, turn.now_s - SEEN_S))


def _ask_skill_again(turn: Transaction, activity: Driving | Observing) -> None:
    """Ask the skill in the middle of its act, and do what is new in its answer."""
    turn.change(asked_s=turn.now_s)
    act = skills.act_of(scene_of(turn, turn.at_work))
    if _is_under_way(activity, act):
        if isinstance(act, (skills.DriveLeg, skills.Observe)) and activity.act.watch:
            turn.change(act=replace(activity.act, state=act.state, then=act.then))
    elif (
        isinstance(act, skills.DriveLeg)
        and isinstance(activity, Driving)
        and activity.act.watch
        and activity.act.way is act.way is skills.Way.ROUTE
    ):
        _lay_anew(turn, activity, act)
    else:
        carry_out(turn, settle_activity(turn), act)


def _is_under_way(activity: Driving | Observing, act: skills.SkillAction) -> bool:
    """Return whether the running activity already serves this request."""
    if isinstance(activity, Observing):
        return isinstance(act, skills.Observe)
    if not isinstance(act, skills.DriveLeg) or act.way is not activity.act.way:
        return False
    goal = activity.act.goal
    turned = abs(wrap(act.goal.yaw_rad - goal.yaw_rad))
    if act.way is skills.Way.SPIN:
        return turned <= SAME_RAD
    apart_m = hypot(act.goal.x_m - goal.x_m, act.goal.y_m - goal.y_m)
    return apart_m <= SAME_M


def _lay_anew(turn: Transaction, leg: Driving, act: skills.DriveLeg) -> None:
    """Aim the leg at a goal that has moved; the old horizon streams until the new way is there."""
    laid = replace(
        leg.act,
        goal=act.goal,
        heading=act.heading,
        state=act.state,
        then=act.then,
        otherwise=act.otherwise,
        # So much was spent before it was laid, of a leg that goes on.
        limit_s=leg.moving_s + act.limit_s if act.limit_s is not None else None,
        limit_m=leg.metres + act.limit_m if act.limit_m is not None else None,
    )
    turn.change(act=laid)
    ask_route(turn)


def on_recalled(turn: Transaction, event: Recalled) -> None:
    """End the step with memory's answer, if it still waits for it."""
    mission = _goal_awaiting(turn, event.id, event.ticket)
    if mission is not None and isinstance(turn.book.activity, LookingUp):
        step = mission.steps[mission.step]
        carry_out(turn, mission, judge_recalled(step.role, event.code, event.said))


def on_tool_answered(turn: Transaction, event: ToolAnswered) -> None:
    """End the step with a tool's answer, or ask a person first, if the step still waits for it."""
    mission = _goal_awaiting(turn, event.id, event.ticket)
    if mission is None or not isinstance(turn.book.activity, CallingTool):
        return
    if event.asks:
        carry_out(turn, mission, skills.Question(event.said, ToolState(question=event.said)))
    elif event.problem is None:
        carry_out(turn, mission, skills.Finish({}, Code.TOOL_ANSWERED, event.said, event.read))
    else:
        figures = {"code": Code.TOOL_FAILED, "read": event.read}
        carry_out(turn, mission, skills.Fail(Code.TOOL_FAILED, event.problem, event.said, figures))
