"""The doctor says what is wrong with a base's port, and what its silence costs."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from devices import SerialPort
from devices.port_listing import describe_port
from pons.doctor import drive_checks
from pons.doctor.finding import HealthVerdict
from pons.robot.command import describe_code
from sim.twin.line import TwinLine
from tests.known import known
from tests.pons.doctor.speaking import speaking
from tests.wire.examples import EXAMPLES
from wire import Action, RobotDescription, RowReport, Status, keys
from wire.drive_config import DRIVE_KINDS, DriveKind
from wire.keys import Party
from wire.trial_record import TrialRecord, wiring_of


def test_a_drive_that_reports_often_costs_nothing(tmp_path: Path) -> None:
    found = drive_checks.drive(tmp_path, RobotDescription()).found
    assert found.en == "held after 80 ms without a state, or 100 ms without an answer"


def test_one_that_reports_seldom_is_said_to_cost_distance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(dict_of_kinds(), "sim", DriveKind((), (), 0.06))
    found = drive_checks.drive(tmp_path, RobotDescription()).found
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


@pytest.fixture
def line(tmp_path: Path) -> Iterator[Path]:
    """Yield a line at whose far end nobody speaks."""
    twin = TwinLine(tmp_path / "line")
    yield tmp_path / "line"
    twin.close()


def at(port: Path) -> RobotDescription:
    drive = {"kind": "pons_mcu", "port": str(port), "ticks_per_turn": 400}
    return RobotDescription.model_validate({"drive": drive})


def test_a_port_that_can_be_opened_is_well_and_is_left_alone(tmp_path: Path, line: Path) -> None:
    with SerialPort(line, 115_200):
        pass
    assert drive_checks.drive(tmp_path, at(line)).verdict is HealthVerdict.OK


def test_a_port_that_is_not_there_or_none_is_named_with_its_cure(tmp_path: Path) -> None:
    plain = tmp_path / "file"
    plain.touch()
    for port, code in ((tmp_path / "none", "port_missing"), (plain, "port_not_serial")):
        found = drive_checks.drive(tmp_path, at(port))
        assert found.verdict is HealthVerdict.FAIL
        assert found.found.en.startswith(f"{code}: drive.port {port}")
        assert any(ord(letter) > 0x2E80 for letter in known(found.fix).zh)


def test_who_holds_the_port_is_named_unless_it_is_our_own_bridge(
    tmp_path: Path, line: Path
) -> None:
    with SerialPort(line, 115_200):
        held = drive_checks.drive(tmp_path, at(line))
    assert held.found.en.startswith("port_busy: ")
    assert f"(pid {os.getpid()})" in held.found.en


def test_a_port_that_one_may_not_open_is_named_with_its_group(
    tmp_path: Path, line: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.access", lambda *_, **__: False)
    found = drive_checks.drive(tmp_path, at(line))
    assert found.found.en == f"port_forbidden: drive.port {line}"
    cure = describe_code("port_forbidden", describe_port(line).group)
    assert (known(found.fix).en, known(found.fix).zh) == cure


@pytest.mark.parametrize("silent", ["ENC_STALE", "drive", ""])
def test_a_running_bridge_is_asked_whether_it_hears_the_base(
    tmp_path: Path, line: Path, silent: str
) -> None:
    status = EXAMPLES[Status]
    assert isinstance(status, Status)
    row = RowReport(row="ENC_STALE", action=Action.HOLD2, for_s=1.0, evidence="1 s", binding=True)
    up: dict[str, dict[str, object]] = {
        "ENC_STALE": {"rows": (row,)},
        "drive": {"waiting_for": ("lidar", "drive")},
    }
    none: dict[str, object] = {"robot": "r1", "rows": (), "waiting_for": ("lidar",)}
    said = status.model_copy(update=none | up.get(silent, {}))
    with speaking(Party.BRIDGE, tmp_path, (keys.STATUS, said)):
        found = drive_checks.drive(tmp_path, at(line))
        with SerialPort(line, 115_200):  # by this program, which is no bridge
            held = drive_checks.drive(tmp_path, at(line))
        gone = drive_checks.drive(tmp_path, at(tmp_path / "none"))
    assert found.verdict is (HealthVerdict.FAIL if silent else HealthVerdict.OK)
    assert found.found.en.startswith("base_silent: the bridge gets no state" if silent else "held")
    assert held.found.en.startswith("port_busy" if silent else "held")
    # Where it hears, the port is a twin's.
    assert gone.found.en.startswith("port_missing" if silent else "held")
