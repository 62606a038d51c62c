"""Fuzz every decoder, blindly and, where atheris is installed, guided by its branches."""

from __future__ import annotations

import importlib.util
import re
from typing import TYPE_CHECKING

from tools.attack.decoders import DECODERS
from tools.attack.lab import side_by_side
from tools.attack.outcome import AttackOutcome

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tools.attack.lab import AttackLab, ChildEnd

NAME = "decoding"
TITLE = "decoders fed with mutants"
QUICK_S, QUICK_GUIDED_S = 14.0, 8.0
LONG_S = 3 * 3600.0
LONG_COUNT = 1_000_000
GRACE_S = 60.0
"""For a child's start, the longest hang and its end."""
GOAL = "0 crashes, 0 hangs, memory +10 MB at most"
_RUNS = re.compile(r"stat::number_of_executed_units:\s*(\d+)")


def attack(lab: AttackLab) -> list[AttackOutcome]:
    """Fuzz each decoder in a process of its own, one a processor."""
    with lab.folder() as folder:
        found = [*_blind(lab, folder), *_run_guided(lab, folder)]
        lab.keep(folder)
    return found


def _run_fuzzer(
    lab: AttackLab,
    folder: Path,
    module: str,
    seconds: float,
    judge: Callable[[str, ChildEnd], AttackOutcome],
) -> list[AttackOutcome]:
    """Run one fuzzer's module on every decoder, each in a folder of its own."""
    commands = []
    for decoder in DECODERS:
        own = folder / f"{decoder.name}-{module}"  # crashes are kept beside it
        own.mkdir()
        commands.append(lab.child(module, decoder.name, own, seconds, LONG_COUNT))
    found: dict[int, AttackOutcome] = {}
    for at, ended in side_by_side(commands, seconds + GRACE_S):
        found[at] = judge(DECODERS[at].name, ended)
        lab.say(f"{found[at].attack}: {found[at].n} inputs, {found[at].wrong} wrong")
    return [found[at] for at in sorted(found)]


def _blind(lab: AttackLab, folder: Path) -> list[AttackOutcome]:
    return _run_fuzzer(
        lab, folder, "tools.attack.fuzz", LONG_S if lab.long else QUICK_S, blind_outcome
    )


def blind_outcome(name: str, ended: ChildEnd) -> AttackOutcome:
    """Return what a blind fuzzer told; one that told nothing crashed or hung as a whole."""
    record = ended.last_record
    if record is None:
        how = "hung" if ended.status is None else f"ended with {ended.status}"
        note = f"the process {how}: {' '.join(ended.complained.split())[-200:]}"
        return AttackOutcome(name, 1, 1, GOAL, note=note)
    wrong = int(record["crashes"]) + int(record["hangs"])
    kinds = "; ".join(f"{kind} x{count}" for kind, count in record["kinds"].items())
    taken = f"{record['taken']} taken, slowest {record['slowest_ms']:.0f} ms"
    return AttackOutcome(
        name,
        int(record["n"]),
        wrong,
        GOAL,
        record["before_mb"],
        record["after_mb"],
        note=f"{taken}; {kinds}" if kinds else taken,
    )


def _run_guided(lab: AttackLab, folder: Path) -> list[AttackOutcome]:
    if importlib.util.find_spec("atheris") is None:
        note = "atheris is not installed: make attack installs it where it has a wheel"
        return [AttackOutcome("guided", 0, 0, "0 crashes", note=note, skipped=True)]
    return _run_fuzzer(
        lab, folder, "tools.attack.guided", LONG_S if lab.long else QUICK_GUIDED_S, guided_outcome
    )


def guided_outcome(name: str, ended: ChildEnd) -> AttackOutcome:
    """Return what libFuzzer told at its end; it ends at the first crash."""
    runs = _RUNS.search(ended.complained)
    wrong = int(ended.status != 0)
    words = [line for line in ended.complained.splitlines() if "Error" in line or "Unsound" in line]
    note = " | ".join(words[-2:])[:200] if wrong else "coverage-guided, memory up to 1 GB"
    return AttackOutcome(
        f"{name}, guided", int(runs[1]) if runs else wrong, wrong, "0 crashes", note=note
    )
