"""Know a request that comes again: by its Idempotency-Key, which stands for one request only."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable

from planner.mission.errors import IdempotencyConflict
from planner.mission.journal import MAX_KEYS, GoalKey
from planner.plan import Language


def body_of(text: str, language: Language, confirm: bool, replace: bool) -> str:
    """Return the fingerprint of a request."""
    fields = json.dumps([text, language.value, confirm, replace], ensure_ascii=True)
    return hashlib.sha256(fields.encode()).hexdigest()[:32]


class Repeats:
    """Remember the newest keys and the goals that they made, as many as the journal keeps."""

    def __init__(self, kept: Iterable[GoalKey] = ()) -> None:
        """Begin with what the journal kept, oldest first."""
        self._keys = {each.key: each for each in kept}

    def goal_of(self, key: str | None, body: str) -> str | None:
        """Return the goal that this very request made before, if it did.

        Raises:
            IdempotencyConflict: the key came with another request.
        """
        known = self._keys.get(key) if key is not None else None
        if known is None:
            return None
        if known.body != body:
            raise IdempotencyConflict(known.key, known.goal)
        return known.goal

    def remember(self, key: str | None, body: str, goal_id: str) -> GoalKey | None:
        """Note which goal a request makes; a request without a key is never known again."""
        if key is None:
            return None
        if len(self._keys) >= MAX_KEYS:
            self._keys.pop(next(iter(self._keys)))
        noted = self._keys[key] = GoalKey(key, body, goal_id)
        return noted

    def forget(self, key: str | None) -> None:
        """Let a request come anew: it was not taken."""
        if key is not None:
            self._keys.pop(key, None)
