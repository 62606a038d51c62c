"""Give damaged and hostile files of every kind to their real readers.

Each file is read by a fork of a process that has loaded the reader, with an address space and a
time of its own: what comes of it is "read", a refusal with a code, or a finding.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import resource
import select
import signal
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from tools.attack.decoders import stable
from tools.attack.file_kinds import KINDS, FileKind
from tools.attack.fuzz import place_of
from tools.attack.lab import side_by_side
from tools.attack.mutators import mutant
from tools.attack.outcome import AttackOutcome
from tools.bench.processes import rss_mb

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.attack.lab import AttackLab, ChildEnd

NAME = "files"
TITLE = "files of every kind, damaged and hostile"
LIMIT_S = 5
"""Of processor time, so that a busy machine makes no finding."""
WAITED_S = 60.0
ROOM_MB = 2_048
"""Of address space beyond what the reader's process has; more is refused by the system."""
QUICK_S, LONG_S = 8.0, 1_200.0
QUICK_COUNT, LONG_COUNT = 3_000, 200_000
GRACE_S = 180.0
"""For bombs, each of which may take its whole time on a machine that does other things."""
FINE = frozenset({"read", "refused"})


def attack(lab: AttackLab) -> list[AttackOutcome]:
    """Try each kind in a process of its own, one a processor."""
    count, seconds = (LONG_COUNT, LONG_S) if lab.long else (QUICK_COUNT, QUICK_S)
    with lab.folder() as folder:
        commands = []
        for at in range(len(KINDS)):
            own = folder / f"{at}" / "two_room"  # home.yaml must lie in a folder of its name
            own.mkdir(parents=True)
            commands.append(lab.child("tools.attack.files", str(at), own, seconds, count))
        found: dict[int, AttackOutcome] = {}
        for at, ended in side_by_side(commands, seconds + GRACE_S):
            found[at] = file_outcome(KINDS[at], ended)
            lab.say(f"{found[at].attack}: {found[at].n} files, {found[at].wrong} wrong")
            lab.keep(folder / f"{at}")
    return [found[at] for at in sorted(found)]


def file_outcome(kind: FileKind, ended: ChildEnd) -> AttackOutcome:
    """Return what the process of one kind told."""
    goal = f"read or refused by code in {LIMIT_S} s and {kind.bound_mb:.0f} MB"
    record = ended.last_record
    if record is None:
        note = f"the process ended with {ended.status}: {ended.complained.strip()[-200:]}"
        return AttackOutcome(kind.name, 1, 1, goal, note=note)
    counts: dict[str, int] = record["counts"]
    wrong = sum(count for what, count in counts.items() if what not in FINE)
    note = "; ".join(f"{what} {count}" for what, count in sorted(counts.items()))
    peak = f"most {record['most_mb']:.0f} MB, {record['slowest_s']:.1f} s"
    return AttackOutcome(kind.name, sum(counts.values()), wrong, goal, note=f"{note}; {peak}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Try one kind; the exit status is 0 whatever was found, for it is told."""
    parser = argparse.ArgumentParser(prog="python -m tools.attack.files", description=__doc__)
    parser.add_argument("kind", type=int, choices=range(len(KINDS)))
    parser.add_argument("--folder", type=Path, required=True, help="an empty folder of its own")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=QUICK_COUNT)
    parser.add_argument("--seconds", type=float, default=QUICK_S)
    given = parser.parse_args(arguments)
    kind = KINDS[given.kind]
    read, refusals = kind.load()
    kind.beside(given.folder)
    told = FileCounts(kind, given.folder)
    seeds = list(kind.seeds())
    for data in (*seeds, *kind.bombs()):
        told.take(data, read, refusals)
    random, most = Random(given.seed), max(65_536, 2 * max(map(len, seeds)))
    end_s = time.monotonic() + given.seconds
    while told.n < given.count and time.monotonic() < end_s:
        told.take(mutant(seeds, random, most), read, refusals)
    print(json.dumps({"counts": told.counts, "most_mb": told.most_mb, "slowest_s": told.slowest_s}))
    return 0


@dataclass
class FileCounts:
    """Count what came of the files of one kind."""

    kind: FileKind
    folder: Path
    counts: dict[str, int] = field(default_factory=dict)
    most_mb: float = 0.0
    slowest_s: float = 0.0

    @property
    def n(self) -> int:
        """Return how many were tried."""
        return sum(self.counts.values())

    def take(
        self,
        data: bytes,
        read: Callable[[Path], object],
        refusals: tuple[type[Exception], ...],
    ) -> None:
        """Have one file read; keep the first of each that went wrong."""
        (self.folder / self.kind.file).write_bytes(data)
        began_s = time.monotonic()
        what, grown_mb = outcome_of(lambda: read(self.folder), refusals)
        if what in FINE and grown_mb > self.kind.bound_mb:
            what = "too much memory"
        self.counts[what] = self.counts.get(what, 0) + 1
        self.most_mb = max(self.most_mb, grown_mb)
        self.slowest_s = max(self.slowest_s, time.monotonic() - began_s)
        if what not in FINE and self.counts[what] == 1:
            _keep(self.folder.parent / "crashes", self.kind.file, data)


def outcome_of(
    read: Callable[[], object], refusals: tuple[type[Exception], ...], limit_s: int = LIMIT_S
) -> tuple[str, float]:
    """Return what came of a reading in a fork of this process, and what memory it took [MB]."""
    ours, theirs = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.close(ours)
        _read_in_fork(read, refusals, theirs, limit_s)
    os.close(theirs)
    ready, _, _ = select.select([ours], [], [], WAITED_S)
    if not ready:
        os.kill(pid, signal.SIGKILL)
    with os.fdopen(ours, "rb") as pipe:
        said = pipe.read().decode()
    _, status = os.waitpid(pid, 0)
    if not ready or (os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU):
        return f"took over {limit_s} s", 0.0
    if status or not said:
        return f"died of {os.waitstatus_to_exitcode(status)}", 0.0
    what, grown_mb = json.loads(said)
    return str(what), float(grown_mb)


def _read_in_fork(
    read: Callable[[], object], refusals: tuple[type[Exception], ...], answers: int, limit_s: int
) -> None:
    """Be the fork: read, say what came of it, and end without running anything of the parent."""
    status = 1
    try:
        before_mb = rss_mb(os.getpid())
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what codecs complain about is not read
        most = _virtual_bytes() + ROOM_MB * 1024 * 1024
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        what = _judge(read, refusals)
        peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6
        said = json.dumps([what, max(0.0, peak_mb - before_mb)])
        os.write(answers, said.encode())
        status = 0
    finally:
        os._exit(status)


def _judge(read: Callable[[], object], refusals: tuple[type[Exception], ...]) -> str:
    try:
        read()
    except refusals as refusal:
        return "refused" if stable(refusal) else f"{type(refusal).__name__} without a code"
    except Exception as crash:  # noqa: BLE001  # whatever it is, it is what was looked for
        return place_of(crash)
    return "read"


def _virtual_bytes() -> int:
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
    return pages * resource.getpagesize()


def _keep(folder: Path, name: str, data: bytes) -> None:
    folder.mkdir(exist_ok=True)
    digest = hashlib.sha256(data).hexdigest()[:12]
    (folder / f"{digest}-{name}").write_bytes(data)


if __name__ == "__main__":
    sys.exit(main())
