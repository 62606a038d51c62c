"""Write a step about standing orders as the sentence that the clock's grammar reads. Pure.

Law: the sentence is read whole and as the step means it, or there is none. Whoever lays it before a
person offers what the person could have said.
"""

from __future__ import annotations

import re

from planner.language.catalogue import say
from planner.language.folding import fold_words, has_chinese
from planner.language.schedule import (
    ChangeOrders,
    CorrectOrder,
    ListOrders,
    Retime,
    ScheduleCommand,
)
from planner.language.sentence import parse
from planner.plan import Clarify, Code, Option, StepPlan, say_same
from planner.plan.base import Frozen
from planner.plan.order_steps import OrderAdd, OrderChange, OrderRemove

_ID = re.compile(r"o\d{1,6}")
_NAMED = {
    "orders": ("list the {which} orders", "列出{which}的定时任务"),
    "order_remove": ("remove the {which} one", "取消{which}那个"),
    "order_pause": ("pause the {which} one", "暂停{which}那个"),
    "order_resume": ("resume the {which} one", "恢复{which}那个"),
    "order_skip": ("skip the {which} {due}", "{due}的{which}跳过"),
    "order_move": ("move the {which} one to {due}", "把{which}那个改成{due}"),
}
_NAMELESS = {
    "orders": ("tell me what is on for {due}", "{due}有什么安排"),
    "order_remove": ("remove the order", "取消定时任务"),
    "order_skip": ("not {due}", "{due}不用"),
    "order_move": ("make it {due}", "改成{due}"),
}
"""Of the one that was spoken of last, or asked about."""
_LIST = ("list your standing orders", "有哪些定时任务")
_CALLED = re.compile(r"^(?:the|my|that|your) | ?\bones?$|的?那一?[个项条]$|的$")
"""What stands about a name: "the pills one" is "pills"."""


def offer_order(text: str, deed: StepPlan | None = None) -> Clarify:
    """Return the question whether a standing order is to be kept or changed so.

    ``deed``: what it does each time; None: the sentence is read.
    """
    question = say("standing.proposed", order=text)
    option = Option(label=say_same(text), text=text, plan=deed, is_standing=deed is not None)
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


def offer_kept(form: str, which: str, due: str, *, chinese: bool) -> Clarify | None:
    """Return the question about what is kept, of a form of the learned reader; None: it is unread.

    Args:
        form: as ``order_skip``; see ``plan_grammar.ALONE``.
        which: the words that name an order; empty: the one that was spoken of.
        due: its new time, or the day; empty where none was said.
        chinese: the language of the sentence.
    """
    which = _CALLED.sub("", _CALLED.sub("", which.strip()))
    forms = _NAMED if which else _NAMELESS
    said = _LIST if form == "orders" and not (which or due) else forms.get(form, ("", ""))
    text = said[chinese].format(which=which, due=due)
    match parse(text).intent:
        case ListOrders() if form == "orders":
            is_read = True
        case CorrectOrder(change=Retime()):
            is_read = form == "order_move"
        case ChangeOrders(act=act):
            is_read = form == f"order_{act}"
        case _:
            is_read = False
    return offer_order(text) if is_read else None


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
            return _NAMED["order_move"][has_chinese(which)].format(which=which, due=due)
        case OrderRemove(which=which) if _ID.fullmatch(which):
            return f"remove order {which}"
        case OrderRemove(which=which):
            return _NAMED["order_remove"][has_chinese(which)].format(which=which)
    return ""
