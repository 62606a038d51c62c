"""Tell what hangs on a condition and was not read, where the condition itself can be checked.

"If there is somebody in the study, sing" is refused as a whole. Its condition is no obstacle, and
who hears that it is says the same order without it. Law: the refusal keeps its code, nothing moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.folding import has_chinese
from planner.language.grammar.checks import condition_in
from planner.language.grammar.sentence_text import normalise
from planner.plan import AnswerPlan, Clarify, Code, If, Refuse, StepPlan

if TYPE_CHECKING:
    from collections.abc import Callable

    PlanOf = Callable[[str], StepPlan | AnswerPlan | Clarify | Refuse]

_WAITS = (", wait five seconds", "就等五秒")
"""An order that every robot carries out, in English and Chinese: only the condition is tried."""
_MARKS = " ,.;:!?。、"


def tell_unread(refused: Refuse, text: str, plan_of: PlanOf) -> Refuse:
    """Return a refusal of a condition, with what was not read in place of what can be checked.

    Args:
        refused: by which the sentence was refused.
        text: the sentence, as it was said.
        plan_of: reads a sentence.
    """
    said = normalise(text)
    condition = condition_in(said) if refused.code is Code.CONDITIONAL else None
    if condition is None:
        return refused
    rest = said.replace(condition, " ", 1).strip(_MARKS)
    tried = plan_of(f"{condition}{_WAITS[has_chinese(condition)]}")
    if not rest or not isinstance(tried, StepPlan) or not isinstance(tried.steps[0], If):
        return refused
    return Refuse(code=refused.code, reason=say("grammar.branch_unread", part=condition, rest=rest))
