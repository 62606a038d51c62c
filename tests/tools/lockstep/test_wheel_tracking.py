"""With wheel control a robot whose motors are not as described does what was meant."""

from __future__ import annotations

import pytest

from tests.tools.lockstep.wheel_tracking import METALS, drive
from wire import Pose2

LIMIT_MMPS, LIMIT_MM = 10.0, 8.0
"""Seen: 5 to 7 mm/s, and 2 to 5 mm per metre of path; without control 20 to 63, and 14 to 440."""

NEAR = Pose2(1.4, 2.5, 1.0)
"""A third of the measure's way, with a turn at its beginning."""


@pytest.mark.parametrize("name", ["motors +15 %", "motors -15 %", "right wheel -10 %"])
def test_wheels_turn_as_meant_and_the_path_is_the_one_meant(name: str) -> None:
    control = drive(METALS[name], 1, control=True, start=NEAR)
    assert control.reached
    assert control.rim_mmps < LIMIT_MMPS
    assert control.strayed_mm < LIMIT_MM


def test_without_control_they_do_not() -> None:
    plain = drive(METALS["right wheel -10 %"], 1, control=False, start=NEAR)
    assert plain.rim_mmps > LIMIT_MMPS
    assert plain.strayed_mm > LIMIT_MM
