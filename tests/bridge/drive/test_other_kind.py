"""A base of another kind on the port is not driven, and gives no state that anybody believes."""

from __future__ import annotations

from itertools import permutations

import pytest

from bridge.drive import SerialDrive
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from sim.twin.twin import FIRMWARES
from tests.pons.robot.twin_ports import BASES, BODY
from tools.lockstep.serial_line import SerialLine
from wire import DriveCommand, DriveState

TICK_S, SECONDS = 0.01, 12.0
"""Longer than the 2.5 s and 8 s for which bases are left alone after opening."""


@pytest.mark.parametrize(("told", "plugged"), list(permutations(sorted(BASES), 2)))
def test_a_base_of_another_kind_turns_no_wheel_and_says_no_state(told: str, plugged: str) -> None:
    line = SerialLine(3)
    robot = BASES[told]
    now_s = 100.0
    drive = SerialDrive(SERIAL_PROTOCOLS[told](robot, "b1"), line, "b1", lambda: now_s)
    firmware = FIRMWARES[plugged](BASES[plugged])
    seen: list[object] = []
    turned = False
    for seq in range(1, round(SECONDS / TICK_S)):
        now_s = 100.0 + seq * TICK_S
        command = DriveCommand(
            boot="b1", seq=seq, left_radps=3.0, right_radps=-2.5, enable=seq % 100 > 10
        )
        drive.write(command)
        firmware.hear(line.take_heard(), now_s)
        left, right, _ = firmware.motors(now_s)
        turned |= (left, right) != (0.0, 0.0)
        line.put(firmware.say(BODY, now_s))
        seen += [state for state in drive.read() if isinstance(state, DriveState)]
    assert seen == []
    assert not turned
