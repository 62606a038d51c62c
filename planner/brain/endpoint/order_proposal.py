"""Turn a model's step about standing orders into a question with one offer, or say why not. Pure.

Law: the offer is a sentence that the clock's grammar reads whole, as the step means it; whatever
else a model writes about an order is none. Nothing is kept but by a person's yes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from planner.language.folding import fold_words, has_chinese
from planner.language.order_sentence import is_order_sentence, offer_order, write_order
from planner.language.schedule import ChangeOrders, CorrectOrder
from planner.plan import Clarify
from planner.plan.order_steps import ORDER_STEPS

if TYPE_CHECKING:
    from planner.language.commands import Intent


def propose_order(steps: list[Any]) -> Clarify | str | None:
    """Return the question that a step about an order is, or why it is none.

    None where no step is about an order.
    """
    kinds = [str(step.get("kind")) for step in steps if isinstance(step, dict)]
    if not any(kind in ORDER_STEPS for kind in kinds):
        return None
    if len(steps) != 1:
        return f"{', '.join(map(str, kinds))[:80]}: a step about a standing order stands alone"
    known = set(ORDER_STEPS[kinds[0]].model_fields)
    given = {name: value for name, value in steps[0].items() if name in known and value}
    try:
        step = ORDER_STEPS[kinds[0]].model_validate(given)
    except ValidationError:
        return f"{kinds[0]} needs {', '.join(sorted(known - {'kind'}))}, each in a few plain words"
    text = write_order(step)
    if not is_order_sentence(text, step):
        return (
            f"“{text[:120]}” is no standing order: due is a time such as “every day at 20:00”, "
            "“tomorrow at nine”, “in 20 minutes”; order is one plain order; which is a word of it"
        )
    return offer_order(text)


def names_order(intent: Intent | None, own: tuple[str, ...]) -> bool:
    """Tell whether a change names its order in the person's own words, wherever it came from."""
    if not isinstance(intent, ChangeOrders | CorrectOrder):
        return False
    heard = fold_words(" ".join(own))
    which = re.sub(r"\bones?\b", "", intent.which)
    words = [which] if has_chinese(which) else which.split()
    return bool(words) and all(word in heard for word in words)
