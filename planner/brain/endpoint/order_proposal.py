"""Turn a model's step about standing orders into a question with one offer, or say why not. Pure.

Law: the offer is a sentence that the clock's grammar reads whole, as the step means it; whatever
else a model writes about an order is none. Nothing is kept but by a person's yes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from planner.language.catalogue import say
from planner.language.folding import fold_words, has_chinese
from planner.language.schedule import ChangeOrders, CorrectOrder, Retime, ScheduleCommand
from planner.language.sentence import parse
from planner.plan import Clarify, Code, Option, say_same
from planner.plan.order_steps import ORDER_STEPS, OrderAdd, OrderChange, OrderRemove

if TYPE_CHECKING:
    from planner.language.commands import Intent

_ID = re.compile(r"o\d{1,6}")


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
    text = _sentence(step)
    if not _is_read(step, parse(text).intent):
        return (
            f"“{text[:120]}” is no standing order: due is a time such as “every day at 20:00”, "
            "“tomorrow at nine”, “in 20 minutes”; order is one plain order; which is a word of it"
        )
    option = Option(label=say_same(text), text=text)
    question = say("standing.proposed", order=text)
    return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(option,))


def names_order(intent: Intent | None, own: tuple[str, ...]) -> bool:
    """Tell whether a change names its order in the person's own words, wherever it came from."""
    if not isinstance(intent, ChangeOrders | CorrectOrder):
        return False
    heard = fold_words(" ".join(own))
    which = re.sub(r"\bones?\b", "", intent.which)
    words = [which] if has_chinese(which) else which.split()
    return bool(words) and all(word in heard for word in words)


def _sentence(step: object) -> str:
    match step:
        case OrderAdd(due=due, order=order):
            return f"{due}{order}" if has_chinese(order) else f"{due} {order}"
        case OrderChange(which=which, due=due) if _ID.fullmatch(which):
            chinese = has_chinese(due)
            return (
                f"更改任务{which}：改成{due}" if chinese else f"change order {which}: make it {due}"
            )
        case OrderChange(which=which, due=due):
            chinese = has_chinese(which)
            return f"把{which}那个改成{due}" if chinese else f"move the {which} one to {due}"
        case OrderRemove(which=which) if _ID.fullmatch(which):
            return f"remove order {which}"
        case OrderRemove(which=which):
            return f"取消{which}那个" if has_chinese(which) else f"remove the {which} one"
    return ""


def _is_read(step: object, intent: Intent | None) -> bool:
    match step, intent:
        case OrderAdd(order=order), ScheduleCommand(problem=None) as command:
            said = command.order if command.reminder is None else order
            return fold_words(said) == fold_words(order)
        case OrderChange(), CorrectOrder(change=Retime()):
            return True
        case OrderRemove(), ChangeOrders(act="remove"):
            return True
    return False
