"""Tell the sentences that can't lead to motion: they need no operator's proof and clear no hold."""

from __future__ import annotations

from planner.brain.intents.kinds import Replace, Resume
from planner.brain.intents.reader import intent_of
from planner.brain.stoplane import is_stop


def stops(text: str) -> bool:
    """Tell whether a sentence orders a stop, at its start or in place of the current goal."""
    intent = intent_of(text)
    return is_stop(text) or (isinstance(intent, Replace) and is_stop(intent.rest))


def stays_put(text: str) -> bool:
    """Tell whether a sentence stops, asks, or is about the planner's own memory and goals alone."""
    intent = intent_of(text)
    return stops(text) or not (intent is None or isinstance(intent, Replace | Resume))
