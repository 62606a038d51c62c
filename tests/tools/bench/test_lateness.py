"""Lateness is read from cyclictest's histogram, and cyclictest ends with whom it runs beside."""

from __future__ import annotations

import os
import time
from pathlib import Path

import psutil
import pytest

from tools.bench.lateness import cyclictest, cyclictest_late_us

HISTOGRAM = """# Histogram
000000 000000
000007 000002
000120 000001
010500 000001
# Total: 4
"""


def fake(folder: Path, script: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a cyclictest first in the search path."""
    made = folder / "cyclictest"
    made.write_text(f"#!/bin/sh\n{script}\n", "ascii")
    made.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


def test_every_wake_up_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fake(tmp_path, f"cat <<'end'\n{HISTOGRAM}end", monkeypatch)
    late_us = cyclictest_late_us(1.0, 10_000)
    assert late_us == [7.0, 7.0, 120.0, 10_500.0]


def test_it_ends_with_whom_it_runs_beside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fake(tmp_path, f"echo $$ > {tmp_path / 'pid'}; exec sleep 60", monkeypatch)
    note = tmp_path / "pid"

    def interrupted() -> None:
        while not note.exists() or not note.read_text("ascii").strip():
            time.sleep(0.01)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), cyclictest(60.0, 10_000):
        interrupted()
    assert not psutil.pid_exists(int(note.read_text("ascii")))


def test_without_one_nothing_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    assert cyclictest_late_us(1.0, 10_000) == []
