"""Read English and Chinese orders by grammar, in the site's own names, into a plan."""

from planner.language.grammar.input_checks import MAX_CHARACTERS
from planner.language.grammar.parser import Context, plan

__all__ = ["MAX_CHARACTERS", "Context", "plan"]
