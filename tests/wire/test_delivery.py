"""Every pair of processes in the key table really receives, over real sockets.

The first test of the project: a topology that delivers nothing between two of its processes looks
healthy from each of them.
"""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from wire.keys import KEYS, Party

LIMIT_S = 30.0
Pair = tuple[Party, str, str]  # hearer, key, sender
EXPECTED: set[Pair] = {
    (hearer, key.path, sender.value)
    for key in KEYS
    for sender in key.senders
    for hearer in key.receivers
    if sender != hearer
}


class Ear(threading.Thread):
    """Read one process's lines as they come."""

    def __init__(self, party: Party, home: Path) -> None:
        super().__init__(daemon=True)
        self.party = party
        self.lines: list[list[str]] = []
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.wire.party", party.value, str(home)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=Path(__file__).parents[2],
        )
        self.start()

    def run(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.append(line.split())

    def close(self) -> None:
        assert self.process.stdin is not None
        self.process.stdin.close()
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.join(timeout=5)
        assert self.process.stdout is not None
        self.process.stdout.close()


@pytest.fixture
def ears(tmp_path: Path) -> Iterator[list[Ear]]:
    """Start every party, those who dial before those who listen: dialling must be patient."""
    order = sorted(Party, key=lambda party: party in (Party.BRIDGE, Party.ROBOT))
    started = [Ear(party, tmp_path) for party in order]
    yield started
    for ear in started:
        ear.close()


def heard_by(ears: list[Ear]) -> set[Pair]:
    return {(ear.party, line[1], line[2]) for ear in ears for line in ear.lines if len(line) == 3}


@pytest.mark.e2e
def test_every_pair_of_the_key_table_receives(ears: list[Ear]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while heard_by(ears) < EXPECTED and time.monotonic() < end_s:
        time.sleep(0.05)  # real processes: there is no clock to fake
    assert EXPECTED - heard_by(ears) == set()
    assert [line for ear in ears for line in ear.lines if line[0] == "rejected"] == []
