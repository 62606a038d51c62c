"""Give a measurement what it needs: a place for its files, progress, and slices that resume."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from subprocess import SubprocessError
from tempfile import TemporaryDirectory
from typing import Any, Protocol

from pons.http import PlannerDown, PlannerProblem
from tools.bench.report import ReportRow
from tools.bench.store import Store
from wire import ConfigError


class Measure(Protocol):
    """Be one measurement: a module with these names."""

    NAME: str
    TITLE: str
    LONG_ONLY: bool

    @staticmethod
    def measure(lab: BenchLab) -> list[ReportRow]:
        """Measure and return the rows of a table."""


class MeasurementFailure(Exception):
    """An event that a measurement waited for did not come in time."""


TROUBLE = (MeasurementFailure, ConfigError, PlannerDown, PlannerProblem, OSError, SubprocessError)
"""What a slice may end in without being a defect of the bench."""


@dataclass
class BenchLab:
    """Serve one run of the benches."""

    store: Store
    long: bool
    name: str = ""
    end_s: float = float("inf")
    """When no further slice is begun, on the monotonic clock: a quick run stays quick."""
    lost: list[str] = field(default_factory=list)
    """Slices that could not be taken, and why."""

    def count(self, quick: int, long: int) -> int:
        """Return how often to repeat: enough for the minutes there are."""
        return long if self.long else quick

    def say(self, text: str) -> None:
        """Show progress on standard error; a terminal keeps one line of it."""
        end = "\x1b[K\r" if sys.stderr.isatty() else "\n"
        print(f"bench {self.name}: {text}", end=end, file=sys.stderr, flush=True)

    def slices(self, what: str, count: int, take: Callable[[int], Any]) -> Iterator[Any]:
        """Yield the data of each slice; what an earlier long run has taken is not taken again.

        Args:
            what: names the slices within this measurement.
            count: how many are wanted.
            take: measures the slice of an index; returns what JSON can hold.
        """
        name = f"{self.name}.{what}"
        known = self.store.slices(name)
        yield from (known[index] for index in range(count) if index in known)
        for index in self._missing(what, count, known):
            try:
                data = take(index)
            except TROUBLE as trouble:  # one slice lost is no reason to lose the others
                self.lost.append(f"{what} {index + 1}: {line(trouble)}")
                continue
            self.store.append("slice", name, {"index": index, "data": data})
            yield data

    def side_by_side(self, what: str, count: int, take: Callable[[int], Any]) -> Iterator[Any]:
        """Do as ``slices`` does, one slice a processor, yielded as they are done.

        Args:
            what: names the slices within this measurement.
            count: how many are wanted.
            take: a function of a module; it measures no time, for the others take some of it.
        """
        name = f"{self.name}.{what}"
        known = self.store.slices(name)
        yield from (known[index] for index in range(count) if index in known)
        with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
            missing = self._missing(what, count, known)
            running = {pool.submit(take, index): index for index in missing}
            for done in as_completed(running):
                if (trouble := done.exception()) is not None:
                    self.lost.append(f"{what} {running[done] + 1}: {line(trouble)}")
                    continue
                data = done.result()
                self.store.append("slice", name, {"index": running[done], "data": data})
                yield data

    def _missing(self, what: str, count: int, known: dict[int, Any]) -> Iterator[int]:
        """Yield what nobody took yet, until the time is up."""
        for index in range(count):
            if index not in known:
                if time.monotonic() >= self.end_s:
                    self.lost.append(f"{what} {index + 1} to {count}: the time was up")
                    return
                self.say(f"{what} {index + 1}/{count}")
                yield index

    @contextmanager
    def folder(self) -> Iterator[Path]:
        """Lend an empty folder with a short name, as socket paths end at 107 bytes."""
        with TemporaryDirectory(prefix="pb-", ignore_cleanup_errors=True) as name:
            yield Path(name)


def until(done: Callable[[], object], limit_s: float, what: str, pause_s: float = 0.005) -> None:
    """Wait for something outside.

    Raises:
        Missed: it did not come in time.
    """
    end_s = time.monotonic() + limit_s
    while not done():
        if time.monotonic() > end_s:
            raise MeasurementFailure(f"{what}: not within {limit_s:.1f} s")
        time.sleep(pause_s)


def line(trouble: object) -> str:
    """Write what went wrong in one line."""
    return " | ".join(str(trouble).splitlines())[:300]
