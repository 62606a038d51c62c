"""Give an attack what it needs: a place for its files, and child processes that end in time."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tools.attack.outcome import AttackOutcome

MEMORY = Path("/dev/shm")


class Attack(Protocol):
    """Be one attack: a module with these names."""

    NAME: str
    TITLE: str

    @staticmethod
    def attack(lab: AttackLab) -> list[AttackOutcome]:
        """Attack and return the lines of a table."""


@dataclass(frozen=True)
class AttackLab:
    """Serve one attack."""

    home: Path
    """Where results and inputs that broke something are kept."""
    long: bool = False
    seed: int = 1

    def say(self, text: str) -> None:
        """Show progress on standard error."""
        print(f"attack: {text}", file=sys.stderr, flush=True)

    def child(self, module: str, what: str, folder: Path, seconds: float, count: int) -> list[str]:
        """Return the words after ``python -m`` for a child that tries one thing in a folder."""
        bounds = ["--seed", str(self.seed), "--seconds", str(seconds), "--count", str(count)]
        return [module, what, "--folder", str(folder), *bounds]

    def keep(self, folder: Path) -> None:
        """Take over the inputs that broke something, so that they can be tried again."""
        for path in sorted(folder.glob("crashes/*")):
            kept = self.home / "crashes"
            kept.mkdir(exist_ok=True)
            (kept / path.name).write_bytes(path.read_bytes())

    @contextmanager
    def folder(self) -> Iterator[Path]:
        """Lend an empty folder, in memory where there is such a place."""
        where = MEMORY if os.access(MEMORY, os.W_OK) else None
        with TemporaryDirectory(prefix="pa-", dir=where, ignore_cleanup_errors=True) as name:
            yield Path(name)


@dataclass(frozen=True)
class ChildEnd:
    """Hold how a child ended."""

    status: int | None
    """None: it was killed, for its time was up."""
    said: str
    complained: str

    @property
    def last_record(self) -> dict[str, Any] | None:
        """Return the JSON of the last line it said; None where that is none."""
        try:
            found = json.loads(self.said.splitlines()[-1])
        except (ValueError, IndexError):
            return None
        return found if isinstance(found, dict) else None


def side_by_side(
    commands: Sequence[Sequence[str]], limit_s: float
) -> Iterator[tuple[int, ChildEnd]]:
    """Run Python modules in child processes, one a processor; yield each as it ends.

    Args:
        commands: words after ``python -m``.
        limit_s: after which a child is killed.
    """
    from concurrent.futures import ThreadPoolExecutor, as_completed

    with ThreadPoolExecutor(max_workers=max(1, len(os.sched_getaffinity(0)))) as pool:
        running = {pool.submit(_run, words, limit_s): at for at, words in enumerate(commands)}
        for done in as_completed(running):
            yield running[done], done.result()


def _run(words: Sequence[str], limit_s: float) -> ChildEnd:
    command = [sys.executable, "-m", *words]
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        start_new_session=True,
    ) as child:  # fmt: skip
        try:
            said, complained = child.communicate(timeout=limit_s)
            status: int | None = child.returncode
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            said, complained = child.communicate()
            status = None
    return ChildEnd(status, said.decode("utf-8", "replace"), complained.decode("utf-8", "replace"))
