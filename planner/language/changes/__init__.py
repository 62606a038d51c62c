"""Read what a sentence changes about the newest order: one table of rows a language.

``reader`` reads them, with the names of a site masked.
"""

from __future__ import annotations

from typing import NamedTuple

from planner.plan import Edit


class Row(NamedTuple):
    """Say which whole sentence is which act; named groups fill the slots of its ``Change``."""

    act: Edit
    sentence: str
    fills: str = ""
    """Slots that the sentence fills by itself: marks, ``kind=count``, at the end ``words=…``."""
