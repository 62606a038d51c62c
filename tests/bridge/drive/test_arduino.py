"""Answers without numbers are matched by their order, and by nothing where the order is lost."""

from __future__ import annotations

from math import tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.drive.arduino import BOOT_TICKS, MOST_ASKED, ArduinoProtocol
from wire import DriveCommand, DriveState, RobotDescription

ROBOT = RobotDescription.model_validate(
    {"drive": {"kind": "arduino", "port": "/dev/x", "ticks_per_turn": 1000}}
)


def command(seq: int, speed: float = tau, *, enable: bool = True) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=speed, right_radps=-speed, enable=enable)


def answer(left: int = 0, right: int = 0) -> bytes:
    return b"OK\r\n%d %d\r\n" % (left, right)


class Line:
    """Step a protocol by ticks, with an Arduino that answers when it is asked to."""

    def __init__(self) -> None:
        self.protocol = ArduinoProtocol(ROBOT, "b1")
        self.seq, self.now_s = 1, 10.0
        assert self.protocol.begin() == b""
        for _ in range(BOOT_TICKS):
            self.tick()

    def tick(self, speed: float = tau, *, enable: bool = True) -> bytes:
        self.seq, self.now_s = self.seq + 1, self.now_s + 0.01
        return self.protocol.encode(command(self.seq, speed, enable=enable))

    def hear(self, data: bytes) -> list[DriveState]:
        return self.protocol.decode(data, self.now_s)

    def ask(self) -> bytes:
        """Run until a command goes out."""
        for _ in range(20):
            sent = self.tick()
            if sent:
                return sent
        raise AssertionError("it asks nothing")

    def state(self, left: int = 0, right: int = 0) -> DriveState:
        self.ask()
        (state,) = self.hear(answer(left, right))
        return state


def test_a_base_that_loads_is_left_alone() -> None:
    protocol = ArduinoProtocol(ROBOT, "b1")
    protocol.begin()
    sent = [protocol.encode(command(seq)) for seq in range(BOOT_TICKS + 4)]
    assert not any(sent[: BOOT_TICKS - 1])
    assert any(sent[BOOT_TICKS - 1 :])


def test_a_command_is_told_in_ticks_a_frame_every_second_time() -> None:
    line = Line()
    assert line.ask() == b"m 33 -33\re\r", "1000 ticks a second in 30 frames"
    assert line.tick() == b""
    assert line.tick(0.0)[:2] == b"m "


def test_the_oldest_question_is_the_one_that_is_answered() -> None:
    line = Line()
    line.ask()
    first = line.seq
    line.ask()
    (state,) = line.hear(answer(10, 20))
    assert (state.echo_boot, state.echo_seq, state.enabled) == ("b1", first, True)
    (state,) = line.hear(answer(11, 21))
    assert state.echo_seq == first + 2
    assert line.hear(answer(12, 22)) == [], "nobody asked"


def test_counts_become_angles_and_speeds() -> None:
    line = Line()
    first = line.state(500, -500)
    last = [line.state(500 + 20 * k, -500 - 20 * k) for k in range(1, 6)][-1]
    assert (first.left_rad, last.left_rad) == pytest.approx((0.0, 0.1 * tau))
    assert (last.left_radps, last.right_radps) == pytest.approx((tau, -tau))
    assert last.timed_out is None
    assert (last.estop_pressed, last.cliff) == (False, False)


@pytest.mark.parametrize(
    "odd", [b"Invalid Command\r\n", b"1 2\r\n", b"OK\r\nOK\r\n", b"OK\r\n1 x\r\n", b"\xff\r\n"]
)
def test_a_line_that_does_not_fit_loses_the_order_until_it_was_silent(
    odd: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    line = Line()
    line.state()
    line.ask()
    assert line.hear(odd) == []
    assert "base_out_of_step" in caplog.text
    assert line.hear(answer(5, 5)) == [], "a late one is nobody's"
    asked_at = [k for k in range(12) if line.tick()]
    assert asked_at[0] >= 4, "not before the line was silent"
    assert line.hear(answer(6, 6))[0].echo_seq == line.seq - (11 - asked_at[0])


def test_an_answer_that_never_comes_loses_the_order_too() -> None:
    line = Line()
    line.state()
    sent = [bool(line.tick()) for _ in range(14)]
    assert not sent[-1]
    assert sum(sent) < MOST_ASKED


def test_a_stop_goes_out_five_times_at_once_whatever_the_order_is() -> None:
    line = Line()
    line.state()
    line.ask()
    line.hear(b"\xff\r\n")
    assert [line.tick(enable=False) for _ in range(5)] == [b"m 0 0\re\r"] * 5
    assert line.tick(enable=False) == b""


def test_stops_beyond_what_may_be_asked_still_go_out() -> None:
    line = Line()
    line.state()
    for _ in range(4):
        line.tick()
        for _ in range(5):
            assert line.tick(0.0)


@pytest.mark.parametrize(
    ("was", "now", "code"),
    [(500, 100_500, "base_spoilt"), (500, -99_500, "base_spoilt"), (100_000, 3, "base_reset")],
)
def test_counts_that_jump_are_counted_anew_and_only_those_to_nought_are_a_reset(
    was: int, now: int, code: str, caplog: pytest.LogCaptureFixture
) -> None:
    line = Line()
    before = line.state(was)
    line.ask()
    assert line.hear(answer(now)) == []
    assert [code in caplog.text, "base_reset" in caplog.text] == [True, code == "base_reset"]
    after = line.state(now)
    assert after.boot_id != before.boot_id
    assert after.left_rad == 0.0


def test_after_a_silence_it_is_another() -> None:
    line = Line()
    before = line.state(500)
    line.now_s += 1.0
    after = line.state(3)
    assert after.boot_id != before.boot_id
    assert after.left_rad == 0.0
    assert after.echo_seq == line.seq


def test_without_ticks_there_is_no_protocol() -> None:
    with pytest.raises(ValueError, match="ticks_per_turn"):
        ArduinoProtocol(RobotDescription(), "b1")


@given(st.lists(st.sampled_from([answer(1, 1), b"OK\r\n", b"3 4\r\n", b"O", b"", b"\xff\n"])))
def test_no_echo_is_ever_newer_than_what_was_sent(said: list[bytes]) -> None:
    line = Line()
    sent: list[int] = []
    for data in said:
        if line.tick():
            sent.append(line.seq)
        for state in line.hear(data):
            assert state.echo_seq in sent


def test_a_question_alone_brings_counts_and_keeps_the_dead_man() -> None:
    protocol = ArduinoProtocol(ROBOT, "b1")
    asked = b"".join(protocol.question(seq) for seq in range(400))
    assert set(asked.split(b"\r")) == {b"e", b""}
    protocol.decode(b"", 1.0)
    assert [state.left_rad for state in protocol.decode(b"7 8\r\n", 1.0)] != []


def test_a_long_silence_is_told_once_until_the_base_is_in_step_again(
    caplog: pytest.LogCaptureFixture,
) -> None:
    line = Line()
    line.state()
    for _ in range(400):
        line.tick()
    assert caplog.text.count("base_out_of_step") == 1
    line.ask()
    line.hear(answer(1, 1))
    for _ in range(400):
        line.tick()
    assert caplog.text.count("base_out_of_step") == 2
