"""Run the sleepers whose lateness is compared: the bridge and cyclictest.

Each returns how late every wake-up was [us]. Both ask for the same rank and the same CPU; what the
machine lacks returns nothing.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tools.bench.context import until
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tools.bench.context import BenchLab

PRIORITY = 60
SETTLE_S = 0.5
_BUCKETS_US = 300_000
"""Longer stalls than this have not been seen on a machine that lives."""
_BUCKET = re.compile(r"^(\d+)\s+(\d+)\s*$")


def rt_cpu() -> int:
    """Return the CPU that the bridge pins itself to."""
    return max(os.sched_getaffinity(0))


@contextmanager
def stress_cores(on: bool) -> Iterator[None]:
    """Load every core and the memory with stress-ng, if asked; it ends with the context."""
    if not on:
        yield
        return
    cores = str(len(os.sched_getaffinity(0)))
    words = ["stress-ng", "--cpu", cores, "--vm", "1", "--vm-bytes", "256M", "--switch", "1"]
    load = subprocess.Popen(
        [*words, "--timeout", "120s"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        time.sleep(SETTLE_S)
        yield
    finally:
        load.terminate()
        load.wait()


def bridge_late_us(lab: BenchLab, seconds: float, *, stress: bool) -> list[float]:
    """Run the bridge alone: no robot, no planner, its loop turning in SELFTEST."""
    with lab.folder() as home, BenchRobot(home, "two_room", tapped=True, only=("bridge",)) as robot:
        until(lambda: robot.status is not None, 20.0, "the bridge's first status")
        with stress_cores(stress):
            time.sleep(seconds)
            late_us: list[float] = robot.end_bridge()["late_us"]
        return late_us[-round(seconds * 100) :]


def cyclictest_late_us(seconds: float, period_us: int, *, awake: bool = True) -> list[float]:
    """Run one thread at a rate; return every lateness, from its histogram."""
    with cyclictest(seconds, period_us, awake=awake) as ended:
        return ended()


@contextmanager
def cyclictest(
    seconds: float, period_us: int, *, awake: bool = True
) -> Iterator[Callable[[], list[float]]]:
    """Run it beside; what is yielded waits for its end. It ends with the context at the latest.

    By itself it holds /dev/cpu_dma_latency, so that no core may sleep while it runs: an idle
    machine then wakes at once, and takes the power for it. Not ``awake``, it leaves that as it
    is, as the bridge and any other program do.
    """
    if shutil.which("cyclictest") is None:
        yield list
        return
    loops = max(1, round(seconds * 1e6 / period_us))
    words = ["cyclictest", "-q", "-t1", f"-a{rt_cpu()}", f"-i{period_us}", f"-l{loops}"]
    words += [f"-h{_BUCKETS_US}"] + ([] if awake else ["--laptop"])
    if may_take(PRIORITY):  # without a right to that rank the bridge has none either
        words += [f"-p{PRIORITY}", "-m"]
    quiet = subprocess.DEVNULL
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=quiet, text=True) as running:
        try:
            yield lambda: _expand_histogram(running.communicate()[0])
        finally:
            running.kill()


def may_take(priority: int) -> bool:
    """Tell whether a process of ours may have a real-time rank."""
    words = ["chrt", "-f", str(priority), "true"]
    return (
        shutil.which("chrt") is not None
        and subprocess.run(words, capture_output=True, check=False).returncode == 0
    )


def _expand_histogram(histogram: str) -> list[float]:
    samples: list[float] = []
    for line in histogram.splitlines():
        found = _BUCKET.match(line.strip())
        if found:
            samples += [float(found[1])] * int(found[2])
    return samples
