"""The real clock sleeps until a moment, not for a while, with and without clock_nanosleep."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

import pytest

from bridge.realtime import MonotonicClock


@pytest.fixture(params=["absolute", "fallback"])
def clock(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> MonotonicClock:
    if request.param == "fallback":
        monkeypatch.setattr(sys, "platform", "elsewhere")
        assert not MonotonicClock().absolute
    return MonotonicClock()


def test_linux_sleeps_absolutely() -> None:
    assert MonotonicClock().absolute == (sys.platform == "linux")


def test_it_never_returns_early(clock: MonotonicClock) -> None:
    for wait_s in (0.0001, 0.003, 0.02):
        at_s = time.monotonic() + wait_s
        clock.sleep_until(at_s)
        assert clock.now_s() >= at_s - 2e-6  # a double holds uptime to about a microsecond


def test_a_moment_that_has_passed_is_not_waited_for(clock: MonotonicClock) -> None:
    began_s = clock.now_s()
    clock.sleep_until(began_s - 5.0)
    assert clock.now_s() - began_s < 1.0


def test_a_signal_runs_its_handler_and_does_not_cut_the_sleep(clock: MonotonicClock) -> None:
    seen: list[int] = []
    before = signal.signal(signal.SIGUSR1, lambda number, _: seen.append(number))
    at_s = time.monotonic() + 0.08
    sender = threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGUSR1))
    try:
        sender.start()
        clock.sleep_until(at_s)
    finally:
        sender.join()
        signal.signal(signal.SIGUSR1, before)
    assert clock.now_s() >= at_s - 2e-6
    assert seen == [signal.SIGUSR1]
