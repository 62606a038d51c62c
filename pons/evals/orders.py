"""Score how sentences about standing orders are read: the time, the order within, what is none.

The missions' own reader and the brain's plan of the order within. A sentence is right where its
time is the one that is expected and its plan fits; nothing is kept and nothing moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.schedule import (
    ChangeOrders,
    CorrectOrder,
    ListOrders,
    ScheduleCommand,
)
from planner.language.sentence import parse
from planner.mission.effects import AskBrain
from planner.mission.plan_request import thinker
from planner.plan import Means
from planner.plan.timing import CronRule, DayTime, EventRule, EveryRule, InRule
from planner.site.site_view import vocabulary_of
from pons.evals.cases import HELD_OUT, TUNED
from pons.evals.matchers import BadMatcher, read_expectation
from pons.evals.order_words import describe_change, describe_day, describe_part, describe_question
from pons.evals.world import new_goal

if TYPE_CHECKING:
    from planner.brain import Brain
    from planner.language.commands import Intent
    from planner.plan.timing import SpokenRule
    from planner.site.site import Site

ORDERS = Path(__file__).parent / "orders"
KINDS = ("cron", "every", "in", "day", "event", "list", "when", "left", "remove", "pause", "resume",
         "skip", "change", "again", "problem", "none", "stops")  # fmt: skip


@dataclass(frozen=True, slots=True)
class OrderCase:
    """Hold one sentence and what it is."""

    split: str
    group: str
    text: str
    wanted: str
    """Its time or command, as this file writes it."""
    does: str
    """The plan of the order within, or ``remind WORDS``; empty: not judged."""


@dataclass(frozen=True, slots=True)
class OrderVerdict:
    """Hold what a sentence was read as."""

    case: OrderCase
    read: str
    right: bool


def read_order_cases(name: str) -> tuple[OrderCase, ...]:
    """Return the cases of a language.

    Raises:
        BadMatcher: a line can't be read.
    """
    lines = (ORDERS / f"{name}.tsv").read_text("utf-8").splitlines()
    return tuple(_read(line) for line in lines if line.strip() and not line.startswith("#"))


def _read(line: str) -> OrderCase:
    split, group, text, expected = line.split("\t")
    wanted, _, does = (each.strip() for each in expected.partition("=>"))
    if wanted.split()[0] not in KINDS:
        raise BadMatcher(f"{expected!r}: unknown kind; known: {', '.join(KINDS)}")
    return OrderCase(TUNED if split == "tuned" else HELD_OUT, group, text, wanted, does)


async def score_orders(
    cases: tuple[OrderCase, ...], brain: Brain, site: Site
) -> tuple[OrderVerdict, ...]:
    """Return the verdicts in order."""
    return tuple([await score_order(case, brain, site) for case in cases])


async def score_order(case: OrderCase, brain: Brain, site: Site) -> OrderVerdict:
    """Return what a sentence is read as, and whether that is right."""
    said = parse(case.text)
    if case.wanted == "stops":
        stops = said.orders_stop or said.may_mean_stop
        return OrderVerdict(case, "stops" if stops else "does not stop", stops)
    intent = said.intent
    read = describe(intent)
    right = read == case.wanted or (
        isinstance(intent, ChangeOrders) and _names(case.wanted, intent)
    )
    if not right or not isinstance(intent, ScheduleCommand) or not case.does:
        return OrderVerdict(case, f"{read} => {_order(intent)}", right)
    return OrderVerdict(case, f"{read} => {_order(intent)}", await _fits(case, intent, brain, site))


def describe(intent: Intent | None) -> str:
    """Return a command as a suite writes it."""
    match intent:
        case ListOrders():
            return describe_question(intent)
        case ChangeOrders():
            until = f" until {_tell_rule(intent.until)}" if intent.until is not None else ""
            day = f" {describe_part(intent.day)}" if intent.day is not None else ""
            return f"{intent.act} {intent.which}".strip() + until + day
        case CorrectOrder():
            return describe_change(intent)
        case ScheduleCommand() if intent.when is not None:
            return _tell_rule(intent.when)
        case ScheduleCommand():
            return f"problem {intent.problem}"
        case _:
            return "none"


def _tell_rule(rule: SpokenRule) -> str:
    match rule:
        case CronRule():
            return f"cron {rule.cron}"
        case EveryRule():
            return f"every {rule.seconds:g}"
        case InRule():
            return f"in {rule.seconds:g}"
        case EventRule():
            return f"event {rule.event.value}"
        case DayTime():
            return f"day {rule.hour}:{rule.minute:02}{describe_day(rule)}"


def _names(wanted: str, intent: ChangeOrders) -> bool:
    """Tell whether the right act is read, and the words that tell which are among those read."""
    named, _, until = wanted.partition(" until ")
    act, _, which = named.partition(" ")
    read = _tell_rule(intent.until) if intent.until is not None else ""
    if intent.day is not None:
        which, _, day = which.rpartition(" ")
        if day != describe_part(intent.day):
            return False
    words = all(word in intent.which for word in which.split())
    return act == intent.act and words and until == read


def _order(intent: Intent | None) -> str:
    if not isinstance(intent, ScheduleCommand):
        return ""
    return f"remind {intent.reminder}" if intent.reminder is not None else intent.order


async def _fits(case: OrderCase, intent: ScheduleCommand, brain: Brain, site: Site) -> bool:
    if case.does.startswith("remind"):
        words = case.does.removeprefix("remind").strip()
        return intent.reminder is not None and (not words or words == intent.reminder)
    means = Means(camera=True, detector=True)
    think = thinker(brain, vocabulary_of(site), None, means)
    planned = await think(AskBrain(new_goal("order"), intent.order, parse(case.text).language))
    if planned.plan is None or planned.unasked:
        return False
    return read_expectation(case.does).fits(planned.plan)


def show_orders(name: str, verdicts: tuple[OrderVerdict, ...]) -> str:
    """Return the figures, and every sentence that was read otherwise."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in verdicts if each.case.split == split]
        lines.append(f"{name} {split}: {sum(v.right for v in mine)} of {len(mine)} right")
    lines += [
        f"  {v.case.text!r} -> {v.read}; expected {v.case.wanted} => {v.case.does}"
        for v in verdicts
        if not v.right
    ]
    return "\n".join(lines)
