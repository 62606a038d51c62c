"""Hold what somebody wants kept as a standing order, and judge it: words, time, quiet hours, room.

Pure. Law: an order that stops, that is about what runs now, or that is a standing order itself is
none: each firing gives its words as a goal, and they must mean the same then as now.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING

from planner.language.catalogue import build, join, raw, say
from planner.language.folding import has_chinese
from planner.language.schedule import OrderCommand, ScheduleCommand
from planner.language.schedule.reader import MAX_READ
from planner.language.sentence import language_of, parse
from planner.orders.errors import OrderRefusal
from planner.orders.order import MAX_ORDER_CHARACTERS, MAX_ORDERS, MAX_REMINDER_CHARACTERS
from planner.orders.rule import days_of_next, is_quiet, settle, upcoming
from planner.orders.telling import say_goal_of_reminder
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Language,
    Option,
    Recall,
    Refuse,
    StepPlan,
    plan_record,
    say_same,
    words_of,
)
from planner.plan.timing import AtRule, CronRule, DayTime, EventRule, EveryRule, SpokenRule

if TYPE_CHECKING:
    from datetime import date, tzinfo

    from planner.language.schedule.parts import Problem
    from planner.mission.events import Planned
    from planner.orders.order import StandingOrder
    from planner.orders.scheduler import OrderBook
    from planner.plan import Step, StepRecord
    from planner.plan.timing import Rule

QUIET_LOOKED = 30
"""Runs that must not all lie in the quiet hours."""
_LOST = frozenset({Code.NOT_UNDERSTOOD, Code.OUT_OF_SCOPE, Code.EMPTY_GOAL})
_DENIES = re.compile(
    r"(?:^|[,，。;；])\s*(?:你|就|都|也|先|那)*(?:别(?!忘|的|人)|不要|不准|不许|不能|甭|勿)"
    r"|^(?:please )?(?:don't|do not|never)\b(?! forget)",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class NewOrder:
    """Hold what somebody wants kept: when, what, and who says so."""

    when: SpokenRule | AtRule
    order: str
    language: Language
    text: str
    words: str = ""
    reminder: str | None = None
    source: str = "api"
    skipped: tuple[date, ...] = ()
    paused: bool = False
    steps: tuple[Step, ...] = ()


class OrderQuestion(Exception):
    """Something is asked about the order: it was not taken."""

    def __init__(self, asked: Clarify, *, is_whole: bool = False) -> None:
        """Take the question; ``is_whole``: its offers are whole orders, with their time."""
        super().__init__(asked.question.en)
        self.asked, self.is_whole = asked, is_whole


def read_new_order(
    command: ScheduleCommand, language: Language, text: str, source: str,
    deed: StepPlan | None = None,
) -> NewOrder:  # fmt: skip
    """Return what a sentence wants kept; ``deed``: what it is to do, where that was agreed to.

    Raises:
        OrderRefusal: its time is none that can be kept.
    """
    if command.problem is not None or command.when is None:
        raise OrderRefusal(command.problem or "order_malformed", text[:200])
    order = command.order
    if command.reminder is not None:
        order = say_goal_of_reminder(language.value, command.reminder)
    steps = deed.steps if deed is not None else ()
    return NewOrder(
        command.when, order, language, text, command.words, command.reminder, source, steps=steps
    )


def order_of_text(text: str, language: Language | None, source: str) -> NewOrder:
    """Return what a whole sentence wants kept, for whoever has no goal of it.

    Raises:
        OrderRefusal: ``order_too_long``, ``order_malformed`` where it is no standing order, else
            as its time is.
    """
    _judge_length(text, MAX_READ)  # a longer one is not read, which is not to say that it is wrong
    command = parse(text).intent
    if not isinstance(command, ScheduleCommand):
        raise OrderRefusal("order_malformed", f"{text[:120]!r} names no time")
    return read_new_order(command, language or language_of(text), text, source)


def judge_new(new: NewOrder, book: OrderBook, now_s: float, lacking: str | None = None) -> Rule:
    """Return the rule of an order that is given now.

    Args:
        new: the order.
        book: the orders that are kept, and the quiet hours.
        now_s: the time.
        lacking: why the robot can't notice its event, where it can't.

    Raises:
        OrderRefusal: it can't be kept.
    """
    judge_words(new)
    if lacking is not None:
        raise OrderRefusal("order_no_eyes", lacking, why=say(f"order_lacks.{lacking}"))
    rule = settle(new.when, now_s, book.zone)
    judge_quiet(rule, book, now_s)
    kept = [order for order in book.orders.values() if not order.ended]
    if len(kept) >= MAX_ORDERS and find_same(new, rule, book) is None:
        raise OrderRefusal("orders_full", f"{MAX_ORDERS} are kept", most=MAX_ORDERS)
    return rule


def judge_words(new: NewOrder) -> None:
    """Refuse an order that is none, that stops, or that is about what runs now.

    Raises:
        OrderRefusal: ``order_empty``, ``order_too_long``, ``order_stops``, ``order_nested``,
            ``order_is_command``, ``order_denies`` (what is not to be done is nothing to do).
    """
    order = new.order.strip()
    if not order:
        raise OrderRefusal("order_empty", "no order")
    _judge_length(order, MAX_ORDER_CHARACTERS)
    _judge_length(new.reminder or "", MAX_REMINDER_CHARACTERS)
    if new.reminder is not None:
        return  # its words are said, and are nobody's order
    said = parse(order)
    if _DENIES.search(order):
        code = "order_denies"
    elif said.orders_stop or said.may_mean_stop:
        code = "order_stops"
    elif isinstance(said.intent, ScheduleCommand):
        code = "order_nested"
    elif said.intent is not None or said.consent is not None:
        code = "order_is_command"
    else:
        return
    raise OrderRefusal(code, order[:120], order=order[:120])


def _judge_length(text: str, most: int) -> None:
    if not len(text) <= most:
        detail = f"{len(text)} characters; at most {most}"
        raise OrderRefusal("order_too_long", detail, most=most)


def judge_quiet(rule: Rule, book: OrderBook, now_s: float) -> None:
    """Refuse a rule all of whose runs are left out. Raises OrderRefusal."""
    quiet, zone = book.quiet, book.zone
    if quiet is None or not isinstance(rule, (CronRule, EveryRule)):
        return
    if all(is_quiet(quiet, run_s, zone) for run_s in upcoming(rule, now_s, zone, QUIET_LOOKED)):
        raise OrderRefusal("order_always_quiet", quiet.text, quiet=quiet.text)


def find_same(new: NewOrder, rule: Rule, book: OrderBook) -> StandingOrder | None:
    """Return the order that is this very one already; "in 20 minutes" twice are two."""
    if not isinstance(rule, (CronRule, EventRule)):
        return None
    wanted = (rule, new.order, False)
    return next((o for o in book.orders.values() if (o.rule, o.order, o.paused) == wanted), None)


def is_remark(planned: Planned, problem: Problem | None = None) -> bool:
    """Tell whether a thought finds nothing to be done then: "pizza tonight" is no order.

    So are a question to memory without an hour (你今天都干了些啥) and a change of what is kept
    (晚上八点那个改成九点): their time is no order's, and the whole sentence is read.
    """
    plan = planned.plan
    if isinstance(plan, StepPlan):
        recalls = all(isinstance(step, Recall) for step in plan.steps)
        return problem == "order_time_missing" and recalls
    options = plan.options if isinstance(plan, Clarify) else ()
    lost = isinstance(plan, Clarify | Refuse) and plan.code in _LOST
    changes = (isinstance(parse(each.text).intent, OrderCommand) for each in options)
    return isinstance(plan, AnswerPlan) or (lost and all(changes))


def judge_deed(new: NewOrder, planned: Planned) -> tuple[StepRecord, ...]:
    """Return the steps that an order may do each time.

    Raises:
        OrderRefusal: it can't be kept.
        OrderQuestion: the brain asks about it.
    """
    plan, order = planned.plan, new.order[:120]
    if isinstance(plan, Clarify):
        raise OrderQuestion(plan)
    if isinstance(plan, AnswerPlan):
        raise OrderRefusal("order_no_deed", order, order=order)
    if plan is None or isinstance(plan, Refuse):
        failed = planned.failure.message if planned.failure is not None else None
        why = failed or words_of(plan) or say("standing.none")
        raise OrderRefusal("order_not_understood", why.en, order=order, why=why)
    if planned.unasked:
        raise OrderRefusal("order_unasked", "motion that nobody said", order=order)
    steps = plan_record(plan).steps
    first = next((s for s in steps if s.kind in ("come_back", "go_to", "patrol")), None)
    if first is not None and first.kind == "come_back":
        raise OrderRefusal("order_leans", "come back to where?")
    return steps


# Questions ----------------------------------------------------------------------------------------


def put_time_before(asked: Clarify, words: str) -> Clarify:
    """Return a brain's question about the order within, its options with the time before them."""
    if not words or not asked.options:
        return Clarify(code=asked.code, question=say("standing.say_whole", question=asked.question))
    options = tuple(
        each.model_copy(
            update={
                "text": f"{words}{'' if has_chinese(words) else ' '}{each.text}"[:2000],
                "is_standing": each.plan is not None,
            }
        )
        for each in asked.options
    )
    return Clarify(code=asked.code, question=asked.question, options=options)


def tell_question(asked: Clarify) -> Bilingual:
    """Return a brain's question with the sentences that it offers."""
    if not asked.options:
        return asked.question
    offers = join((say_same(f"“{each.text}”") for each in asked.options), "joint.name")
    return join((asked.question, offers))


def ask_which_day(new: NewOrder, now_s: float, zone: tzinfo) -> Clarify | None:
    """Return the question about an order's day ("next Friday"); None where it is beyond doubt.

    Each offer is the whole order again with its date, so that a yes to it is beyond doubt.
    """
    when = new.when
    both = (
        days_of_next(when, datetime.fromtimestamp(now_s, zone))
        if isinstance(when, DayTime)
        else None
    )
    if both is None or not isinstance(when, DayTime):
        return None
    clock = f"{when.hour:02}:{when.minute:02}"
    options = tuple(
        Option(label=build(partial(_date, day, clock)), text=_sentence(new, day, clock))
        for day in both
    )
    question = say("standing.which_day", first=options[0].label, second=options[1].label)
    return Clarify(code=Code.AMBIGUOUS, question=question, options=options)


def _date(day: date, clock: str, language: str) -> str:
    weekday = raw(f"standing.day_{day.isoweekday() % 7}", language)
    return f"{weekday} {day.isoformat()} {clock}"


def _sentence(new: NewOrder, day: date, clock: str) -> str:
    code = "standing.dated_order" if new.reminder is None else "standing.dated_reminder"
    words = new.order if new.reminder is None else new.reminder
    said = raw(code, new.language.value).format(date=day.isoformat(), time=clock, order=words)
    return said.strip()[:2000]
