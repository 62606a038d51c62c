"""Read what a sentence changes about the newest order: one table of rows a language.

``rows`` reads them knowing no name, so that the door may ask it; ``reader`` adds the names of a
site, and with them all of the guard and the grammar.
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
