"""Know how much of a turn or a move is done, also across pauses, crashes and other goals.

Law: what is left is left from where the robot stands when its goal goes on, wherever others drove
it meanwhile. So the amount is settled as soon as an interrupted robot stands, or when another goal
takes it: by the map from where the step began, with odometry counting whole turns. Where a hand
steered first, the map says nothing of the step any more: what odometry counted stands.
"""

from __future__ import annotations

from math import cos, sin

from planner.language.catalogue import say
from planner.mission.queue import finish, standing_hold
from planner.mission.skills.move import along
from planner.mission.skills.turn import turned_rad
from planner.mission.state import Mission
from planner.mission.transaction import Transaction
from planner.mission.transitions import GoalFact
from planner.plan import Code, Outcome, PauseReason
from wire import Mode, Pose2, Status

BY_AMOUNT = frozenset({"turn", "move"})
"""Steps that are measured from where they began."""
STEERED = say("goal.steered")


def measure_from(turn: Transaction, mission: Mission, pose: Pose2 | None) -> Mission:
    """Note where a measured step begins, or began: what is done lies behind the robot."""
    step = mission.now
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
        step = mission.now
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
        if mission.began_at is None or mission.ended:
            continue
        if mission.reason == PauseReason.PLANNER_RESTARTED.value:
            said = Outcome(code=Code.NOT_REACHED, message=STEERED)
            finish(turn, mission, GoalFact.PROGRESS_UNKNOWN, said, "steered_meanwhile")
        else:
            turn.put(mission, began_at=None)
