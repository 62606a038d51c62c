"""The command line refuses what can't be right: clear words, a stable exit status."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons import bridge_client
from pons.__main__ import main

REFUSED = 2
NO_PLANNER = 6


@pytest.fixture(autouse=True)
def nowhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, free_port: int) -> None:
    """Let every command look for a robot where there is none."""
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "home"))
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    monkeypatch.setenv("PONS_PORT", str(free_port))
    monkeypatch.setattr(
        bridge_client, "LIMIT_S", 0.1
    )  # no bridge will answer, however long one waits


def test_a_home_that_cannot_be_written_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("PONS_HOME", str(tmp_path / "file"))
    assert main(["up"]) == REFUSED
    said = capsys.readouterr().err
    assert "home_unwritable" in said
    assert str(tmp_path / "file") in said
    assert "PONS_HOME" in said


@pytest.mark.parametrize(
    ("table", "line", "named"),
    [
        ("limits", "max_sped_mps = 0.5", ("unknown", "max_sped_mps")),
        ("limits", "max_speed_mps = 50.0", ("max_speed_mps", "50")),
        ("wheels", "many = 4", ("wheels",)),
        ("limits", "max_speed_mps = = 1", ("robot.toml",)),
    ],
)
def test_up_names_what_is_wrong_with_the_robot_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], table: str, line: str, named: tuple[str]
) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text(f"[{table}]\n{line}\n")
    assert main(["up", "--robot", str(robot)]) == REFUSED
    said = capsys.readouterr().err
    assert any(ord(letter) > 0x2E80 for letter in said)
    for word in ("robot.toml", *named):
        assert word in said, said


def test_up_names_a_robot_file_that_is_not_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["up", "--robot", str(tmp_path / "none.toml")]) == REFUSED
    assert "none.toml" in capsys.readouterr().err


@pytest.mark.parametrize("port", ["0", "70000", "http", "-1", ""])
def test_a_port_that_is_none_is_named(
    port: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_PORT", port)
    assert main(["status"]) == REFUSED
    said = capsys.readouterr().err
    assert "bad_port" in said
    assert repr(port) in said


def test_words_nobody_knows_are_named(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["dance"])
    assert ended.value.code == REFUSED
    assert "dance" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [["say", "go to the kitchen"], ["status"], ["pause"], ["resume"], ["cancel", "x"],
     ["answer", "yes"], ["answer", "g1", "yes"], ["confirm"]],
)  # fmt: skip
def test_without_a_planner_each_command_says_so(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == NO_PLANNER
    assert "pons up" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["fault"], ["robot", "mount"], ["robot", "try"], ["calibrate"]])
def test_no_command_ends_in_a_traceback_for_half_a_robot_file(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text('[drive]\nkind = "pons_mcu"\nport = "/dev/tt')
    monkeypatch.setenv("PONS_ROBOT", str(robot))
    assert main(words) in (REFUSED, 3)
    said = capsys.readouterr().err
    assert "robot_toml_syntax" in said
    assert "breaks off in line 3" in said
    assert any(ord(letter) > 0x2E80 for letter in said)
