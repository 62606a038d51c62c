"""The twin of an Arduino answers in order, and stops two seconds late as the real one does."""

from __future__ import annotations

from math import tau
from typing import cast

import pytest

from sim.twin.arduino import AUTO_STOP_S, LOADING_S, ArduinoFirmware
from tests.wire.examples import EXAMPLES
from wire import DriveState, RobotDescription

ROBOT = RobotDescription.model_validate(
    {"drive": {"kind": "arduino", "port": "/dev/x", "ticks_per_turn": 1000}}
)
BODY = cast("DriveState", EXAMPLES[DriveState])


def loaded() -> ArduinoFirmware:
    made = ArduinoFirmware(ROBOT)
    made.hear(b"m 9 9\r", 0.0)
    assert made.say(BODY, 0.0) == b"", "it loads"
    made.hear(b"", LOADING_S)
    return made


def test_it_drives_by_ticks_a_frame() -> None:
    base = loaded()
    base.hear(b"m 10 -5\r", 2.0)
    assert base.motors(2.0) == pytest.approx((0.3 * tau, -0.15 * tau, True))
    assert base.say(BODY, 2.0) == b"OK\r\n"


@pytest.mark.parametrize(
    ("line", "ticks"),
    [(b"m 12x 7", (12, 7)), (b"m -3", (-3, 0)), (b"m", (0, 0)), (b"m 40000 0", (-25536, 0)),
     (b"m 1 2 3", (1, 2))],
)  # fmt: skip
def test_it_reads_numbers_as_c_does(line: bytes, ticks: tuple[int, int]) -> None:
    base = loaded()
    base.hear(line + b"\r", 2.0)
    left, right, _ = base.motors(2.0)
    assert (left, right) == pytest.approx([30.0 * tau / 1000 * each for each in ticks])


def test_it_stops_by_itself_after_two_seconds() -> None:
    base = loaded()
    base.hear(b"m 10 10\re\r", 2.0)
    assert base.motors(2.0 + AUTO_STOP_S)[2]
    assert base.motors(2.01 + AUTO_STOP_S) == (0.0, 0.0, False)


def test_it_counts_from_its_start_and_knows_its_letters() -> None:
    base = loaded()
    turned = BODY.model_copy(
        update={"left_rad": BODY.left_rad + tau, "right_rad": BODY.right_rad - 0.001}
    )
    base.say(BODY, 2.0)
    base.say(turned, 2.0)
    base.hear(b"e\rb\rq\r\r", 2.0)
    assert base.say(turned, 2.0) == b"1000 -1\r\n57600\r\nInvalid Command\r\nInvalid Command\r\n"
