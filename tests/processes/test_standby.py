"""A killed server is followed by a loaded fork; an asked end, and an early death, are not."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import psutil
import pytest

from processes.standby import find_server

SERVER = """
import os, signal, sys, time
from processes.standby import Standby

def serve():
    print(os.getpid(), flush=True)
    {}
    return 0

sys.exit(Standby(serve, young_s=float(sys.argv[1])).run())
"""
SLEEPS = "time.sleep(60)"


@contextmanager
def standby(young_s: float = 0.0, body: str = SLEEPS) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [sys.executable, "-c", SERVER.format(body), str(young_s)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def server_of(process: subprocess.Popen[str]) -> int:
    assert process.stdout is not None
    return int(process.stdout.readline())


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT])
def test_a_killed_server_is_followed_by_another(number: signal.Signals) -> None:
    with standby() as process:
        first = server_of(process)
        os.kill(first, number)
        second = server_of(process)
        assert second not in (first, process.pid)
        assert find_server(process.pid) == second
        os.kill(second, number)
        assert server_of(process) not in (first, second)
        assert process.poll() is None


def test_an_early_death_ends_the_standby_by_the_same_signal() -> None:
    with standby(young_s=3600.0) as process:
        os.kill(server_of(process), signal.SIGKILL)
        assert process.wait(20) == -signal.SIGKILL


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_an_end_asked_of_the_standby_ends_both(number: signal.Signals) -> None:
    with standby() as process:
        server = psutil.Process(server_of(process))
        process.send_signal(number)
        assert process.wait(20) == -signal.SIGTERM
        assert not server.is_running()


def test_an_end_asked_of_the_server_is_an_end() -> None:
    with standby() as process:
        os.kill(server_of(process), signal.SIGTERM)
        assert process.wait(20) == -signal.SIGTERM


def test_a_server_dies_with_its_standby() -> None:
    with standby() as process:
        server = psutil.Process(server_of(process))
        process.kill()
        process.wait(20)
        psutil.wait_procs([server], 20)
        assert not server.is_running()


@pytest.mark.parametrize(
    ("body", "status"),
    [("pass", 0), ("return 4", 4), ("sys.exit(3)", 3), ("raise ValueError('told')", 1)],
)
def test_a_server_that_ends_by_itself_gives_its_status(body: str, status: int) -> None:
    with standby(body=body) as process:
        _, said = process.communicate(timeout=20)
        assert process.returncode == status
        assert ("told" in said) == (status == 1)
