"""Attack the product and print a table: ``python -m tools.attack [--long] [NAME …]``.

Exit status: 0 every goal met, 1 one was missed, 130 Ctrl-C. Only this machine's loopback is used,
and every attack is bounded in count and in time: ten minutes in all, more with ``--long``.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

from tools.attack import contract, decoding, files
from tools.attack.lab import AttackLab
from tools.attack.outcome import AttackOutcome, table
from tools.bench.context import TROUBLE, line
from tools.bench.store import Store

if TYPE_CHECKING:
    from types import FrameType

    from tools.attack.lab import Attack

INTERRUPTED = 130
ALL: tuple[Attack, ...] = cast("tuple[Attack, ...]", (contract, files, decoding))
"""In the order in which they run: what needs a robot first, then what takes both processors."""


def main(arguments: list[str] | None = None) -> int:
    """Attack, print, append to ``$PONS_HOME/attack/results.jsonl``."""
    given = _options(arguments)
    signal.signal(signal.SIGTERM, _as_interrupt)
    home = Path(os.environ.get("PONS_HOME") or ".pons").absolute() / "attack"
    home.mkdir(parents=True, exist_ok=True)
    store = Store(home / "results.jsonl", resume=False)
    wanted = [one for one in ALL if not given.names or one.NAME in given.names]
    print(f"{store.machine}; commit {store.commit}; crashes are kept in {home}", flush=True)
    outcomes: list[AttackOutcome] = []
    try:
        for one in wanted:
            found, took_s = _attack(one, AttackLab(home, long=given.long, seed=given.seed))
            for outcome in found:
                store.append("attack", one.NAME, outcome.record())
            print(f"\n{one.TITLE} ({one.NAME}, {took_s:.0f} s)\n{table(found)}", flush=True)
            outcomes += found
    except KeyboardInterrupt:
        print("\nattack: interrupted; all processes are ended")
        return INTERRUPTED
    missed = [outcome for outcome in outcomes if not outcome.is_met]
    print(f"\nall, of seed {given.seed}\n{table(outcomes)}")
    print(f"goals missed: {len(missed)} of {len(outcomes)}")
    return 1 if missed else 0


def _attack(one: Attack, lab: AttackLab) -> tuple[list[AttackOutcome], float]:
    """Run one attack; what it could not do is a goal missed and does not end the others."""
    began_s = time.monotonic()
    try:
        found = one.attack(lab)
    except TROUBLE as trouble:
        found = [AttackOutcome(one.NAME, 0, 0, "could be tried", note=line(trouble))]
    named = [replace(outcome, attack=f"{one.NAME}: {outcome.attack}") for outcome in found]
    return named, time.monotonic() - began_s


def _options(arguments: list[str] | None) -> argparse.Namespace:
    names = [one.NAME for one in ALL]
    parser = argparse.ArgumentParser(prog="python -m tools.attack", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(names)}")
    parser.add_argument("--long", action="store_true", help="a million inputs a decoder")
    parser.add_argument("--seed", type=int, default=1, help="of every mutant; default 1")
    given = parser.parse_args(arguments)
    unknown = sorted(set(given.names) - set(names))
    if unknown:
        parser.error(f"unknown attack {', '.join(unknown)}; there are: {', '.join(names)}")
    return given


def _as_interrupt(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
