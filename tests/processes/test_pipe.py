"""Pieces cross the pipe whole or not at all, and nothing waits for the reader."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from processes.pipe import Pipe

LINE = b"x" * 6_000 + b"\n"


@pytest.fixture
def pipe() -> Iterator[Pipe]:
    pipe = Pipe(wanted_bytes=65_536)
    yield pipe
    pipe.close()


def take(pipe: Pipe, most: int) -> bytes:
    os.set_blocking(pipe.read_fd, False)
    try:
        return os.read(pipe.read_fd, most)
    except BlockingIOError:
        return b""


def fill(pipe: Pipe, line: bytes = LINE) -> int:
    sent = 0
    while pipe.send(line):
        sent += 1
        assert sent < 1_000
    return sent


def test_a_full_pipe_refuses_without_waiting(pipe: Pipe) -> None:
    assert 5 <= fill(pipe) <= 11
    assert not pipe.send(LINE)
    assert not pipe.broken
    assert pipe.waiting_bytes() >= pipe.capacity_bytes // 2


def test_what_was_taken_arrives_whole_and_in_order(pipe: Pipe) -> None:
    lines = [b"%04d" % number + b"y" * (number * 37 % 9_000) + b"\n" for number in range(200)]
    taken, out = [], b""
    for line in lines:
        if pipe.send(line):
            taken.append(line)
        if len(taken) % 3 == 0:
            out += take(pipe, 7_001)
    while True:
        pipe.flush()
        data = take(pipe, 1 << 20)
        if not data:
            break
        out += data
    assert 50 < len(taken) < len(lines)
    assert out == b"".join(taken)


def test_room_is_seen_again_once_the_reader_took_some(pipe: Pipe) -> None:
    fill(pipe)
    take(pipe, 40_000)
    assert pipe.send(LINE)


def test_the_pipe_is_as_large_as_was_asked() -> None:
    pipe = Pipe(wanted_bytes=1 << 18)
    assert pipe.capacity_bytes in (1 << 18, 65_536)  # a system may refuse more than its default
    pipe.close()


def test_a_size_beyond_the_systems_leaves_its_default() -> None:
    pipe = Pipe(wanted_bytes=1 << 30)
    try:
        assert 4_096 <= pipe.capacity_bytes <= 1 << 30
        assert pipe.send(b"a\n")
    finally:
        pipe.close()


def test_a_dead_reader_shows_and_nothing_raises(pipe: Pipe) -> None:
    pipe.release_reader()
    assert not pipe.send(LINE)
    assert pipe.broken
    assert not pipe.send(LINE)
    assert not pipe.flush()
    assert pipe.waiting_bytes() == 0


def test_closing_twice_is_fine(pipe: Pipe) -> None:
    pipe.close()
    pipe.close()
    assert not pipe.send(LINE)
