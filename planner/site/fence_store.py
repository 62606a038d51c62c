"""Keep proposed fences in ``$PONS_HOME/fence/proposals`` until an operator decides. Owns the files.

A proposal is named by the hash of its text, the same that status will show once it is in force, so
its name can't stay when its text changes. Proposing puts nothing in force.
"""

from __future__ import annotations

import os
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Literal

from pydantic import ValidationError

from maps.yaml_records import Record
from planner.site.fence_check import FenceRefused
from wire.bounded_types import Code, Fingerprint, Name
from wire.fence import fence_text
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from wire import FenceFile

MAX_OPEN = 16
MAX_KEPT = 64
"""Decided ones, newest first; the audit of what came into force is the bridge's."""

State = Literal["proposed", "accepted", "rejected"]


class FenceProposal(Record):
    """Hold one proposal and what became of it."""

    id: Fingerprint
    text: str
    """What would be fence.json, byte by byte: what is reviewed, signed and written."""
    by: Name
    created: datetime
    state: State = "proposed"
    decided_by: Name | None = None
    decided: datetime | None = None
    reason: Code | None = None
    """Why the bridge refused it last, where it did."""


def _now() -> datetime:
    return datetime.now(UTC)


class FenceProposals:
    """Be the folder of proposals. Reads and writes files: call it off the event loop."""

    def __init__(self, folder: Path, clock: Callable[[], datetime] = _now) -> None:
        self._folder = folder
        self._clock = clock

    def propose(self, fence: FenceFile, by: str) -> FenceProposal:
        """Keep a proposal; the same text again is the same proposal, open anew.

        Raises:
            FenceRefused: ``fence_proposals_full``.
        """
        text = fence_text(fence)
        name = fingerprint(text.encode())
        waiting = [item for item in self.all() if item.state == "proposed" and item.id != name]
        if not len(waiting) < MAX_OPEN:
            text = f"{len(waiting)} proposals wait for an operator, at most {MAX_OPEN}"
            raise FenceRefused("fence_proposals_full", f"{text}; reject some first")
        return self._write(FenceProposal(id=name, text=text, by=by, created=self._clock()))

    def all(self) -> list[FenceProposal]:
        """Return the proposals, newest first; a file that is none of ours is left alone."""
        found = [self._read(path) for path in self._folder.glob("*.json")]
        return sorted(
            (item for item in found if item is not None),
            key=lambda item: (item.created, item.id),
            reverse=True,
        )

    def get(self, name: str) -> FenceProposal:
        """Return one.

        Raises:
            FenceRefused: ``unknown_fence_proposal``.
        """
        for item in self.all():
            if item.id == name:
                return item
        known = ", ".join(item.id for item in self.all()[:8]) or "none"
        raise FenceRefused("unknown_fence_proposal", f"no proposal {name!r}; there are: {known}")

    def decide(self, name: str, state: State, by: str, reason: str | None = None) -> FenceProposal:
        """Write down what became of one.

        Raises:
            FenceRefused: ``unknown_fence_proposal``.
        """
        change = {"state": state, "decided_by": by, "decided": self._clock(), "reason": reason}
        item = self._write(self.get(name).model_copy(update=change))
        for old in [item for item in self.all() if item.state != "proposed"][MAX_KEPT:]:
            self._path(old.id).unlink(missing_ok=True)
        return item

    def _path(self, name: str) -> Path:
        return self._folder / f"{name}.json"

    def _read(self, path: Path) -> FenceProposal | None:
        """Return a proposal whose name is still that of its text."""
        try:
            item = FenceProposal.model_validate_json(path.read_bytes())
        except (OSError, ValidationError):
            return None
        fits = item.id == path.stem and fingerprint(item.text.encode()) == item.id
        return item if fits else None

    def _write(self, item: FenceProposal) -> FenceProposal:
        self._folder.mkdir(parents=True, exist_ok=True)
        path = self._path(item.id)
        beside = path.with_suffix(".new")
        with beside.open("wb") as file:
            file.write(item.model_dump_json(indent=1).encode())
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
        return item
