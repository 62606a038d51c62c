"""What a localizer does is told within the wire's bounds, with candidates while it has no pose."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from localization.global_search import Candidate
from localization.localizer_status import bounded_score, make_status
from wire import Pose2

FOUND = tuple(Candidate((float(k), 1.0, 0.5), 0.9 - k / 10) for k in range(8))
STAMP = ("loc-1", 3, 7.5)


@pytest.mark.parametrize(("state", "told"), [("searching", 5), ("lost", 5), ("tracking", 0)])
def test_candidates_are_told_while_there_is_no_pose(state: str, told: int) -> None:
    said = make_status(state, 0.4, FOUND, None, STAMP)  # type: ignore[arg-type]  # by parametrize
    assert len(said.candidates) == told
    assert (said.boot_id, said.seq, said.stamp_s) == STAMP
    assert all(one.pose == Pose2(float(k), 1.0, 0.5) for k, one in enumerate(said.candidates))


@pytest.mark.parametrize("state", ["searching", "lost", "tracking", "coasting"])
def test_why_there_is_no_pose_is_told_while_there_is_none(state: str) -> None:
    said = make_status(state, 0.4, FOUND, None, STAMP, "search_timed_out")  # type: ignore[arg-type]  # by parametrize
    assert said.trouble == ("search_timed_out" if state in {"searching", "lost"} else None)


@given(st.floats(-3.0, 3.0))
def test_a_score_stays_within_what_the_wire_takes(score: float) -> None:
    assert -1.0 <= bounded_score(score) <= 1.0
    assert make_status("lost", score, (), None, STAMP).score == bounded_score(score)
