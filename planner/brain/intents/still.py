"""Tell the sentences that can't lead to motion: they need no operator's proof and clear no hold."""

from __future__ import annotations

from planner.brain.intents.kinds import Replace, Resume
from planner.brain.intents.reader import intent_of
from planner.brain.stoplane import is_stop


def stays_put(text: str) -> bool:
    """Tell whether a sentence stops, asks, or is about the planner's own memory and goals alone."""
    intent = intent_of(text)
    if isinstance(intent, Replace):
        return is_stop(intent.rest)
    return is_stop(text) or (intent is not None and not isinstance(intent, Resume))
