"""Say why a question about the picture has no answer, or a point of it is not driven to. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.model_error_codes import REASONS
from planner.mission.skills.actions import Fail
from planner.plan import Bilingual, Code, message, same

if TYPE_CHECKING:
    from planner.mission.skills.perception import Answer

POINTS = {
    "point_on_wall": ("it shows a wall or furniture", "那里是墙或家具"),
    "point_off_map": ("it lies outside the floor that I may drive on", "那里不在允许行驶的区域内"),
    "point_no_depth": ("its distance is not known", "无法得知距离"),
    "point_too_far": ("it is too far away", "距离太远"),
    "point_no_pose": ("I did not know where I was", "当时位置未知"),
    "point_no_route": ("there is no way to it", "没有通往那里的路"),
}
_UNSEEN = Bilingual(en="The vision model does not see it here.", zh="视觉模型在这里没有看到。")


def why_silent(answer: Answer | None) -> Bilingual | None:
    """Return why the model said nothing, where that is to be told: the detector spoke instead."""
    failure = answer.failure if answer is not None else None
    return REASONS.get("timeout" if failure == "timed_out" else failure or "")


def point_refused(code: str) -> Fail:
    """Say why a point of the picture is not driven to."""
    en, zh = POINTS.get(code, (code, code))
    said = message(Code.POINT_REFUSED, why=Bilingual(en=en, zh=zh))
    return Fail(Code.POINT_REFUSED, code, said)


def not_pointed(words: str, answer: Answer) -> Fail:
    """Say why a model's point leads nowhere: it saw nothing, was not asked, or pointed amiss."""
    if answer.failure in POINTS:
        return point_refused(answer.failure)
    why = why_silent(answer) or _UNSEEN
    said = message(Code.NOT_FOUND, thing=same(words), looked=why)
    return Fail(Code.NOT_FOUND, answer.failure or "not_found", said)
