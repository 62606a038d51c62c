"""A UGV base is told its heartbeat before anything else, and believed no more than it says."""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.drive.waveshare import BoundedPath, WaveshareProtocol
from devices.waveshare import encode_settings
from wire import DriveCommand, DriveState, RobotDescription

ROBOT = RobotDescription.model_validate({
    "base": {"wheel_radius_m": 0.04, "wheel_separation_m": 0.172, "radius_m": 0.18},
    "limits": {"max_speed_mps": 0.4, "max_wheel_radps": 15.0},
    "drive": {
        "kind": "waveshare", "port": "/dev/x", "timeout_s": 0.2,
        "battery_empty_v": 9.6, "battery_full_v": 12.6,
    },
})  # fmt: skip
HEARTBEAT = b'{"T":136,"cmd":200}\n'


def command(seq: int = 8, speed: float = 5.0, *, enable: bool = True) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=speed, right_radps=-speed, enable=enable)


def report(left_cm: Any = 0, right_cm: Any = 0, **more: Any) -> bytes:
    said = {"T": 1001, "L": 0.1, "R": 0.2, "odl": left_cm, "odr": right_cm, "v": 1110, **more}
    return json.dumps({key: value for key, value in said.items() if value is not None}).encode() + (
        b"\r\n"
    )


def speeds(data: bytes) -> list[dict[str, Any]]:
    return [said for said in map(json.loads, data.splitlines()) if said["T"] == 1]


def begun() -> WaveshareProtocol:
    protocol = WaveshareProtocol(ROBOT, "b1")
    assert protocol.begin() == encode_settings(200)
    protocol.encode(command(seq=1))
    assert protocol.decode(HEARTBEAT, 0.9) == []
    return protocol


def one(protocol: WaveshareProtocol, data: bytes, now_s: float) -> DriveState:
    (state,) = protocol.decode(data, now_s)
    return state


def test_nothing_is_passed_on_before_the_heartbeat_is_printed_back(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = WaveshareProtocol(ROBOT, "b1")
    protocol.begin()
    for k in range(100):
        assert protocol.decode(report(), 1.0 + 0.05 * k) == []
    assert caplog.text.count("base_not_set") == 1
    assert protocol.decode(b'{"T":136,"cmd":3000}\n' + report(), 6.1) == [], "another's heartbeat"
    assert len(protocol.decode(HEARTBEAT + report(), 6.2)) == 1


def test_a_state_says_what_the_base_says_and_no_more() -> None:
    state = one(begun(), report(100, -100), 1.0)
    assert (state.left_rad, state.right_rad) == pytest.approx((25.0, -25.0))
    assert (state.left_radps, state.right_radps) == pytest.approx((2.5, 5.0))
    assert state.timed_out is None
    assert state.battery == pytest.approx(0.5)
    assert (state.estop_pressed, state.bumper_front, state.cliff) == (False, False, False)
    assert 0.97 < state.stamp_s < 1.0, "its bytes took their time to come"


def test_settings_are_sent_again_every_second() -> None:
    protocol = begun()
    sent = [protocol.encode(command(seq=k)) for k in range(2, 402)]
    assert [HEARTBEAT in data for data in sent].count(True) == 4


def test_every_second_command_is_sent_and_each_that_stops() -> None:
    protocol = begun()
    assert [len(speeds(protocol.encode(command(seq)))) for seq in (2, 3, 4, 5)] == [1, 0, 1, 0]
    assert speeds(protocol.encode(command(7, 0.0)))[0]["L"] == 0.0
    assert speeds(protocol.encode(command(9, 0.0))) == []
    protocol.encode(command(10))
    assert speeds(protocol.encode(command(11, enable=False)))[0]["L"] == 0.0


@given(st.floats(-1000.0, 1000.0), st.floats(-1000.0, 1000.0))
def test_no_command_is_so_fast_that_the_base_ignores_it(left: float, right: float) -> None:
    asked = command().model_copy(update={"left_radps": left, "right_radps": right})
    (said,) = speeds(begun().encode(asked))
    assert max(abs(said["L"]), abs(said["R"])) <= 2.0
    most = max(abs(left), abs(right)) * 0.04
    share = 1.0 if most <= 2.0 else 2.0 / most
    assert said["L"] == pytest.approx(left * 0.04 * share, abs=1e-4)
    assert said["R"] == pytest.approx(right * 0.04 * share, abs=1e-4)


def test_the_echo_names_this_bridge_another_or_none() -> None:
    protocol = begun()
    assert one(protocol, report(), 1.0).echo_boot is None
    state = one(protocol, protocol.encode(command(12)) + report(), 1.05)
    assert (state.echo_boot, state.echo_seq, state.enabled) == ("b1", 12, True)
    other = b'{"T":1,"L":0.0,"R":0.0,"s":"zzzz-99-0"}\n'
    state = one(protocol, other + report(), 1.1)
    assert (state.echo_boot, state.echo_seq, state.enabled) == ("other-zzzz", 99, False)
    for tag in (
        "", "a", "abcd-b-1", "abcd-1-2", "abcd-1", f"abcd-{'9' * 16}-1", "abcd-\u0663-1",
        "ab d-1-1", "停停停停-1-1", "abcde-1-1", "-1-1",
    ):  # fmt: skip
        odd = json.dumps({"T": 1, "L": 0.0, "R": 0.0, "s": tag}).encode() + b"\n"
        assert one(protocol, odd + report(), 1.1).echo_seq == 99


@pytest.mark.parametrize(("old", "new"), [(b"0.2", b"0.9"), (b"-0.2", b"0.2"), (b"-12-", b"-14-")])
def test_a_command_that_was_misread_is_no_echo(
    old: bytes, new: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    protocol = begun()
    line = protocol.encode(command(12))
    assert old in line
    assert one(protocol, line.replace(old, new, 1) + report(), 1.0).echo_boot is None
    assert "base_misread" in caplog.text
    assert one(protocol, line + report(), 1.05).echo_seq == 12


@pytest.mark.parametrize(
    ("ways", "code"),
    [((None, None), "base_no_encoders"), ((1, None), "base_no_encoders"),
     ((0.25, 0.5), "base_firmware_old")],
)  # fmt: skip
def test_a_base_that_can_not_be_measured_is_refused_once_with_its_cure(
    ways: tuple[Any, Any], code: str, caplog: pytest.LogCaptureFixture
) -> None:
    protocol = begun()
    for k in range(9):
        assert protocol.decode(report(*ways), 1.0 + 0.05 * k) == []
    assert caplog.text.count(code) == 1
    assert protocol.trouble == code
    assert len(protocol.decode(report(), 1.5)) == 1
    assert protocol.trouble is None


def test_a_spoilt_way_is_left_out_and_a_lasting_one_is_a_reset(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = begun()
    before = one(protocol, report(500, 500), 1.0)
    assert protocol.decode(report(900, 500), 1.05) == []
    assert one(protocol, report(501, 501), 1.1).boot_id == before.boot_id
    assert "base_reset" not in caplog.text
    assert protocol.decode(report(0, 0), 1.15) == []
    assert protocol.decode(report(0, 0), 1.2) == [], "its heartbeat is 3 s again"
    assert "base_reset" in caplog.text
    assert HEARTBEAT in protocol.encode(command(20)), "at once"
    after = one(protocol, HEARTBEAT + report(0, 0), 1.25)
    assert after.boot_id != before.boot_id
    assert after.left_rad == 0.0
    assert after.seq > before.seq
    assert after.echo_boot is None


def test_a_spoilt_line_that_was_believed_is_not_called_a_reset(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = begun()
    one(protocol, report(900, 500), 1.0)
    assert protocol.decode(report(500, 500), 1.05) == []
    assert protocol.decode(report(500, 500), 1.1) == [], "counted anew"
    assert "base_spoilt" in caplog.text
    assert "base_reset" not in caplog.text
    assert protocol.decode(b"{spoilt\n" * 3, 1.15) == []
    assert protocol.spoilt == 3


@pytest.mark.parametrize("spoilt", [{"L": 2.1}, {"R": 0.7}, {"L": -0.7}, {"L": 3.1, "R": 3.2}])
@pytest.mark.parametrize("gap_s", [0.05, 1.0], ids=str)
def test_a_spoilt_speed_is_left_out(spoilt: dict[str, float], gap_s: float) -> None:
    protocol = begun()
    for k in range(3):
        one(protocol, report(k), 1.0 + 0.05 * k)
    at_s = 1.1 + gap_s
    assert protocol.decode(report(3, **spoilt), at_s) == []
    assert one(protocol, report(4), at_s + 0.05).left_radps == pytest.approx(2.5)


def test_a_wheel_that_runs_away_is_told_one_report_later_and_is_no_reset(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = begun()
    boot = one(protocol, report(0), 1.0).boot_id
    assert protocol.decode(report(4, L=1.3), 1.05) == []
    state = one(protocol, report(10, L=1.4), 1.1)
    assert state.left_radps == pytest.approx(35.0)
    assert state.boot_id == boot
    assert one(protocol, report(17, L=1.4), 1.15).left_radps == pytest.approx(35.0)
    assert "base_reset" not in caplog.text


def test_a_wheel_that_speeds_up_as_wheels_do_is_told_at_once() -> None:
    protocol = begun()
    for k in range(9):  # 5 m/s2, as no base of this class
        mps = round(0.25 * k, 3)
        one(protocol, report(k, L=mps, R=mps), 1.0 + 0.05 * k)


@pytest.mark.parametrize("said", [b"UGV started.\r\n", b"Device connected!\r\n"])
def test_a_base_that_says_it_starts_is_reset(said: bytes, caplog: pytest.LogCaptureFixture) -> None:
    protocol = begun()
    before = one(protocol, report(), 1.0)
    assert protocol.decode(said + report(), 1.05) == []
    assert "base_reset" in caplog.text
    assert one(protocol, HEARTBEAT + report(), 1.1).boot_id != before.boot_id


def test_after_a_long_silence_it_is_another(caplog: pytest.LogCaptureFixture) -> None:
    protocol = begun()
    before = one(protocol, report(), 1.0)
    assert one(protocol, report(), 1.9).boot_id == before.boot_id
    assert protocol.decode(report(), 3.0) == []
    assert "silent for 1.1 s" in caplog.text


def test_other_words_are_nobodys_start() -> None:
    protocol = begun()
    assert len(protocol.decode(b"file not found.\r\n" + report(), 1.0)) == 1


@given(
    st.lists(st.floats(-2.0, 2.0), min_size=2, max_size=200),
    st.floats(-1.0, 1.0),
    st.sampled_from(["cut off", "rounded"]),
)
def test_a_way_is_never_more_than_two_centimetres_wrong(
    lies_mps: list[float], true_mps: float, habit: str
) -> None:
    """Whatever the speeds say between: the base counts."""
    path = BoundedPath()
    for k, mps in enumerate(lies_mps):
        true_m = true_mps * 0.05 * k
        cm = int(true_m * 100) if habit == "cut off" else round(true_m * 100)
        assert abs(path.advance(mps, cm, 0.05 * k) - true_m) <= 0.02 + 1e-9


def test_between_its_centimetres_a_way_follows_the_speed() -> None:
    path = BoundedPath()
    at = [path.advance(0.1, int(0.5 * k), 0.05 * k) for k in range(9)]
    assert [b - a for a, b in pairwise(at)] == pytest.approx([0.005] * 8)
