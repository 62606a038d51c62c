"""Count the changes among the known things, for a client that asks since when."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.perception.snapshot import Thing

    Things = tuple[Thing, ...]


class Changes:
    """Compare the things known before with those of now."""

    def __init__(self) -> None:
        self.version = 0
        """Rises when a thing comes, goes, or gets another colour or room."""
        self.changed_s: dict[str, float] = {}
        """When each thing was last seen or doubted."""

    def note(self, old: Things, new: Things, now_s: float) -> None:
        """Take the things known now in place of the former ones."""
        before = {thing.id: thing for thing in old}
        for thing in new:
            if before.get(thing.id) is not thing:
                self.changed_s[thing.id] = now_s
        if _marks(new) != _marks(old):
            self.version += 1
            self.changed_s = {thing.id: self.changed_s[thing.id] for thing in new}


def _marks(things: Things) -> set[tuple[str, str | None, str | None]]:
    return {(thing.id, thing.color, thing.room) for thing in things}
