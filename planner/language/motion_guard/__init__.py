"""Judge by a person's own words which steps of a plan move the robot though nobody asked for it.

Each step names the words that ask for it; the clause around them is judged. Asks no brain what a
sentence means; the learned reader's word that it orders nothing may add a question, and spares
none.
"""

from planner.language.motion_guard.clauses import denied_places
from planner.language.motion_guard.unasked_motion import (
    PersonWords,
    UnaskedStep,
    find_unasked,
    said_words,
)

__all__ = ["PersonWords", "UnaskedStep", "denied_places", "find_unasked", "said_words"]
