"""Leave out of a sentence with a condition what changes nothing of its branches. Pure.

"Otherwise stay here" is a branch in which nothing is done, "go to the bedroom instead" the order
itself: what else is under way, a condition does not end.
"""

from __future__ import annotations

import re

from planner.language.folding import has_chinese
from planner.language.grammar.zh.condition_phrases import plain_conditions
from planner.language.grammar.zh.wait_phrases import plain_waits

_IDLE = re.compile(
    r"[,;.]? ?(?:and |but )?(?:otherwise|or else|else|if not)(?:,| then)? (?:just |please )*"
    r"(?:(?:stay|wait|remain|stand)(?: (?:here|there|put|still|where you are))+|do nothing"
    r"|(?:do not|don't) (?:do anything|move))$"
    r"|[,;。]?(?:否则的?话?|不然的?话?|要不然|没有的?话?)[,]?(?:就|便)?"
    r"(?:留在?|待在?|呆在?|停在?|站在?)?(?:(?:这里|这儿|原地|原处)(?:不动|等着|别动)?|待着|不动"
    r"|什么(?:都|也)(?:不做|别做|不用做))$"
)
_NEVER_MIND = re.compile(
    r"(?P<if>\b(?:if|otherwise|else)\b[^,;.]*?)(?:, | )"
    r"(?:that is (?:fine|ok|okay|all right)|never mind|no (?:matter|worries|problem)|not to worry"
    r"|do not worry)(?: about (?:it|that))?"
    r"(?:,| and| then| but| just| please)* (?=(?:go|come|drive|return|stay|head|say|tell|ask)\b)"
)
"""Behind a condition it takes nothing back that was ordered."""
_INSTEAD = re.compile(
    r"(?<=[a-z]) instead(?=$|[,;.]? (?:and |but )?(?:otherwise|or else|else|if not)\b)"
    r"|(?<=[,就便则])改(?=[去到])"
)


def plain_branches(said: str) -> str:
    """Return a normalised sentence without an idle branch, and without "instead" at an order."""
    plain = _NEVER_MIND.sub(r"\g<if>, ", said.strip(" ,.!?;。"))
    plain = _INSTEAD.sub("", _IDLE.sub("", plain))
    return plain_waits(plain_conditions(plain)) if has_chinese(plain) else plain
