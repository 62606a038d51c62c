"""The doctor says what a drive's silence costs, and whether anybody saw it stop by itself."""

from __future__ import annotations

from pathlib import Path

from bridge.dead_man_file import write_dead_man
from pons.doctor import drive_checks
from pons.doctor.finding import HealthVerdict
from wire import RobotDescription

UGV = RobotDescription.model_validate({"drive": {"kind": "waveshare", "port": "/dev/x"}})


def test_a_drive_that_reports_often_costs_nothing(tmp_path: Path) -> None:
    found = drive_checks.drive(tmp_path, RobotDescription())
    assert found.verdict is HealthVerdict.OK
    assert found.found.en == "held after 80 ms without a state, or 100 ms without an answer"


def test_one_that_reports_seldom_is_said_to_cost_distance(tmp_path: Path) -> None:
    found = drive_checks.drive(tmp_path, UGV).found
    assert "held after 150 ms without a state, or 150 ms without an answer" in found.en
    assert "70 ms more lag" in found.en
    assert "70 毫秒" in found.zh


def test_a_base_that_nobody_has_tried_is_named_with_the_cure(tmp_path: Path) -> None:
    found = drive_checks.drive(tmp_path, UGV)
    assert found.verdict is HealthVerdict.WARN
    assert found.fix is not None
    assert "pons robot try" in found.fix.en
    write_dead_man(tmp_path, UGV, 0.31)
    tried = drive_checks.drive(tmp_path, UGV)
    assert tried.verdict is HealthVerdict.OK
    assert "after 0.31 s" in tried.found.en
