"""Frames come and go on a bus of python-can, and nobody waits for one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices import can_line
from devices.can_line import KEPT, UNSENT, CanFrame, CanLine, CanTrouble, pack, unpack
from tests.waiting import until

can: Any = pytest.importorskip("can", reason="python-can is not installed: make dev")
LIMIT_S = 10.0
FRAMES = st.one_of(
    st.builds(CanFrame, st.integers(0, 0x7FF), st.binary(max_size=8)),
    st.builds(CanFrame, st.integers(0, 0x1FFFFFFF), st.binary(max_size=8), st.just(value=True)),
)


@given(st.lists(FRAMES, max_size=9), st.binary(max_size=15))
def test_records_are_what_was_packed_and_a_rest_is_none(
    frames: list[CanFrame], rest: bytes
) -> None:
    assert unpack(pack(frames) + rest) == frames


@given(st.binary(max_size=200))
def test_any_bytes_are_frames_of_at_most_eight_bytes(data: bytes) -> None:
    assert all(len(frame.data) <= 8 for frame in unpack(data))


def test_a_long_frame_is_refused() -> None:
    with pytest.raises(ValueError, match="at most 8"):
        pack([CanFrame(1, bytes(9))])


@pytest.fixture
def channel(request: pytest.FixtureRequest) -> str:
    return f"{request.node.name}"


@pytest.fixture
def other(channel: str) -> Iterator[Any]:
    with can.Bus(channel=channel, interface="virtual") as bus:
        yield bus


@pytest.fixture
def line(channel: str, other: object) -> Iterator[CanLine]:
    made = CanLine(channel, "virtual")
    until(lambda: made.opened == 1)
    yield made
    made.close()


def test_a_frame_goes_out_and_one_comes_in(line: CanLine, other: Any) -> None:
    assert line.write(pack([CanFrame(0x111, b"\x01\x2c")]))
    heard = other.recv(LIMIT_S)
    assert (heard.arbitration_id, bytes(heard.data), heard.is_extended_id) == (
        0x111,
        b"\x01,",
        False,
    )
    other.send(can.Message(arbitration_id=0x1ABCDE, data=b"x", is_extended_id=True))
    came: list[CanFrame] = []

    def has_come() -> bool:
        came.extend(unpack(line.read()))
        return bool(came)

    until(has_come)
    assert came == [CanFrame(0x1ABCDE, b"x", is_extended=True)]


def test_what_nobody_reads_is_bounded_and_the_newest_stays(line: CanLine, other: Any) -> None:
    for number in range(KEPT + 50):
        other.send(can.Message(arbitration_id=number, data=b"", is_extended_id=False))
    until(lambda: len(line._in) == KEPT and unpack(line._in[-1])[0].number == KEPT + 49)
    assert unpack(line.read())[0].number == 50


def test_a_bus_that_takes_nothing_makes_nobody_wait(
    line: CanLine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(can_line, "WAIT_S", LIMIT_S)
    line.close()  # nobody empties the queue any more
    line._bus = object()
    frame = pack([CanFrame(1, b"")])
    assert [line.write(frame) for _ in range(UNSENT + 2)] == [True] * UNSENT + [False] * 2
    assert line.dropped == 2
    line._bus = None


def test_a_bus_that_fails_is_opened_again(channel: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(can_line, "RETRY_S", 0.01)
    line = CanLine(channel, "virtual")
    until(lambda: line.opened == 1)

    def broken(*_: object, **__: object) -> None:
        raise can.CanError("bus off")

    with monkeypatch.context() as patch:
        patch.setattr("can.interfaces.virtual.VirtualBus._recv_internal", broken)
        until(lambda: line.trouble is not None and line.trouble.detail == "bus off")
    until(lambda: line.trouble is None and line.opened >= 2)
    line.close()


def test_a_channel_that_is_not_there_is_waited_for() -> None:
    line = CanLine("pons-none0")
    until(lambda: line.trouble is not None and line.trouble.code == "can_gone")
    assert line.read() == b""
    assert not line.write(pack([CanFrame(1, b"")]))
    line.close()


def test_without_the_library_the_cure_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(can_line, "LIBRARY", "can_that_is_nowhere")
    with pytest.raises(CanTrouble, match=r"pip install 'pons-robot\[can\]'"):
        CanLine("can0")
