"""A voice moves the robot: from a recording to the place, and no further than was said."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.e2e.robot import Robot
from tests.planner.voice.speech import needs_espeak, speak

pytestmark = [pytest.mark.e2e, needs_espeak, pytest.mark.nightly(keep=1)]


def test_a_recording_becomes_a_drive(robot: Robot, tmp_path: Path) -> None:
    pytest.importorskip("pocketsphinx", reason="pocketsphinx has no wheel for this Python")
    place, began_s = robot.elsewhere(), time.monotonic()
    order = tmp_path / "order.wav"
    order.write_bytes(speak(f"go to the {place.name.en}"))
    done = robot.system.pons("say", "--wav", str(order))
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert f"heard 'go to the {place.name.en}'" in done.stdout
    robot.assert_there(place)
    robot.assert_figures(robot.system.goals()[0], place, began_s)


def test_chatter_moves_nothing(robot: Robot, tmp_path: Path) -> None:
    pytest.importorskip("pocketsphinx", reason="pocketsphinx has no wheel for this Python")
    before, began_s = len(robot.system.goals()), time.monotonic()
    chatter = tmp_path / "chatter.wav"
    chatter.write_bytes(speak("what a nice day it is", "en-us"))
    done = robot.system.pons("say", "--wav", str(chatter))
    assert done.returncode == 3, (done.stdout, done.stderr)
    assert "I begin nothing new" in done.stdout
    assert len(robot.system.goals()) == before
    assert robot.judge.path_m(began_s) < 0.02


def test_a_file_that_is_no_recording_is_refused_by_name(robot: Robot, tmp_path: Path) -> None:
    wrong = tmp_path / "song.ogg"
    wrong.write_bytes(b"OggS" + bytes(1000))
    done = robot.system.pons("say", "--wav", str(wrong))
    assert done.returncode != 0
    assert "not_wav" in done.stderr
    assert "Ogg" in done.stderr
    missing = robot.system.pons("say", "--wav", str(tmp_path / "none.wav"))
    assert missing.stderr.startswith("unreadable_file: ")
    assert "check its path" in missing.stderr
