"""The twin of a UGV base is as stubborn as the base: it forgets, ignores, and stops unasked."""

from __future__ import annotations

import json
from typing import Any, cast

import pytest

from sim.twin.waveshare import START_S, WaveshareFirmware
from tests.wire.examples import EXAMPLES
from wire import DriveState, RobotDescription

ROBOT = RobotDescription.model_validate({
    "base": {"wheel_radius_m": 0.04},
    "limits": {"max_speed_mps": 0.4},
    "drive": {"kind": "waveshare", "port": "/dev/x"},
})  # fmt: skip
BODY = cast("DriveState", EXAMPLES[DriveState])
GO = b'{"T":1,"L":0.2,"R":-0.1,"s":"x"}\n'
STILL = (0.0, 0.0, False)


def started() -> WaveshareFirmware:
    made = WaveshareFirmware(ROBOT)
    made.hear(b"", 0.0)
    assert b"Device connected!" in made.say(BODY, 0.0)
    made.hear(b"", START_S)
    assert made.say(BODY, START_S).startswith(b"UGV started.")
    return made


def reports(data: bytes) -> list[dict[str, Any]]:
    return [json.loads(line) for line in data.splitlines() if b'"T":1001' in line]


def test_while_it_starts_it_hears_nothing_and_counts_nothing() -> None:
    new = WaveshareFirmware(ROBOT)
    new.hear(GO, 0.0)
    assert new.motors(0.0) == STILL
    assert not reports(new.say(BODY, START_S - 0.01))


def test_it_drives_by_metres_a_second() -> None:
    base = started()
    base.hear(GO, 2.0)
    assert base.motors(2.0) == pytest.approx((5.0, -2.5, True))


@pytest.mark.parametrize(
    "line",
    [b'{"T":1,"L":"0.2","R":0.1}\n', b'{"T":1,"L":0.2}\n', b"[]\n", b"{\n", b'{"T":13,"X":0.2}\n',
     b'{"T":1,"L":2.1,"R":0.0}\n'],
)  # fmt: skip
def test_what_is_no_command_moves_nothing(line: bytes) -> None:
    base = started()
    base.hear(line, 2.0)
    assert base.motors(2.0) == STILL


@pytest.mark.parametrize(("said", "alive_s"), [(b"", 3.0), (b'{"T":136,"cmd":200}\n', 0.2)])
def test_it_stops_once_after_its_heartbeat_and_tells_nobody(said: bytes, alive_s: float) -> None:
    base = started()
    base.hear(said + GO, 2.0)
    assert base.motors(2.0 + alive_s - 0.01)[2]
    assert base.motors(2.0 + alive_s + 0.01) == STILL
    assert "timed_out" not in base.say(BODY, 9.0).decode()
    base.hear(GO, 10.0)
    assert base.motors(10.0)[2]


def test_it_prints_back_what_it_reads_once_told_to() -> None:
    base = started()
    base.hear(GO, 2.0)
    assert GO not in base.say(BODY, 2.0)
    base.hear(b'{"T":143,"cmd":1}\n' + GO, 2.01)
    assert GO in base.say(BODY, 2.01)
    base.hear(b'{"T":605,"cmd":0}\n' + GO, 2.02)
    assert GO not in base.say(BODY, 2.02)


def test_it_counts_whole_centimetres_from_its_start_twenty_times_a_second() -> None:
    base = started()
    seen = [
        one
        for k in range(100)
        for one in reports(
            base.say(BODY.model_copy(update={"left_rad": BODY.left_rad + 0.1 * k}), 2 + 0.01 * k)
        )
    ]
    assert len(seen) == 20
    assert {type(one["odl"]) for one in seen} == {int}
    assert seen[-1]["odl"] == int(0.1 * 95 * 4)
    assert seen[-1]["odr"] == 0
    assert seen[-1]["v"] > 900


def test_reports_can_be_switched_off_and_made_rarer() -> None:
    base = started()
    base.hear(b'{"T":142,"cmd":-50}\n', 2.0)
    assert sum(len(reports(base.say(BODY, 2 + 0.01 * k))) for k in range(100)) == 10
    base.hear(b'{"T":131,"cmd":0}\n', 3.0)
    assert not reports(base.say(BODY, 9.0))
