"""Describe a measurement's machine, commit and date. Reads /proc and git; changes nothing."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import time
from datetime import UTC, datetime
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ADDITIONS = 1_000_000


def machine() -> str:
    """Return processor, cores, memory, kernel and Python in one line."""
    memory_gib = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30
    cores = len(os.sched_getaffinity(0))
    return (
        f"{_processor()}, {cores} cores, {memory_gib:.0f} GiB, "
        f"{platform.system()} {platform.release()}, Python {platform.python_version()}"
    )


def pace() -> float:
    """Return how many million additions this Python makes in a second of its own CPU time.

    A neighbour on the same silicon slows a virtual machine without any trace in its own figures:
    compare what two runs measured only where this agrees.
    """
    began_s, total = time.thread_time(), 0
    for number in range(ADDITIONS):
        total += number
    return ADDITIONS / (time.thread_time() - began_s) / 1e6


def commit() -> str:
    """Return the checkout's commit, marked where files differ from it."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        return "unknown"
    head = _git("rev-parse", "--short=12", "HEAD")
    return f"{head}-changed" if _git("status", "--porcelain", "-uno") else head


def today() -> str:
    """Return date and time of day (UTC)."""
    return datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%SZ")


def _git(*words: str) -> str:
    done = subprocess.run(
        ["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=False
    )
    return done.stdout.strip()


def _processor() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text("utf-8").splitlines():
            if line.startswith(("model name", "Model")):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.machine()
