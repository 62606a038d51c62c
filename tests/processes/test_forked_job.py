"""Work in a fork: its result comes back, its traces do not, and its crash is its own."""

from __future__ import annotations

import os
import signal
import time

import psutil
import pytest

from processes.forked_job import ForkedJob


def test_the_result_comes_back_and_nothing_else() -> None:
    seen: list[int] = []

    def work() -> int:
        seen.append(1)
        return len(seen)

    for _ in range(3):
        with ForkedJob(work) as apart:
            assert apart.result() == 1
    assert seen == []


def test_two_run_at_once() -> None:
    with ForkedJob(os.getpid) as one, ForkedJob(os.getpid) as other:
        pids = {one.result(), other.result(), os.getpid()}
    assert len(pids) == 3


def test_a_result_larger_than_a_pipe_comes_whole() -> None:
    with ForkedJob(lambda: bytes(1_000_000)) as apart:
        assert len(apart.result()) == 1_000_000


def test_a_fault_is_told_here_and_shown_there(capfd: pytest.CaptureFixture[str]) -> None:
    def work() -> None:
        raise ValueError("odd")

    with ForkedJob(work) as apart, pytest.raises(ChildProcessError, match="ended with 1"):
        apart.result()
    assert "ValueError: odd" in capfd.readouterr().err


def test_a_crash_is_a_fault() -> None:
    def work() -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    with ForkedJob(work) as apart, pytest.raises(ChildProcessError, match="-9"):
        apart.result()


def test_who_does_not_wait_leaves_nothing() -> None:
    us = psutil.Process()
    before = us.num_fds(), len(us.children())
    began_s = time.monotonic()
    with ForkedJob(lambda: time.sleep(60)):
        assert len(us.children()) == before[1] + 1
    assert (us.num_fds(), len(us.children())) == before
    assert time.monotonic() - began_s < 30.0
