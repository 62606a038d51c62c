"""The service manager hears that we are ready and the loop turns, at no cost if deaf."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from processes.service import Service


@pytest.fixture
def manager(tmp_path: Path) -> Iterator[socket.socket]:
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as ears:
        ears.bind(str(tmp_path / "notify"))
        ears.setblocking(False)
        yield ears


def heard(ears: socket.socket) -> list[bytes]:
    words = []
    try:
        while True:
            words.append(ears.recv(100))
    except BlockingIOError:
        return words


def test_ready_watchdog_and_stopping_are_said(manager: socket.socket) -> None:
    service = Service(manager.getsockname())
    service.ready()
    for tick in range(25):
        service.feed(100.0 + tick * 0.01)
    service.stopping()
    service.close()
    assert heard(manager) == [b"READY=1", *[b"WATCHDOG=1"] * 3, b"STOPPING=1"]


def test_the_address_comes_from_the_environment(
    manager: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NOTIFY_SOCKET", manager.getsockname())
    service = Service()
    service.ready()
    service.close()
    assert heard(manager) == [b"READY=1"]


@pytest.mark.parametrize("address", ["", "relative", "/nowhere/at/all", "@no-such-abstract-name"])
def test_nobody_there_is_no_error(address: str) -> None:
    service = Service(address)
    service.ready()
    service.feed(1.0)
    service.close()


def test_a_manager_that_never_reads_does_not_block(manager: socket.socket) -> None:
    service = Service(manager.getsockname())
    for tick in range(2_000):
        service.feed(float(tick))
    service.close()
    assert 1 <= len(heard(manager)) < 2_000
