"""End a leg when the bridge says that it was reached, and go on in its step.

A leg is done when the bridge says that this very leg was reached, the robot stands, and its pose
lies inside the room's outline.
"""

from __future__ import annotations

from planner.mission.activity import Driving
from planner.mission.bridge_status import standing
from planner.mission.legs import abandon_route
from planner.mission.outcomes import spot_at
from planner.mission.queue import note_step, settle_activity
from planner.mission.scene import scene_of
from planner.mission.skills import act_of
from planner.mission.step_execution import carry_out
from planner.mission.transaction import Transaction
from planner.site.polygon import contains
from wire import Pose2


def on_arrival(turn: Transaction) -> bool:
    """Go on in the step if the bridge says that its leg is done; say whether that happened."""
    mission, driving, status = turn.running, turn.driving, turn.book.status
    if mission is None or driving is None or status is None or driving.leg is None:
        return False
    leg, pose = status.leg, status.base_in_map
    if leg is None or (leg.mission, leg.leg) != (mission.grant_name, driving.leg):
        return False
    if not (leg.reached and standing(status)) or pose is None:
        return False
    if _is_outside(turn, driving, pose):
        abandon_route(turn)
        return True
    settled = settle_activity(turn)
    if settled is None:
        return True
    mission = turn.put(
        settled, part=settled.part + 1, skill_state=driving.then or settled.skill_state
    )
    figures = {"reached": spot_at(turn.book.facts, pose, driving.target)}
    residuals = {
        "residual_m": round(leg.residual_m, 4),
        "residual_rad": round(leg.residual_rad, 4) if driving.heading else None,
    }
    mission = note_step(turn, mission, **figures, **residuals)
    step = mission.steps[mission.step]
    if step.kind == "patrol" and not step.look:
        mission = note_step(turn, mission, visited=mission.part)
    carry_out(turn, mission, act_of(scene_of(turn, mission)))
    return True


def _is_outside(turn: Transaction, driving: Driving, pose: Pose2) -> bool:
    """Tell whether the leg ended short of the room that it was to."""
    target = turn.book.facts.targets.get(driving.target or "")
    if target is None or not target.room or target.polygon is None:
        return False
    return not contains(target.polygon, pose.x_m, pose.y_m)
