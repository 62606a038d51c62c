"""Every refusal of the system is a value with its reason, never an exception and never a lie."""

from __future__ import annotations

import ctypes
import os
import resource
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Thread
from types import SimpleNamespace
from typing import Any, NoReturn

import pytest

from bridge.realtime import (
    Right,
    all_granted,
    lock_memory,
    pin,
    rights,
    take_fifo,
    transport_fifo,
)


def refuse(*_: Any) -> NoReturn:
    raise PermissionError(1, "Operation not permitted")


def limit(value: int) -> Callable[[int], tuple[int, int]]:
    return lambda _: (value, value)


def libc(answer: int) -> Callable[..., SimpleNamespace]:
    return lambda *_, **__: SimpleNamespace(mlockall=lambda _: answer)


def capabilities(folder: Path, line: str) -> Path:
    path = folder / "status"
    path.write_text(f"Name:\tbridge\n{line}\n")
    return path


@pytest.mark.parametrize("line", ["CapEff:\t0000000000000000", "CapEff:\tnone", "CapEff:", ""])
def test_memory_is_not_locked_under_a_finite_limit(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, line: str
) -> None:
    monkeypatch.setattr(rights, "_STATUS", capabilities(tmp_path, line))
    monkeypatch.setattr(resource, "getrlimit", limit(8 << 20))
    monkeypatch.setattr(ctypes, "CDLL", refuse)  # not even tried
    assert lock_memory() == Right(
        "mlockall", granted=False, detail="RLIMIT_MEMLOCK is 8388608 bytes"
    )


def test_a_limit_that_does_not_bind_us_is_none(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(rights, "_STATUS", capabilities(tmp_path, "CapEff:\t0000000000004000"))
    monkeypatch.setattr(resource, "getrlimit", limit(8 << 20))
    monkeypatch.setattr(ctypes, "CDLL", libc(0))
    assert lock_memory().granted


def test_a_refused_lock_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, "getrlimit", limit(resource.RLIM_INFINITY))
    monkeypatch.setattr(ctypes, "CDLL", libc(-1))
    assert not lock_memory().granted


def test_current_future_and_on_fault_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def mlockall(flags: int) -> int:
        asked.append(flags)
        return 0

    monkeypatch.setattr(resource, "getrlimit", limit(resource.RLIM_INFINITY))
    monkeypatch.setattr(ctypes, "CDLL", lambda *_, **__: SimpleNamespace(mlockall=mlockall))
    assert lock_memory().granted
    assert asked == [1 | 2 | 4]


def test_the_highest_allowed_cpu_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[set[int]] = []
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 2, 5})
    monkeypatch.setattr(os, "sched_setaffinity", lambda _, cpus: taken.append(cpus))
    assert pin(None) == Right("affinity", granted=True, detail="cpu 5")
    assert pin(2) == Right("affinity", granted=True, detail="cpu 2")
    assert taken == [{5}, {2}]


def test_a_cpu_that_is_not_ours_is_refused_with_what_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})
    monkeypatch.setattr(os, "sched_setaffinity", refuse)
    assert pin(7) == Right("affinity", granted=False, detail="cpu 7 not in [0, 1]")
    assert pin(1) == Right("affinity", granted=False, detail="cpu 1: Operation not permitted")


def test_a_refused_priority_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    assert take_fifo(60) == Right(
        "fifo", granted=False, detail="priority 60: Operation not permitted"
    )


def test_fifo_is_asked_for_the_calling_thread_and_not_its_children(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[int, int, int]] = []

    def take(pid: int, policy: int, param: os.sched_param) -> None:
        asked.append((pid, policy, param.sched_priority))

    monkeypatch.setattr(os, "sched_setscheduler", take)
    assert take_fifo(60).granted
    assert asked == [(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, 60)]


@pytest.mark.parametrize("ask", [lock_memory, lambda: pin(None), lambda: take_fifo(60)])
def test_elsewhere_everything_is_refused(
    ask: Callable[[], Right], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    assert not ask().granted


def test_one_refusal_is_a_refusal() -> None:
    given, refused = Right("a", granted=True, detail=""), Right("b", granted=False, detail="")
    assert all_granted((given, given))
    assert not all_granted((given, refused))


def test_threads_started_within_outrank_others_and_the_caller_keeps_its_rank() -> None:
    before = os.sched_getscheduler(0), os.sched_getparam(0).sched_priority
    seen: list[tuple[int, int]] = []

    def look() -> None:
        seen.append((os.sched_getscheduler(0), os.sched_getparam(0).sched_priority))

    with transport_fifo(60) as right:
        started = Thread(target=look)
        started.start()
    started.join()
    look()
    assert seen[1] == before
    assert seen[0] == ((os.SCHED_FIFO, 50) if right.granted else before)


def test_a_refused_rank_of_the_transport_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    with transport_fifo(5) as right:
        assert right == Right(
            "transport fifo", granted=False, detail="priority 1: Operation not permitted"
        )


def test_no_rank_of_the_transport_elsewhere(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    with transport_fifo(60) as right:
        assert not right.granted
        assert "darwin" in right.detail
