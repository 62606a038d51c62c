"""Write a step about standing orders as the sentence that the clock's grammar reads. Pure.

Law: the sentence is read whole and as the step means it, or there is none. Whoever lays it before a
person offers what the person could have said.
"""

from __future__ import annotations

import re

from planner.language.catalogue import say
from planner.language.folding import fold_words, has_chinese
from planner.language.schedule import ChangeOrders, CorrectOrder, Retime, ScheduleCommand
from planner.language.sentence import parse
from planner.plan import Clarify, Code, Option, say_same
from planner.plan.base import Frozen
from planner.plan.order_steps import OrderAdd, OrderChange, OrderRemove

_ID = re.compile(r"o\d{1,6}")


def offer_order(text: str) -> Clarify:
    """Return the question whether a standing order is to be kept or changed so."""
    question = say("standing.proposed", order=text)
    option = Option(label=say_same(text), text=text)
    return Clarify(code=Code.NOT_UNDERSTOOD, question=question, options=(option,))


def is_order_sentence(text: str, step: Frozen) -> bool:
    """Return whether the clock's grammar reads a step's sentence whole, as the step means it."""
    match step, parse(text).intent:
        case OrderAdd(order=order), ScheduleCommand(problem=None) as command:
            said = command.order if command.reminder is None else order
            return fold_words(said) == fold_words(order)
        case OrderChange(), CorrectOrder(change=Retime()):
            return True
        case OrderRemove(), ChangeOrders(act="remove"):
            return True
    return False


def write_order(step: Frozen) -> str:
    """Return the sentence of an ``OrderAdd``, ``OrderChange`` or ``OrderRemove``."""
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
