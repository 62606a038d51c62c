"""Put what a localizer does into words of the wire, for people and for the planner."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from wire import HintVerdict, LocalizerStatus, Pose2, PoseCandidate

if TYPE_CHECKING:
    from localization.global_search import Candidate
    from wire import LocalizerTrouble

MOST_CANDIDATES = 5


def make_status(
    state: Literal["searching", "tracking", "coasting", "lost"],
    score: float,
    candidates: tuple[Candidate, ...],
    hint: HintVerdict | None,
    stamp: tuple[str, int, float],
    trouble: LocalizerTrouble | None = None,
) -> LocalizerStatus:
    """Return what it does now; candidates and trouble only while there is no pose.

    Args:
        state: its state.
        score: of the newest scan at the tracked pose.
        candidates: what the newest search found, best first.
        hint: its verdict on the newest hint.
        stamp: boot_id, seq and stamp_s of the message.
        trouble: why it has no pose, where it knows that.
    """
    boot_id, seq, stamp_s = stamp
    placed = state in ("tracking", "coasting")
    found = () if placed else candidates[:MOST_CANDIDATES]
    return LocalizerStatus(
        boot_id=boot_id,
        seq=seq,
        stamp_s=stamp_s,
        state=state,
        score=bounded_score(score),
        candidates=tuple(
            PoseCandidate(pose=Pose2(*one.pose), score=bounded_score(one.score)) for one in found
        ),
        hint=hint,
        trouble=None if placed else trouble,
    )


def bounded_score(score: float) -> float:
    """Return a score as it is told: rounded, and no farther from 0 than counting allows."""
    return round(min(max(score, -1.0), 1.0), 3)
