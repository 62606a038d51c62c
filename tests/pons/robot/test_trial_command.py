"""``pons robot try`` turns nothing unasked, writes what was proved, and says how to mend it."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from devices import PORT_CURES
from pons.__main__ import main
from pons.robot.trial_command import refusal_lines
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import set_trial
from pons.robot.trial_words import PROMPTS, REFUSALS
from tests.conftest import ROOT
from tests.known import known
from tests.pons.robot.stand import Stand, alive
from wire import load_robot
from wire.trial_record import TrialRecord

RECORD = TrialRecord(date="2026-11-24", wiring="0" * 16, dead_man_s=0.27, brake_s=0.05)
TEXT = (ROOT / "robots" / "pons_mcu.toml").read_text("utf-8")


def test_a_trial_is_set_below_all_else_and_replaces_the_one_before() -> None:
    once = set_trial(TEXT, RECORD)
    again = set_trial(once, RECORD.model_copy(update={"dead_man_s": 0.3}))
    assert once.startswith(TEXT.rstrip())
    assert again.count("[trial]") == 1
    assert "dead_man_s = 0.3\n" in again
    assert set_trial(again, RECORD) == once


def test_a_trial_in_the_middle_leaves_what_follows(tmp_path: Path) -> None:
    text = '[trial] # old\ndate = "2020-01-01"\n\n[base]\nradius_m = 0.3\n'
    path = tmp_path / "robot.toml"
    path.write_text(set_trial(text, RECORD))
    robot = load_robot(path)
    assert robot.base.radius_m == 0.3
    assert robot.trial == RECORD


@pytest.mark.parametrize("words", [*PROMPTS.values(), *REFUSALS.values()])
def test_all_is_said_in_both_languages(words: tuple[str, str]) -> None:
    english, chinese = words
    assert english.isascii() or "×" in english
    assert any(ord(letter) > 0x2E80 for letter in chinese)


@pytest.mark.parametrize("code", REFUSALS)
def test_a_refusal_says_what_came_and_that_nothing_was_written(code: str) -> None:
    lines = refusal_lines(TrialRefusal(code, "left +1"))
    assert lines[0] == f"{code} (left +1)"
    assert lines[-1] == "nothing was written"


def robot_at(folder: Path, port: Path) -> Path:
    path = folder / "robot.toml"
    path.write_text(TEXT.replace("/dev/ttyACM0", str(port)))
    return path


def test_a_simulated_drive_needs_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "robot.toml"
    path.write_text('id = "r1"\n')
    assert main(["robot", "try", "--robot", str(path)]) == 3
    said = capsys.readouterr().err
    assert f"trial_virtual ({path}: drive.kind is left out, and so 'sim')" in said
    assert "--robot" in said


def test_a_file_that_lost_its_base_is_refused_before_anybody_lifts_anything(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = robot_at(tmp_path, tmp_path / "no")
    whole = path.read_text()
    path.write_text(whole.replace("wheel_radius_m", "# wheel_radius_m"))
    assert main(["robot", "try", "--robot", str(path)]) == 3
    said = capsys.readouterr()
    assert f"trial_base ({path} lacks base.wheel_radius_m)" in said.err
    assert said.out == ""
    path.write_text(whole[whole.index("[drive]") :])
    assert main(["robot", "try", "--robot", str(path)]) == 3
    assert "base.wheel_separation_m, base.radius_m" in capsys.readouterr().err


def test_a_port_that_is_none_is_told_by_its_own_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with typed(monkeypatch, "UP\n"):
        assert main(["robot", "try", "--robot", str(robot_at(tmp_path, Path(os.devnull)))]) == 3
    code, english, last = capsys.readouterr().err.splitlines()
    assert code == "port_not_serial (drive.port /dev/null: not a terminal device)"
    assert english.strip() == PORT_CURES["port_not_serial"][0]
    assert last == "nothing was written"


def test_every_question_ends_with_the_terminals_own_enter() -> None:
    """A page asks the same, and has a button."""
    for english, chinese in PROMPTS.values():
        assert "Enter" not in english
        assert "回车" not in chinese


def test_without_the_word_nothing_is_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with typed(monkeypatch, "yes\n"):
        assert main(["robot", "try", "--robot", str(robot_at(tmp_path, tmp_path / "no"))]) == 3
    assert "not_lifted" in capsys.readouterr().err


def test_a_terminal_that_goes_is_an_interrupt(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with typed(monkeypatch, ""):
        assert main(["robot", "try", "--robot", str(robot_at(tmp_path, tmp_path / "no"))]) == 130
    assert "nothing was written" in capsys.readouterr().err


@contextmanager
def typed(monkeypatch: pytest.MonkeyPatch, text: str) -> Iterator[int]:
    """Be a terminal on which this was typed; yield where more can be."""
    reading, writing = os.pipe()
    with os.fdopen(reading, "r") as stdin:
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(stdin.buffer, write_through=True))
        os.write(writing, text.encode())
        if not text:
            os.close(writing)
        yield writing
        if text:
            os.close(writing)


@pytest.mark.e2e
def test_a_person_tries_a_base_and_the_bridge_may_then_drive_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """At a real line, in real time: about half a minute."""
    link = tmp_path / "base"
    path = robot_at(tmp_path, link)
    assert load_robot(path).valid_trial is None
    stand = Stand(load_robot(path))
    turns, ask_s = ["hand_left", "hand_right"], time.monotonic() + 4.0
    with typed(monkeypatch, "UP\n") as terminal:

        def turn_when_asked() -> None:
            nonlocal ask_s
            if turns and time.monotonic() >= ask_s and stand.has_answered():
                stand.ask(turns.pop(0))
                ask_s = time.monotonic() + 4.0
                threading.Timer(3.0, os.write, (terminal, b"\n")).start()

        with alive(stand, link, turn_when_asked):
            assert main(["robot", "try", "--robot", str(path)]) == 0, capsys.readouterr().err
    trial = known(load_robot(path).valid_trial)
    assert 0.2 <= trial.dead_man_s <= 0.5
    moved = load_robot(path).model_copy(
        update={"drive": load_robot(path).drive.model_copy(update={"ticks_per_turn": 99})}
    )
    assert moved.valid_trial is None


def test_no_drivers_log_stands_in_a_persons_terminal(tmp_path: Path) -> None:
    """In a process of its own: a test's has handlers, which hide what logging does without any."""
    robot = robot_at(tmp_path, tmp_path / "no")
    words = [sys.executable, "-m", "pons", "robot", "try", "--robot", str(robot)]
    done = subprocess.run(
        words, input="UP\n", capture_output=True, text=True, timeout=60, cwd=ROOT, check=False
    )
    assert done.returncode == 3
    assert done.stderr.startswith("trial_port (port_missing: ")
    assert done.stderr.count("port_missing") == 1
