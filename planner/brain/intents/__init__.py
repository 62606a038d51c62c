"""Tell what a person says to the planner itself, before any brain: pause, go on, remember this.

Pure, both languages, whole sentences only. The one door of this package.
"""

from planner.brain.intents.kinds import (
    Cancel,
    Doing,
    Faster,
    Forget,
    Intent,
    Pause,
    Remember,
    Replace,
    Resume,
    Slower,
    Where,
)
from planner.brain.intents.names import name_reads_as_order
from planner.brain.intents.reader import intent_of

__all__ = [
    "Cancel",
    "Doing",
    "Faster",
    "Forget",
    "Intent",
    "Pause",
    "Remember",
    "Replace",
    "Resume",
    "Slower",
    "Where",
    "intent_of",
    "name_reads_as_order",
]
