"""What is said of the battery: its charge, that nobody knows it, or that the bridge is silent."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.mission.spoken_status import tell_battery
from planner.mission.state import MissionState
from tests.planner.mission.fakes import FACTS
from tests.wire.examples import STATUS


def book(charge: float | None) -> MissionState:
    drive = STATUS.drive.model_copy(update={"battery": charge})
    return replace(MissionState(FACTS), status=STATUS.model_copy(update={"drive": drive}))


@pytest.mark.parametrize(
    ("charge", "en", "zh"),
    [(0.8, "80 %", "80 %"), (0.0, "0 %", "0 %"), (None, "does not tell how full", "不报告电量")],
)
def test_the_charge_is_told_in_both_languages(charge: float | None, en: str, zh: str) -> None:
    told = tell_battery(book(charge), 0.1)
    assert en in told.en
    assert zh in told.zh


@pytest.mark.parametrize("age_s", [1.5, float("inf"), float("nan")])
def test_an_old_charge_is_not_told(age_s: float) -> None:
    assert "80" not in tell_battery(book(0.8), age_s).en
    assert "80" not in tell_battery(MissionState(FACTS), 0.1).en
