"""Kill processes that write, at any instant, and tell what each had reported as kept."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

FORKED = """
import os, sys
from pathlib import Path

for home in sys.argv[1:]:
    pid = os.fork()
    if not pid:
        numbers = write(Path(home))
        print(os.getpid(), flush=True)
        for number in numbers:
            print(number, flush=True)
    os.waitpid(pid, 0)
    print("over", flush=True)
"""


def kill_writers(write: str, folder: Path, repository: Path) -> Iterator[tuple[Path, int]]:
    """Yield home and last number of three writers, each killed at another phase of a write.

    Args:
        write: source of ``write(home)``, which yields a number as soon as what it wrote is kept.
            Each writer is forked by a process that has all loaded.
        folder: in which their homes lie.
        repository: where it is imported from.
    """
    delays_s = {folder / "a": 0.0, folder / "b": 0.013, folder / "c": 0.037}
    with subprocess.Popen(
        [sys.executable, "-c", write + FORKED, *map(str, delays_s)],
        stdout=subprocess.PIPE,
        cwd=repository,
    ) as child:
        assert child.stdout is not None
        for home, delay_s in delays_s.items():
            writer = int(child.stdout.readline())
            last = [int(child.stdout.readline()) for _ in range(5)][-1]
            time.sleep(delay_s)  # the phase of the kill within a write, not a wait for anything
            os.kill(writer, signal.SIGKILL)
            while not (line := child.stdout.readline()).endswith(b"over\n"):
                last = int(line)  # one that the kill cut short stands before "over": no number
            yield home, last
    assert child.returncode == 0
