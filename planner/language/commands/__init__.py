"""Tell what a person says to the planner itself, before any brain: pause, go on, remember this.

Pure, both languages, whole sentences only. The one door of this package.
"""

from planner.language.commands.command import (
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
from planner.language.commands.parser import intent_of

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
]
