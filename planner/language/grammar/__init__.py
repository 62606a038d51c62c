"""Read English and Chinese orders by grammar, in the site's own names, into a plan."""

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.language.grammar.sentence_text import MAX_CHARACTERS

__all__ = ["MAX_CHARACTERS", "Context", "plan"]
