"""What was learnt is kept whole or not at all; what cannot be read is said and counts nothing."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from bridge.braking_file import UNREADABLE, BrakingKeeper, load_learnt, path_of, write_learnt
from bridge.core.state_motion import UNLEARNT, Learnt
from wire import RobotDescription

ROBOT = RobotDescription()
KNOWN = Learnt(lag_more_s=0.1, decel_share=0.6, lag_at_mps=0.5, share_at_mps=0.4, stops=12)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return path_of(tmp_path, ROBOT)


def test_nothing_is_known_where_nothing_was_kept(path: Path) -> None:
    assert load_learnt(path, ROBOT) == (UNLEARNT, None)


def test_what_is_written_is_read_again(path: Path) -> None:
    write_learnt(path, ROBOT, KNOWN)
    assert load_learnt(path, ROBOT) == (KNOWN, None)
    assert [file.name for file in path.parent.iterdir()] == [path.name], "nothing lies beside it"


def test_another_robot_toml_begins_anew(tmp_path: Path) -> None:
    write_learnt(path_of(tmp_path, ROBOT), ROBOT, KNOWN)
    changed = RobotDescription.model_validate({"drive": {"lag_s": 0.08}})
    assert load_learnt(path_of(tmp_path, changed), changed) == (UNLEARNT, None)


@pytest.mark.parametrize(
    "change",
    [
        {"decel_share": 1.5},
        {"lag_more_s": -0.1},
        {"lag_more_s": float("nan")},
        {"decel_share": 0.0},
        {"unknown": 1},
    ],
    ids=str,
)
def test_values_that_would_loosen_or_mean_nothing_are_refused(
    path: Path, change: dict[str, float], caplog: pytest.LogCaptureFixture
) -> None:
    write_learnt(path, ROBOT, KNOWN)
    kept = json.loads(path.read_text())
    kept["learnt"].update(change)
    path.write_text(json.dumps(kept))
    assert load_learnt(path, ROBOT) == (UNLEARNT, UNREADABLE)
    assert next(iter(change)) in caplog.text
    assert "robot.toml's values count" in caplog.text


@pytest.mark.parametrize("data", [b"", b"\xff\xfe", b"[]", b"{" * 9000, b" " * 20_000])
def test_bytes_that_are_no_such_file_are_refused(path: Path, data: bytes) -> None:
    path.parent.mkdir()
    path.write_bytes(data)
    assert load_learnt(path, ROBOT) == (UNLEARNT, UNREADABLE)


def test_a_file_of_another_robot_under_this_name_is_refused(path: Path) -> None:
    other = RobotDescription.model_validate({"id": "r2"})
    write_learnt(path, other, KNOWN)
    assert load_learnt(path, ROBOT) == (UNLEARNT, UNREADABLE)


def test_a_file_that_may_not_be_read_is_said(path: Path) -> None:
    path.mkdir(parents=True)
    assert load_learnt(path, ROBOT) == (UNLEARNT, UNREADABLE)


def test_the_keeper_writes_the_newest_when_it_changes(path: Path) -> None:
    keeper = BrakingKeeper(path, ROBOT, UNLEARNT)
    keeper.note(UNLEARNT)
    keeper.note(Learnt(lag_more_s=0.05, stops=1))
    keeper.note(KNOWN)
    assert keeper.close()
    assert load_learnt(path, ROBOT) == (KNOWN, None)


def test_a_keeper_told_nothing_new_writes_nothing(path: Path) -> None:
    keeper = BrakingKeeper(path, ROBOT, KNOWN)
    keeper.note(KNOWN)
    assert keeper.close()
    assert not path.exists()


def test_a_disk_that_refuses_is_said_and_the_keeper_goes_on(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "braking").write_text("no folder")
    keeper = BrakingKeeper(path_of(tmp_path, ROBOT), ROBOT, UNLEARNT)
    keeper.note(KNOWN)
    assert keeper.close()
    assert "braking_not_kept" in caplog.text
