"""Tell an order to stop from every other sentence: the one place where "stop" is read.

``lane`` reads; ``en``, ``en_orders`` and ``zh`` hold its words. Standard library alone.
"""

from planner.language.stop.lane import (
    MAX_READ,
    StopReading,
    calls_stop,
    is_stop,
    read_stop,
    words_behind_stop,
)

__all__ = ["MAX_READ", "StopReading", "calls_stop", "is_stop", "read_stop", "words_behind_stop"]
