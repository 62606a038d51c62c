"""Feed one decoder mutants and tell what came of it: ``python -m tools.attack.fuzz DECODER``.

Run as a child process: a decoder that takes the interpreter with it costs its own figures alone.
The last line of standard output is JSON. The same seed tries the same inputs in the same order.
"""

from __future__ import annotations

import argparse
import gc
import hashlib
import json
import os
import signal
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from tools.attack.decoders import BY_NAME, AttackedDecoder, Reader
from tools.attack.mutators import mutant
from tools.bench.processes import rss_mb

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import FrameType

HERE = Path(__file__).parent
HANG_S = 5.0
WARM = 2_000
"""Inputs until caches, patterns and arenas are as large as they get; memory counts from there."""
MOST_KEPT = 10
"""Crashes that are written down; of a decoder that always crashes one is as good as all."""


class Hang(BaseException):
    """An input took more processor time than any may."""


@dataclass
class Tally:
    """Count what came of one decoder's inputs."""

    decoder: str
    seed: int
    n: int = 0
    taken: int = 0
    crashes: int = 0
    hangs: int = 0
    slowest_ms: float = 0.0
    before_mb: float = 0.0
    after_mb: float = 0.0
    kinds: dict[str, int] = field(default_factory=dict)
    """Crashes by exception and the line that raised it."""


def fuzz(decoder: AttackedDecoder, folder: Path, *, seed: int, count: int, seconds: float) -> Tally:
    """Try so many mutants, or as many as there is time for.

    Args:
        decoder: what is tried.
        folder: the decoder's own, empty.
        seed: of the mutants.
        count: at most so many inputs.
        seconds: after which no further input is begun.
    """
    reader, seeds = decoder.prepare(folder), list(decoder.seeds())
    told, random = Tally(decoder.name, seed), Random(seed)
    for given in seeds:
        if not reader.takes(given) and decoder.name not in MIXED:
            raise ValueError(f"{decoder.name}: a seed is refused: {given[:80]!r}")
    before = signal.signal(signal.SIGPROF, _hang)
    end_s = time.monotonic() + seconds
    try:
        while told.n < count and time.monotonic() < end_s:
            _try(reader, mutant(seeds, random, decoder.most_bytes), told, folder)
            if told.n == min(WARM, count // 2):
                told.before_mb = _rss_mb()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    told.after_mb = _rss_mb()
    told.before_mb = told.before_mb or told.after_mb
    return told


MIXED = frozenset({"toml", "yaml"})
"""Decoders that read each input as two kinds of file: a good one is refused as the other."""


def _try(reader: Reader, data: bytes, told: Tally, folder: Path) -> None:
    told.n += 1
    began_s = time.perf_counter()
    signal.setitimer(signal.ITIMER_PROF, HANG_S)
    try:
        told.taken += reader.takes(data)
    except Hang:
        told.hangs += 1
        _note("hang", data, told, folder)
    except Exception as crash:  # noqa: BLE001  # whatever it is, it is what was looked for
        told.crashes += 1
        _note(place_of(crash), data, told, folder)
    signal.setitimer(signal.ITIMER_PROF, 0.0)
    told.slowest_ms = max(told.slowest_ms, (time.perf_counter() - began_s) * 1e3)


def place_of(crash: BaseException) -> str:
    """Return an exception's class and the last line of ours that it came through."""
    trace, where = crash.__traceback__, ""
    while trace is not None:
        name = trace.tb_frame.f_code.co_filename
        if "site-packages" not in name and Path(name).parent != HERE:
            where = f"{Path(name).name}:{trace.tb_lineno}"
        trace = trace.tb_next
    return f"{type(crash).__name__} at {where}"


def _note(kind: str, data: bytes, told: Tally, folder: Path) -> None:
    """Count a crash by its kind, and keep the first input of each."""
    told.kinds[kind] = told.kinds.get(kind, 0) + 1
    if told.kinds[kind] == 1 and len(told.kinds) <= MOST_KEPT:
        kept = folder.parent / "crashes"
        kept.mkdir(exist_ok=True)
        digest = hashlib.sha256(data).hexdigest()[:12]
        (kept / f"{told.decoder}-{digest}").write_bytes(data)
        print(f"{told.decoder}: {kind}: {data[:120]!r}", file=sys.stderr, flush=True)


def _hang(_number: int, _frame: FrameType | None) -> None:
    raise Hang


def _rss_mb() -> float:
    gc.collect()
    return rss_mb(os.getpid())


def main(arguments: Sequence[str] | None = None) -> int:
    """Fuzz one decoder; the exit status is 0 whatever was found, for it is told."""
    parser = argparse.ArgumentParser(prog="python -m tools.attack.fuzz", description=__doc__)
    parser.add_argument("decoder", choices=sorted(BY_NAME))
    parser.add_argument("--folder", type=Path, required=True, help="an empty folder of its own")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=1_000_000)
    parser.add_argument("--seconds", type=float, default=10.0)
    given = parser.parse_args(arguments)
    told = fuzz(BY_NAME[given.decoder], given.folder, seed=given.seed, count=given.count,
                seconds=given.seconds)  # fmt: skip
    print(json.dumps(asdict(told)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
