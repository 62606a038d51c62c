"""Hold what somebody wants kept as a standing order, and judge its words. Pure.

Law: an order that stops, that is about what runs now, or that is a standing order itself is none:
each firing gives its words as a goal, and they must mean the same then as now.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING

from planner.language.catalogue import build, join, raw, say
from planner.language.schedule import ScheduleCommand
from planner.language.schedule.reader import MAX_READ
from planner.language.sentence import language_of, parse
from planner.orders.calendar_day import days_of_next
from planner.orders.errors import OrderRefusal
from planner.orders.order import MAX_ORDER_CHARACTERS, MAX_REMINDER_CHARACTERS
from planner.orders.telling import say_goal_of_reminder
from planner.plan import Bilingual, Clarify, Code, Language, Option, say_same
from planner.plan.timing import AtRule, DayTime, SpokenRule

if TYPE_CHECKING:
    from datetime import date, tzinfo

    from planner.mission.state import Mission


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


class OrderQuestion(Exception):
    """Something is asked about the order: it was not taken."""

    def __init__(self, asked: Clarify, *, is_whole: bool = False) -> None:
        """Take the question; ``is_whole``: its offers are whole orders, with their time."""
        super().__init__(asked.question.en)
        self.asked, self.is_whole = asked, is_whole


def read_new_order(command: ScheduleCommand, language: Language, given: Mission) -> NewOrder:
    """Return what a sentence wants kept.

    Raises:
        OrderRefusal: its time is none that can be kept, or there is nothing to do.
    """
    if command.problem is not None:
        raise OrderRefusal(command.problem, given.text[:200])
    if command.when is None:
        raise OrderRefusal("order_malformed", given.text[:200])
    order = command.order
    if command.reminder is not None:
        order = say_goal_of_reminder(language.value, command.reminder)
    return NewOrder(
        command.when, order, language, given.text, command.words, command.reminder, given.source
    )


_DENIES = re.compile(
    r"(?:^|[,，。;；])\s*(?:你|就|都|也|先|那)*(?:别(?!忘|的|人)|不要|不准|不许|不能|甭|勿)"
    r"|^(?:please )?(?:don't|do not|never)\b(?! forget)",
    re.IGNORECASE,
)


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
    if _DENIES.search(order):
        raise OrderRefusal("order_denies", order[:120], order=order[:120])
    said = parse(order)
    if said.orders_stop or said.may_mean_stop:
        raise OrderRefusal("order_stops", order[:120], order=order[:120])
    if isinstance(said.intent, ScheduleCommand):
        raise OrderRefusal("order_nested", order[:120])
    if said.intent is not None or said.consent is not None:
        raise OrderRefusal("order_is_command", order[:120], order=order[:120])


def put_time_before(asked: Clarify, command: ScheduleCommand) -> Clarify:
    """Return a brain's question about the order within, its options with the time before them."""
    options = tuple(
        Option(label=each.label, text=f"{command.words} {each.text}".strip()[:2000])
        for each in asked.options
        if command.words
    )
    if options:
        return Clarify(code=asked.code, question=asked.question, options=options)
    return Clarify(code=asked.code, question=say("standing.say_whole", question=asked.question))


def order_of_text(text: str, language: Language | None, source: str) -> NewOrder:
    """Return what a whole sentence wants kept, for whoever has no goal of it.

    Raises:
        OrderRefusal: ``order_too_long``, ``order_malformed`` where it is no standing order, else
            as its time is.
    """
    _judge_length(text, MAX_READ)  # a longer one is not read, which is not to say that it is wrong
    command = parse(text).intent
    spoken = language or language_of(text)
    if not isinstance(command, ScheduleCommand):
        raise OrderRefusal("order_malformed", f"{text[:120]!r} names no time")
    if command.problem is not None or command.when is None:
        raise OrderRefusal(command.problem or "order_malformed", text[:120])
    order = command.order
    if command.reminder is not None:
        order = say_goal_of_reminder(spoken.value, command.reminder)
    return NewOrder(command.when, order, spoken, text, command.words, command.reminder, source)


def _judge_length(text: str, most: int) -> None:
    if not len(text) <= most:
        detail = f"{len(text)} characters; at most {most}"
        raise OrderRefusal("order_too_long", detail, most=most)


def tell_question(asked: Clarify) -> Bilingual:
    """Return a brain's question with the sentences that it offers."""
    if not asked.options:
        return asked.question
    offers = join((say_same(f"“{each.text}”") for each in asked.options), "joint.name")
    return join((asked.question, offers))


def ask_which_day(new: NewOrder, now_unix_s: float, zone: tzinfo) -> Clarify | None:
    """Return the question about an order's day ("next Friday"); None where it is beyond doubt.

    Each offer is the whole order again with its date, so that a yes to it is beyond doubt.
    """
    if not isinstance(new.when, DayTime):
        return None
    both = days_of_next(new.when, datetime.fromtimestamp(now_unix_s, zone))
    if both is None:
        return None
    when = new.when
    options = tuple(
        Option(
            label=build(partial(_date, day, when)),
            text=_sentence(new, day, when),
        )
        for day in both
    )
    question = say("standing.which_day", first=options[0].label, second=options[1].label)
    return Clarify(code=Code.AMBIGUOUS, question=question, options=options)


def _date(day: date, when: DayTime, language: str) -> str:
    weekday = raw(f"standing.day_{day.isoweekday() % 7}", language)
    return f"{weekday} {day.isoformat()} {when.hour:02}:{when.minute:02}"


def _sentence(new: NewOrder, day: date, when: DayTime) -> str:
    code = "standing.dated_order" if new.reminder is None else "standing.dated_reminder"
    words = new.order if new.reminder is None else new.reminder
    time = f"{when.hour:02}:{when.minute:02}"
    said = raw(code, new.language.value).format(date=day.isoformat(), time=time, order=words)
    return said.strip()[:2000]
