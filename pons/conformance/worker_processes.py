"""Keep one helper process loaded ahead of need, and end those that were lent."""

from __future__ import annotations

import json
import subprocess
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pons.conformance.adapter import Adapter

PUPPET, FLOODER = "puppet", "flooder"
"""What a helper can be."""
PATIENCE_S = 2.0


class HelperLost(Exception):
    """A helper did not give its expected line."""


class Helper:
    """Hold one helper process."""

    def __init__(self, command: Sequence[str]) -> None:
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ready(self) -> None:
        """Wait until it has loaded. Raises HelperLost."""
        self._hear("ready")

    def go(self, task: dict[str, Any]) -> None:
        """Let it begin; return when it has. Raises HelperLost."""
        if self.process.stdin is not None:
            self.process.stdin.write(json.dumps(task).encode() + b"\n")
            self.process.stdin.flush()
        self._hear("going")

    def end(self) -> str:
        """Let it finish, else kill it; return the rest of its lines."""
        try:
            said, _ = self.process.communicate(timeout=PATIENCE_S)
        except (subprocess.TimeoutExpired, ValueError, OSError):
            self.process.kill()
            self.process.wait()
            return ""
        return said.decode(errors="replace") if said else ""

    def _hear(self, word: str) -> None:
        line = self.process.stdout.readline().strip() if self.process.stdout else b""
        if line != word.encode():
            raise HelperLost(f"a helper said {line!r} instead of {word}")


class HelperPool:
    """Lend helpers; loading one takes longer than the fault that it is for."""

    def __init__(self, adapter: Adapter) -> None:
        self._adapter = adapter
        self._spare: Helper | None = None

    def load(self) -> None:
        """Begin to load the next one, if none is."""
        if self._spare is None:
            self._spare = Helper(self._adapter.helper())

    def take(self) -> Helper:
        """Return a loaded helper; its taker ends it."""
        self.load()
        helper, self._spare = self._spare, None
        if helper is None:
            raise HelperLost("no helper was loaded")
        try:
            helper.ready()
        except HelperLost:
            helper.end()
            raise
        return helper

    def close(self) -> None:
        """End the spare one."""
        if self._spare is not None:
            self._spare.end()
            self._spare = None
