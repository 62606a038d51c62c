"""Own one day's file of the ledger: appended lines, and their sum. Knows no other day."""

from __future__ import annotations

import errno
import json
import os
from pathlib import Path

from planner.budget.totals import Spent

MAX_READ_BYTES = 64_000_000
MAX_ID = 80
_FIELDS = ("calls", "prompt_tokens", "reply_tokens", "seconds", "money")
_UNREADABLE = Spent(calls=1)

Line = tuple[str, Spent]


class Page:
    """Be one file; not made before something is written."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.spent = Spent()
        self._file = -1
        self._read = 0
        self._rest = b""

    @property
    def file(self) -> int:
        """Return the open file, or -1."""
        return self._file

    def append(self, goal: str, change: Spent) -> None:
        """Write a line. Raises OSError."""
        self._open(make=True)
        record: dict[str, object] = {"goal": goal[:MAX_ID]}
        for name in _FIELDS:
            if value := round(getattr(change, name), 9):
                record[name] = value
        begin = "\n" if self._cut_off() else ""  # a full disk cut the line before, anybody's
        line = f"{begin}{json.dumps(record)}\n".encode()
        if os.write(self._file, line) != len(line):
            raise OSError(errno.ENOSPC, "the line was cut off")

    def fresh(self) -> list[Line]:
        """Return the lines since the last look, by whichever program. Raises OSError."""
        self._open(make=False)
        if self._file < 0:
            return []
        size = os.fstat(self._file).st_size - self._read
        if size <= 0:
            return []
        more = os.pread(self._file, min(size, MAX_READ_BYTES), self._read)
        self._read += len(more)
        whole, _, self._rest = (self._rest + more).rpartition(b"\n")
        lines = [_read_line(line) for line in whole.split(b"\n") if line.strip()]
        for _, change in lines:
            self.spent += change
        return lines

    def close(self) -> None:
        """Give the file back; what was read stays known."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    def _open(self, *, make: bool) -> None:
        if self._file >= 0 or not (make or self.path.exists()):
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        flags = os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC
        self._file = os.open(self.path, flags, 0o600)
        if self._cut_off():  # by a crash
            os.write(self._file, b"\n")

    def _cut_off(self) -> bool:
        """Tell whether the last line has no end, so that another would be glued to it."""
        size = os.fstat(self._file).st_size
        return size > 0 and os.pread(self._file, 1, size - 1) != b"\n"


def _read_line(line: bytes) -> Line:
    """Return a line's goal and change; one that can't be read counts as a call."""
    try:
        record = json.loads(line)
        goal = record.pop("goal")
        right = isinstance(goal, str) and all(
            isinstance(value, int | float) and abs(value) <= 1e12 for value in record.values()
        )
        return (goal, Spent(**record)) if right else ("", _UNREADABLE)
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return "", _UNREADABLE
