"""Judge by a person's words alone which steps of a plan move the robot though nobody asked for it.

Pure text search: it shares no code with a model, and asks the grammar only as a second reader.
"""

from planner.language.motion_guard.order_scope import OrderScope, read_scope
from planner.language.motion_guard.unasked_motion import (
    PersonWords,
    UnaskedStep,
    find_unasked,
    said_words,
)

__all__ = [
    "OrderScope",
    "PersonWords",
    "UnaskedStep",
    "find_unasked",
    "read_scope",
    "said_words",
]
