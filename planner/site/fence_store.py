"""Keep proposed fences, as a table of ``$PONS_HOME``, until an operator decides.

A proposal is named by the hash of its text, the same that status will show once it is in force, so
its name can't stay when its text changes. Proposing puts nothing in force.
"""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING, Literal

from pydantic import ValidationError

from maps.yaml_records import SiteRecord
from planner.site.fence_check import FenceRefusal
from planner.state_database import StateDatabase
from wire.bounded_types import Code, Fingerprint, Name
from wire.fence import fence_text
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Callable
    from pathlib import Path

    from wire import FenceFile

MAX_OPEN = 16
MAX_KEPT = 64
"""Decided ones, newest first; the audit of what came into force is the bridge's."""

State = Literal["proposed", "accepted", "rejected"]


class FenceProposal(SiteRecord):
    """Hold one proposal and the decision on it."""

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


def _read_clock() -> datetime:
    return datetime.now(UTC)


class FenceProposals:
    """Be the table of proposals. Reads and writes the disk: call it off the event loop."""

    def __init__(
        self, database: StateDatabase, old_folder: Path, clock: Callable[[], datetime] = _read_clock
    ) -> None:
        """Say where they are kept, and where files of the layout before may lie."""
        self._database, self._old_folder = database, old_folder
        self._clock = clock

    @classmethod
    def in_home(
        cls,
        home: Path,
        database: StateDatabase | None = None,
        clock: Callable[[], datetime] = _read_clock,
    ) -> FenceProposals:
        """Return the proposals of a home folder."""
        return cls(database or StateDatabase(home), home / "fence" / "proposals", clock)

    def propose(self, fence: FenceFile, by: str) -> FenceProposal:
        """Keep a proposal; the same text again is the same proposal, open anew.

        Raises:
            FenceRefusal: ``fence_proposals_full``.
        """
        text = fence_text(fence)
        name = fingerprint(text.encode())
        waiting = [item for item in self.list_all() if item.state == "proposed" and item.id != name]
        if not len(waiting) < MAX_OPEN:
            text = f"{len(waiting)} proposals wait for an operator, at most {MAX_OPEN}"
            raise FenceRefusal("fence_proposals_full", f"{text}; reject some first")
        return self._write(FenceProposal(id=name, text=text, by=by, created=self._clock()))

    def list_all(self) -> list[FenceProposal]:
        """Return the proposals, newest first; a row that is none of ours is left alone."""
        try:
            self._database.take_over(self._old_folder, self._import)
            rows = self._database.read("SELECT id, record FROM fence_proposals")
            found = [_read(name, record) for name, record in rows]
        except OSError:  # a disk that can't be written at present can be read all the same
            found = self._old_proposals()
        return sorted(
            (item for item in found if item is not None),
            key=lambda item: (item.created, item.id),
            reverse=True,
        )

    def get(self, name: str) -> FenceProposal:
        """Return one.

        Raises:
            FenceRefusal: ``unknown_fence_proposal``.
        """
        for item in self.list_all():
            if item.id == name:
                return item
        known = ", ".join(item.id for item in self.list_all()[:8]) or "none"
        raise FenceRefusal("unknown_fence_proposal", f"no proposal {name!r}; there are: {known}")

    def decide(self, name: str, state: State, by: str, reason: str | None = None) -> FenceProposal:
        """Write down the decision on a proposal.

        Raises:
            FenceRefusal: ``unknown_fence_proposal``.
        """
        change = {"state": state, "decided_by": by, "decided": self._clock(), "reason": reason}
        item = self._write(self.get(name).model_copy(update=change))
        gone = [item for item in self.list_all() if item.state != "proposed"][MAX_KEPT:]
        if gone:
            with self._database.change() as connection:
                statement = "DELETE FROM fence_proposals WHERE id = ?"
                connection.executemany(statement, [(old.id,) for old in gone])
        return item

    def _write(self, item: FenceProposal) -> FenceProposal:
        self._database.take_over(self._old_folder, self._import)
        with self._database.change() as connection:
            _put(connection, item)
        return item

    def _import(self, connection: sqlite3.Connection) -> None:
        for item in self._old_proposals():
            if item is not None:
                _put(connection, item)

    def _old_proposals(self) -> list[FenceProposal | None]:
        """Return those of the layout before, a file each; one that is none of ours is left."""
        return [_read_file(path) for path in self._old_folder.glob("*.json")]


def _put(connection: sqlite3.Connection, item: FenceProposal) -> None:
    row = (item.id, item.model_dump_json())
    connection.execute("REPLACE INTO fence_proposals VALUES (?, ?)", row)


def _read_file(path: Path) -> FenceProposal | None:
    try:
        return _read(path.stem, path.read_bytes())
    except OSError:
        return None


def _read(name: str, record: str | bytes) -> FenceProposal | None:
    """Return a proposal whose name is still that of its text."""
    try:
        item = FenceProposal.model_validate_json(record)
    except ValidationError:
        return None
    return item if item.id == name and fingerprint(item.text.encode()) == item.id else None
