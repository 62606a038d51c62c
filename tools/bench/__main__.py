"""Run the benches: ``python -m tools.bench [--long] [NAME …]``.

Prints a table per measurement with the goals beside it, and appends everything to one file,
``$PONS_HOME/bench/results.jsonl``. ``--long`` goes on where an interrupted long run of the same
commit and machine stopped. Exit status: 0 measured, 1 something could not be measured, 130 Ctrl-C.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from pons.machine import pace
from tools.bench.context import TROUBLE, BenchLab, Measure, line
from tools.bench.measure import ALL
from tools.bench.report import ReportRow, table
from tools.bench.store import Store

if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
QUICK_S = 540.0
"""No slice begins later than this in a run that is not long, so that all ends within 10 min."""


def main(arguments: list[str] | None = None) -> int:
    """Measure, print, append."""
    given = _options(arguments)
    signal.signal(signal.SIGTERM, _as_interrupt)
    home = Path(os.environ.get("PONS_HOME") or ".pons").absolute()
    store = Store(home / "bench" / "results.jsonl", resume=given.long and not given.afresh)
    wanted = (
        [one for one in ALL if one.NAME in given.names] if given.names else _default(given.long)
    )
    print(f"{store.machine}; commit {store.commit}; results go to {store.path}", flush=True)
    end_s = float("inf") if given.long else time.monotonic() + QUICK_S
    failed = 0
    try:
        for one in wanted:
            failed += _take(one, BenchLab(store, given.long, one.NAME, end_s))
    except KeyboardInterrupt:
        print("\nbench: interrupted; all processes are ended, what was measured is kept")
        return INTERRUPTED
    return 1 if failed else 0


def _take(one: Measure, lab: BenchLab) -> int:
    """Run one measurement; what can't be measured is said and does not end the others."""
    began_s, paces = time.monotonic(), [pace()]
    try:
        rows = one.measure(lab)
    except TROUBLE as trouble:
        rows = [ReportRow(one.NAME, "", "", value="not measured", note=line(trouble), valid=False)]
    paces.append(pace())
    for row in rows:
        lab.store.append("row", one.NAME, {**row.record(), "pace": paces})
    took_s = time.monotonic() - began_s
    speeds = " and ".join(f"{speed:.1f}" for speed in paces)
    print(f"\n{one.TITLE} ({one.NAME}, {took_s:.0f} s; {speeds} M additions/s before and after)")
    print(table(rows))
    for lost in lab.lost:
        lab.store.append("lost", one.NAME, {"slice": lost})
        print(f"lost: {lost}")
    sys.stdout.flush()
    return sum(row.figures is None and not row.valid for row in rows) + len(lab.lost)


def _default(long: bool) -> list[Measure]:
    return [one for one in ALL if long or not one.LONG_ONLY]


def _options(arguments: list[str] | None) -> argparse.Namespace:
    names = [one.NAME for one in ALL]
    parser = argparse.ArgumentParser(prog="python -m tools.bench", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(names)}")
    parser.add_argument("--long", action="store_true", help="take more, and what takes longer")
    parser.add_argument("--afresh", action="store_true", help="with --long: resume nothing")
    given = parser.parse_args(arguments)
    unknown = sorted(set(given.names) - set(names))
    if unknown:
        parser.error(f"unknown measurement {', '.join(unknown)}; there are: {', '.join(names)}")
    return given


def _as_interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
