"""What is put ahead not nearer than a stop and a scan is not touched; nearer, only gently."""

from __future__ import annotations

from math import pi

import pytest

from tests.tools.lockstep.walls_and_people import clearance_m, faster_than_allowed, gap_m, trials
from wire import Pose2


@pytest.mark.parametrize("seed", [3, 4])
def test_people_and_crates_ahead(seed: int) -> None:
    for one in trials(seed, 4):
        if one["far"]:
            assert one["contact_mps"] is None, one
        else:
            assert not faster_than_allowed(one), one


@pytest.mark.parametrize(
    ("thing", "at", "gap"),
    [
        ("person_0", Pose2(2.0, 0.0, 0.0), 2.0 - 0.55),
        ("crate_0", Pose2(2.0, 0.0, 0.0), 2.0 - 0.55),
        ("crate_0", Pose2(2.0, 0.0, pi / 4), 2.0 - 0.3 - 0.25 * 2**0.5),
        ("person_0", Pose2(0.0, 2.0, 0.0), 3.0),
    ],
)
def test_the_judge_measures_the_gap_on_the_arc(thing: str, at: Pose2, gap: float) -> None:
    here = Pose2(0.0, 0.0, 0.0)
    assert gap_m(thing, at, here, 1.0, 0.0, 3.0) == pytest.approx(gap, abs=0.006)


def test_inside_a_thing_there_is_no_clearance() -> None:
    assert clearance_m("crate_0", Pose2(0.0, 0.0, 0.3), 0.0, 0.0) == pytest.approx(-0.55)
    assert clearance_m("person_0", Pose2(0.0, 0.0, 0.3), 0.0, 0.0) == pytest.approx(-0.55)
