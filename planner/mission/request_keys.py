"""Know a request again by its key: the same key and request are the same goal, for good.

Knows which goal each key made; decides nothing about words.
"""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING

from planner.mission.errors import JournalDown
from planner.mission.events import Cancel, Submitted
from planner.mission.journal import MAX_KEYS
from planner.mission.state import GoalKey

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable

    from planner.mission.loop import Loop


class Repeats:
    """Remember the newest keys of requests and the goals they made, as many as the journal does."""

    def __init__(self, kept: Iterable[GoalKey] = ()) -> None:
        """Begin with the journal's keys, oldest first."""
        self.recall(kept)
        self.find_older: Callable[[str], Awaitable[GoalKey | None]] | None = None
        """Looks in all that was ever kept."""

    async def look_up(self, key: str | None) -> None:
        """Take up a key that is older than those remembered, where more may be kept than these."""
        if key is None or self.find_older is None or not self.may_be_older(key):
            return
        if (older := await self.find_older(key)) is not None:
            self.remember(older)

    def may_be_older(self, key: str | None) -> bool:
        """Return whether the disk may know a key that is not at hand: others were dropped."""
        return key is not None and key not in self._keys and len(self._keys) >= MAX_KEYS

    def recall(self, kept: Iterable[GoalKey]) -> None:
        """Take up the journal's keys, oldest first."""
        self._keys = {each.key: each for each in kept}

    def find(self, key: str | None) -> GoalKey | None:
        """Return the request that came with a key before, or None; without a key none is known."""
        return self._keys.get(key) if key is not None else None

    def remember(self, request: GoalKey | None) -> None:
        """Remember a request that was taken in; one without a key is never known again."""
        if request is None:
            return
        if len(self._keys) >= MAX_KEYS:
            self._keys.pop(next(iter(self._keys)))
        self._keys[request.key] = request

    async def ensure_written(self, loop: Loop, goal_id: str, request: GoalKey | None) -> None:
        """Wait until a goal is written down; take back and forget one that can't be.

        Raises:
            JournalDown: it can't be.
        """
        try:
            await loop.wait_written()
        except JournalDown:
            loop.event(Cancel(goal_id))
            self.forget(request)
            raise

    def forget(self, request: GoalKey | None) -> None:
        """Let a request come anew: it was not taken."""
        if request is not None:
            self._keys.pop(request.key, None)


def body_of(given: Submitted) -> str:
    """Return the fingerprint of a request, as it came."""
    asked: list[object] = [given.text, given.language.value, given.confirm, given.replace]
    asked += [point.model_dump(mode="json") for point in given.points]
    fields = json.dumps(asked, ensure_ascii=True)
    return hashlib.sha256(fields.encode()).hexdigest()[:32]


def request_of(given: Submitted, key: str | None) -> GoalKey | None:
    """Return what is remembered of a request; None without a key."""
    return GoalKey(key, body_of(given), given.id) if key is not None else None
