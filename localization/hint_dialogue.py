"""Hold a person's word on where the robot is until it is answered, and the newest answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from localization.localizer_status import bounded_score
from wire import HintVerdict

if TYPE_CHECKING:
    from wire import HintCode, Odometry, PoseHint

STANDING_MPS, STANDING_RADPS = 0.02, 0.05


class HintDialogue:
    """Answer each hint once."""

    def __init__(self) -> None:
        self.pending: PoseHint | None = None
        self.answer: HintVerdict | None = None
        """To the newest hint, once there is one."""

    def hear(self, hint: PoseHint, odometry: Odometry | None, *, has_scan: bool) -> bool:
        """Take a hint, or refuse it; return whether it is to be judged by scans.

        The same id again is the same hint.

        Args:
            hint: what a person said.
            odometry: the newest; None before there is any.
            has_scan: whether a scan has come since the start.
        """
        if any(one is not None and one.id == hint.id for one in (self.pending, self.answer)):
            return False
        twist = None if odometry is None else odometry.twist
        code: HintCode
        if self.pending is not None:
            code = "busy"
        elif twist is None or not has_scan:
            code = "no_scan"
        elif not (abs(twist.v_mps) < STANDING_MPS and abs(twist.w_radps) < STANDING_RADPS):
            code = "moving"
        else:
            self.pending = hint
            return True
        self.answer = HintVerdict(id=hint.id, code=code, score=None)
        return False

    def settle(self, code: HintCode, score: float | None = None) -> None:
        """Answer the pending hint, if there is one."""
        if self.pending is not None:
            held = None if score is None else bounded_score(score)
            self.answer = HintVerdict(id=self.pending.id, code=code, score=held)
            self.pending = None
