"""A trial of a shipped preset can be gone through on the stand, hands and all."""

from __future__ import annotations

import pytest

from pons.robot.gyro_trial import BaseGyroSource, try_gyro
from pons.robot.trial_parties import TrialRefusal
from sim.twin.stand import HANDS, WRONG, Wires, read_hands
from tests.conftest import ROOT
from tests.pons.robot.stand import Stand
from wire import load_robot

GYROS = ("waveshare_ugv_rover", "waveshare_rasprover", "waveshare_ugv_beast", "turtlebot3_burger")
"""Presets whose base brings a gyro."""


def turned(name: str, wires: Wires) -> float:
    robot = load_robot(ROOT / "robots" / f"{name}.toml")
    stand = Stand(robot, wires)
    for _ in range(400):  # until its heartbeat is set
        stand.command_zero()
        stand.drive.read()
        stand.wait()
    return try_gyro(robot.imu, BaseGyroSource(stand.drive), stand, stand)


@pytest.mark.parametrize("name", GYROS)
def test_a_quarter_by_hand_is_felt_by_the_presets_gyro(name: str) -> None:
    assert turned(name, Wires()) == pytest.approx(1.57, abs=0.12)


def test_a_gyro_that_hangs_upside_down_is_named() -> None:
    with pytest.raises(TrialRefusal) as told:
        turned(GYROS[0], Wires(**WRONG["gyro_reversed"]))
    assert told.value.code in ("gyro_backwards", "gyro_axis")


def test_hands_read_words_and_tell_what_they_do_not_know(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert read_hands("left\nright -2\nquarter\nfront\n\n") == [
        ("left", 3.0), ("right", -2.0), ("quarter", 3.0), ("front", 3.0),
    ]  # fmt: skip
    assert capsys.readouterr().err == ""
    for wrong in ("jump", "left x", "left nan", "left 1e9", "quarter a lot"):
        assert read_hands(wrong) == []
        assert f"hands know {', '.join(HANDS)}" in capsys.readouterr().err
