"""Hold one language's words for what is said around an order and orders nothing."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class AsideForms:
    """Patterns over clauses of a marked sentence."""

    opening: re.Pattern[str]
    """What goes in front of an order, in its own clause."""
    closing: re.Pattern[str]
    """A reason at the end that no comma parts from the order."""
    joint: re.Pattern[str]
    """Words that join an order to an aside before it."""
    seam: re.Pattern[str]
    """Group ``aside``: a formula, and behind it the word that joins an order to it."""
    praise: re.Pattern[str]
    """A clause of thanks or praise as a whole: alone it is answered."""
    formula: re.Pattern[str]
    """A clause of courtesy as a whole."""
    speaks: re.Pattern[str]
    """Has somebody told or asked something: what follows may be the words for them."""
    states: tuple[re.Pattern[str], ...]
    """Clauses that say how things stand."""
