"""Append results to one file, and find what an interrupted long run has measured already.

One JSON object a line. A slice counts again only on the same commit and machine.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pons.machine import commit, machine, today


@dataclass
class Store:
    """Own the file of results."""

    path: Path
    resume: bool
    commit: str = field(default_factory=commit)
    machine: str = field(default_factory=machine)

    def append(self, kind: str, name: str, content: dict[str, Any]) -> None:
        """Write one line, on disk when this returns to the caller."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        head = {"kind": kind, "name": name, "at": today(), "commit": self.commit}
        line = json.dumps({**head, "machine": self.machine, **content}, ensure_ascii=False)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(line + "\n")

    def slices(self, name: str) -> dict[int, Any]:
        """Return what was measured before, by index; nothing unless this run resumes."""
        found: dict[int, Any] = {}
        if self.resume and self.path.is_file():
            for line in self.path.read_text("utf-8").splitlines():
                entry = _parse_line(line)
                if self._ours(entry, name):
                    found[entry["index"]] = entry["data"]
        return found

    def _ours(self, entry: dict[str, Any], name: str) -> bool:
        same = entry.get("commit") == self.commit and entry.get("machine") == self.machine
        return same and entry.get("kind") == "slice" and entry.get("name") == name


def _parse_line(line: str) -> dict[str, Any]:
    try:
        entry = json.loads(line)
    except ValueError:  # the last line of a run that was cut off
        return {}
    return entry if isinstance(entry, dict) else {}
