"""A person's word is taken once, and answered once."""

from __future__ import annotations

import pytest

from localization.hint_dialogue import HintDialogue
from tests.localization.rooms import odometry_of
from wire import IDENTITY, HintCode, Pose2, PoseHint, Twist2

STANDING = odometry_of(1.0, IDENTITY)


def word(hint_id: str) -> PoseHint:
    return PoseHint(id=hint_id, pose=Pose2(1.0, 2.0, 0.0), radius_m=1.0)


@pytest.mark.parametrize(
    ("twist", "has_scan", "code"),
    [
        (None, True, "no_scan"),
        (Twist2(0.0, 0.0), False, "no_scan"),
        (Twist2(0.3, 0.0), True, "moving"),
        (Twist2(0.0, -0.3), True, "moving"),
    ],
)
def test_a_word_that_no_scan_can_judge_is_refused_at_once(
    twist: Twist2 | None, has_scan: bool, code: HintCode
) -> None:
    dialogue = HintDialogue()
    odometry = None if twist is None else odometry_of(1.0, IDENTITY, twist=twist)
    assert not dialogue.hear(word("a"), odometry, has_scan=has_scan)
    assert dialogue.pending is None
    assert dialogue.answer is not None
    assert (dialogue.answer.id, dialogue.answer.code) == ("a", code)


def test_a_pending_word_is_answered_once_and_others_wait() -> None:
    dialogue = HintDialogue()
    assert dialogue.hear(word("a"), STANDING, has_scan=True)
    assert not dialogue.hear(word("a"), STANDING, has_scan=True), "the same again"
    assert dialogue.answer is None
    assert not dialogue.hear(word("b"), STANDING, has_scan=True)
    assert dialogue.answer is not None
    assert dialogue.answer.code == "busy"
    dialogue.settle("accepted", 1.0000001)
    assert (dialogue.answer.id, dialogue.answer.code, dialogue.answer.score) == (
        "a", "accepted", 1.0,
    )  # fmt: skip
    dialogue.settle("no_answer")
    assert dialogue.answer.code == "accepted", "nothing is pending"
