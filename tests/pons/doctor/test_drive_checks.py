"""The doctor says what a drive's silence costs."""

from __future__ import annotations

import pytest

from pons.doctor import drive_checks
from wire import RobotDescription
from wire.drive_config import DRIVE_KINDS, DriveKind


def test_a_drive_that_reports_often_costs_nothing() -> None:
    found = drive_checks.drive(RobotDescription()).found
    assert found.en == "held after 80 ms without a state, or 100 ms without an answer"


def test_one_that_reports_seldom_is_said_to_cost_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(dict_of_kinds(), "sim", DriveKind((), (), 0.06))
    found = drive_checks.drive(RobotDescription()).found
    assert "held after 150 ms without a state, or 150 ms without an answer" in found.en
    assert "70 ms more lag" in found.en
    assert "70 毫秒" in found.zh


def dict_of_kinds() -> dict[str, DriveKind]:
    assert isinstance(DRIVE_KINDS, dict)
    return DRIVE_KINDS
