"""Gather what a skill is told: its step, the robot, the eyes, and what was spent so far."""

from __future__ import annotations

from planner.mission.activity import TIMED
from planner.mission.motion_on_yes import can_think, upon_yes
from planner.mission.outcomes import accepted_at
from planner.mission.queue import notes_now
from planner.mission.skills import Answer, Scene
from planner.mission.state import Mission
from planner.mission.transaction import Transaction
from wire import Pose2


def scene_of(
    turn: Transaction, mission: Mission, gazed_s: float | None = None, answer: Answer | None = None
) -> Scene:
    """Return what the skill of the current step is told; ``gazed_s``: a gaze has just ended."""
    activity = turn.book.activity
    began_s = activity.since_s if isinstance(activity, TIMED) else None
    since_s = began_s if began_s is not None else turn.now_s
    return Scene(
        step=mission.steps[mission.step],
        facts=turn.book.facts,
        pose=pose_now(turn),
        began=Pose2(*mission.began_at) if mission.began_at is not None else None,
        done=mission.done,
        part=mission.part,
        accepted=accepted_at(mission),
        language=mission.language,
        notes=notes_now(mission, activity),
        eyes=turn.book.eyes,
        sight=turn.book.sight,
        now_s=turn.now_s,
        gazed_s=gazed_s,
        spent_s=mission.step_s + max(0.0, turn.now_s - since_s),
        spent_m=mission.step_m + (activity.metres if activity is not None else 0.0),
        answer=answer,
        upon=upon_yes(turn.book.facts, mission),
        thinks=can_think(turn.book.rules, mission),
    )


def pose_now(turn: Transaction) -> Pose2 | None:
    """Return where the robot is, as the newest status says."""
    return turn.book.status.base_in_map if turn.book.status is not None else None
