"""The doctor says what a drive's silence costs."""

from __future__ import annotations

import pytest

from pons.doctor import drive_checks
from pons.doctor.finding import HealthVerdict
from wire import RobotDescription
from wire.drive_config import DRIVE_KINDS, DriveKind
from wire.trial_record import TrialRecord, wiring_of


def test_a_drive_that_reports_often_costs_nothing() -> None:
    found = drive_checks.drive(RobotDescription()).found
    assert found.en == "held after 80 ms without a state, or 100 ms without an answer"


def test_one_that_reports_seldom_is_said_to_cost_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(dict_of_kinds(), "sim", DriveKind((), (), 0.06))
    found = drive_checks.drive(RobotDescription()).found
    assert "held after 150 ms without a state, or 150 ms without an answer" in found.en
    assert "70 ms more lag" in found.en
    assert "70 毫秒" in found.zh


def test_metal_that_nobody_tried_fails_with_its_cure() -> None:
    drive = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 400}
    new = RobotDescription.model_validate({"drive": drive})
    wiring = wiring_of(new)
    record = TrialRecord(date="2026-11-24", wiring=wiring, dead_man_s=0.25, brake_s=0.0)
    known = new.model_copy(update={"trial": record})
    other = known.model_copy(update={"drive": new.drive.model_copy(update={"port": "/dev/z"})})
    for robot, verdict, words in (
        (RobotDescription(), HealthVerdict.OK, "needs none"),
        (new, HealthVerdict.FAIL, "nobody has tried"),
        (known, HealthVerdict.OK, "after 0.25 s"),
        (other, HealthVerdict.FAIL, "other values"),
    ):
        finding = drive_checks.trial(robot)
        assert finding.verdict is verdict
        assert words in finding.found.en
        assert (finding.fix is None) == (verdict is HealthVerdict.OK)


def dict_of_kinds() -> dict[str, DriveKind]:
    assert isinstance(DRIVE_KINDS, dict)
    return DRIVE_KINDS
