"""Say why a question about the picture has no answer, or a point of it is not driven to. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.brain.model_error_codes import REASONS
from planner.language.catalogue import message, say
from planner.plan import Bilingual, Code, say_same
from planner.skills.actions import Fail

if TYPE_CHECKING:
    from planner.skills.perception import ImageAnswer

POINTS = frozenset(
    {
        "point_on_wall",
        "point_off_map",
        "point_no_depth",
        "point_too_far",
        "point_no_pose",
        "point_no_route",
    }
)
_UNSEEN = say("image.unseen")
_UNREADABLE = say("image.unreadable")


def why_silent(answer: ImageAnswer | None) -> Bilingual | None:
    """Return why the model said nothing, where that is to be told: the detector spoke instead."""
    return reason_of(answer.failure or "") if answer is not None else None


def reason_of(failure: str) -> Bilingual | None:
    """Return the sentence of a failed question about a picture; None where there is none."""
    if failure == "bad_plan":  # it was asked for words or a point: whoever hears of a plan wonders
        return _UNREADABLE
    return REASONS.get("timeout" if failure == "timed_out" else failure)


def point_refused(code: str) -> Fail:
    """Say why a point of the picture is not driven to."""
    why = say(f"point.{code.removeprefix('point_')}") if code in POINTS else say_same(code)
    said = message(Code.POINT_REFUSED, why=why)
    return Fail(Code.POINT_REFUSED, code, said)


def not_pointed(words: str, answer: ImageAnswer) -> Fail:
    """Say why a model's point leads nowhere: it saw nothing, was not asked, or pointed amiss."""
    if answer.failure in POINTS:
        return point_refused(answer.failure)
    why = why_silent(answer) or _UNSEEN
    said = message(Code.NOT_FOUND, thing=say_same(words), looked=why)
    return Fail(Code.NOT_FOUND, answer.failure or "not_found", said)
