"""Tell where the robot of a scripted conversation stands: it drives nowhere, and is there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.mission.departure import way_back_of
from wire import (
    PROTOCOL,
    Action,
    BrakingReport,
    DriveReport,
    LimitsInForce,
    Mode,
    Pose2,
    Status,
    TickStats,
    Twist2,
)

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.site.site_view import SiteView

ASIDE_M = 0.7
"""A side of a thing is not worked out here: so far from it the robot stands then."""
_NONE, _STILL = "0" * 16, Twist2(0.0, 0.0)


def pose_after(facts: SiteView, mission: Mission, before: Pose2) -> Pose2:
    """Return where a goal that was done has led, as far as its steps name places."""
    pose, back = before, way_back_of(mission)
    for step in mission.steps:
        place = facts.home if step.kind == "return_home" else step.place
        place = step.places[-1] if step.places else place
        if step.kind == "come_back":
            pose = Pose2(*back) if back is not None else pose
        elif step.kind != "recall" and (target := facts.targets.get(place or "")) is not None:
            aside_m = ASIDE_M if step.kind == "stand_at" else 0.0
            at = target.pose
            pose = Pose2(at.x_m + aside_m, at.y_m + aside_m, at.yaw_rad)
    return pose


def standing_status(pose: Pose2) -> Status:
    """Return the status of an armed robot that stands at a pose in ``map``."""
    return Status(
        protocol=PROTOCOL, robot="r1", boot="b1", seq=1, at_s=0.0, mode=Mode.HOLD,
        action=Action.NONE, epoch="b1-1", nonce="n1", owner=None, held=None, grant=None, leg=None,
        base_in_odom=pose, base_in_map=pose, asked=_STILL, sent=_STILL, measured=_STILL,
        limits=LimitsInForce(v_mps=0.5, w_radps=1.0, by="max_speed", free_m=None), rows=(),
        answers=(), waiting_for=(), blocked=False, robot_hash=_NONE, fence_hash=_NONE,
        map_id=_NONE, operator_metres=500.0, operator_seconds=3600.0,
        drive=DriveReport(kind="sim", virtual=True, enabled=True, timed_out=False, boot_id="d1",
                          battery=None, real_time=False),
        braking=BrakingReport(lag_s=0.06, decel_mps2=1.0, learnt=False, stops=0, trouble=None),
        ticks=TickStats(ticks=0, missed=0, late_p50_us=0, late_max_us=0, step_max_us=0, dropped=0,
                        record_gaps=0),
    )  # fmt: skip
