"""Know which test walks which line of the core and how long it takes; run tests without reports.

Measured once per test and kept in .mutants/; anew when the test's file changes. Lines of the core
that have moved since are found again.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import signal
import time
from collections import defaultdict
from difflib import SequenceMatcher
from heapq import heapify, heappop, heappush
from pathlib import Path
from typing import Any

import coverage
import pytest
from _pytest.outcomes import Skipped
from _pytest.tmpdir import tmppath_result_key

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "bridge" / "core"
KEPT = ROOT / ".mutants"
MEASURED = KEPT / "lines.pickle"
ROUNDS_S = (0.02, 0.05, 0.1, 0.3, 1.0, 10.0)
"""What a test may take in each round of walking all lines."""
CHEAP = 0.1
"""Tests that take this share of it come before, whatever they walk."""
SLOWER, GRACE_S = 10.0, 0.4
"""A test that takes so many times its own processor time, and this more, hangs."""
Lines = dict[str, dict[int, list[str]]]
"""Module below ``bridge.core``, line, keys of the tests that walk it."""


def modules() -> list[str]:
    """Return every module of the core as its dotted name below ``bridge.core``."""
    files = sorted(CORE.rglob("*.py"))
    return [name_of(file) for file in files if file.stem != "__init__"]


def file_of(name: str) -> Path:
    """Return the file of a module of the core, as ``motion.limiter``."""
    return CORE.joinpath(*name.split(".")).with_suffix(".py")


def name_of(file: Path) -> str:
    """Return the dotted name below ``bridge.core`` of a file."""
    return ".".join(file.relative_to(CORE).with_suffix("").parts)


def plain(items: list[pytest.Item]) -> list[pytest.Item]:
    """Return the tests without hypothesis: a law that notices now and then makes counts waver."""
    return [i for i in items if not getattr(getattr(i, "obj", None), "is_hypothesis_test", False)]


class LineTests:
    """Tell the tests that walk a line, those first that are likely to notice soon."""

    def __init__(self, items: list[pytest.Item]) -> None:
        self.files: dict[Path, str] = {}
        self.items = {self._key(item): item for item in items}
        self.took, self.lines = self._load_or_measure()
        self.order = diverse(self.took, self.lines, set(self.items))
        self.noticed: dict[str, dict[str, int]] = defaultdict(lambda: defaultdict(int))
        """Function, key of a test, how many of its mutants the test noticed."""

    def _key(self, item: pytest.Item) -> str:
        if item.path not in self.files:
            self.files[item.path] = hashlib.sha1(item.path.read_bytes()).hexdigest()[
                :8
            ]  # no secret
        return f"{item.nodeid}|{self.files[item.path]}"

    def tests(self, name: str, lines: set[int], function: str) -> list[str]:
        """Return the keys of the tests that walk one of the lines of a module."""
        by_line = self.lines.get(name, {})
        keys = {key for line in lines for key in by_line.get(line, ()) if key in self.items}
        before = self.noticed[function]
        own = {key for key in keys if f"_{name.rpartition('.')[2]}" in self.items[key].path.stem}
        return sorted(keys, key=lambda key: (-before[key], key not in own, self.order[key]))

    def _load_or_measure(self) -> tuple[dict[str, float], Lines]:
        took: dict[str, float] = {}
        lines: Lines = {}
        sources = {name: file_of(name).read_text("utf-8") for name in modules()}
        if MEASURED.exists():
            before, took, lines = pickle.loads(MEASURED.read_bytes())  # written below
            lines = {
                name: move_lines(by_line, before[name], sources[name])
                for name, by_line in lines.items()
                if name in sources
            }
        missing = [key for key in self.items if key not in took]
        if missing:
            part = KEPT / "part.pickle"
            child = os.fork()
            if child == 0:
                os._exit(self._measure(missing, part))
            if os.waitpid(child, 0)[1] != 0:
                raise SystemExit("a test fails without any mutant; mend it first")
            more_took, more_lines = pickle.loads(part.read_bytes())  # written by the child
            took |= more_took
            for name, by_line in more_lines.items():
                for line, keys in by_line.items():
                    lines.setdefault(name, {}).setdefault(line, []).extend(keys)
        MEASURED.write_bytes(pickle.dumps((sources, took, lines)))
        return took, lines

    def _measure(self, keys: list[str], part: Path) -> int:
        took: dict[str, float] = {}
        watch = coverage.Coverage(data_file=None, include=[f"{CORE}/**"], config_file=False)
        watch.start()
        for index, key in enumerate(keys):
            watch.switch_context(key)
            began_s = time.process_time()
            if fails(self.items[key], self.items[keys[index + 1]] if keys[index + 1 :] else None):
                print("fails:", key, flush=True)
                return 1
            took[key] = time.process_time() - began_s
        watch.stop()
        data = watch.get_data()
        lines = {
            name_of(Path(file)): {
                line: [key for key in keys if key]
                for line, keys in data.contexts_by_lineno(file).items()
            }
            for file in data.measured_files()
        }
        part.write_bytes(pickle.dumps((took, lines)))
        return 0


def diverse(took: dict[str, float], lines: Lines, keys: set[str]) -> dict[str, int]:
    """Return the place of each test in an order that walks as many lines as soon as it can.

    In each round come the cheapest that are left, then greedily the test that adds most lines a
    second; all lines count anew. Many tests that do the same would otherwise come before the one
    that differs.
    """
    walks: dict[str, set[tuple[str, int]]] = {key: set() for key in keys}
    for name, by_line in lines.items():
        for line, walking in by_line.items():
            for key in keys.intersection(walking):
                walks[key].add((name, line))
    order: dict[str, int] = {}
    for most_s in ROUNDS_S:
        for key in sorted(keys - set(order), key=took.__getitem__):
            if took[key] <= most_s * CHEAP:
                order[key] = len(order)
        able = [key for key in keys if key not in order and took[key] <= most_s]
        heap = [(-len(walks[key]) / (took[key] + 0.001), key) for key in able]
        heapify(heap)
        done: set[tuple[str, int]] = set()
        while heap:
            _, key = heappop(heap)
            gain = -len(walks[key] - done) / (took[key] + 0.001)
            if heap and gain > heap[0][0]:
                if gain < 0.0:
                    heappush(heap, (gain, key))
                continue
            if gain < 0.0:
                order[key] = len(order)
                done |= walks[key]
    for key in sorted(keys - set(order), key=took.__getitem__):
        order[key] = len(order)
    return order


def move_lines(by_line: dict[int, list[str]], before: str, now: str) -> dict[int, list[str]]:
    """Return what walks each line of a source that has changed since; new lines nobody knows."""
    if before == now:
        return by_line
    found: dict[int, list[str]] = {}
    for block in SequenceMatcher(None, before.splitlines(), now.splitlines()).get_matching_blocks():
        for offset in range(block.size):
            if block.a + offset + 1 in by_line:
                found[block.b + offset + 1] = by_line[block.a + offset + 1]
    return found


def fails(item: pytest.Item, following: pytest.Item | None) -> bool:
    """Run one test; tell whether it failed. Pytest's own way writes a report that nobody reads."""
    state = item.session._setupstate  # noqa: SLF001  # pytest has no other door
    item.stash[tmppath_result_key] = {}
    try:
        getattr(item, "_initrequest", lambda: None)()
        state.setup(item)
        item.runtest()
    except Skipped:
        pass
    except BaseException:  # noqa: BLE001  # whatever it is: it noticed
        return True
    state.teardown_exact(following)
    return False


def first_that_fails(walked: LineTests, keys: list[str]) -> int:
    """Run tests until one fails; return its number, or -1. One that hangs ends the process."""
    following: Any = [walked.items[key] for key in keys[1:]] + [None]
    for index, key in enumerate(keys):
        signal.setitimer(signal.ITIMER_PROF, SLOWER * walked.took[key] + GRACE_S)
        if fails(walked.items[key], following[index]):
            return index
    return -1
