"""Read English and Chinese orders by grammar, in the site's own names, into a plan."""

from planner.language.grammar.context import Context
from planner.language.grammar.parser import means_already, plan
from planner.language.grammar.sentence_text import MAX_CHARACTERS

__all__ = ["MAX_CHARACTERS", "Context", "means_already", "plan"]
