"""Judge a new standing order before it is kept, or before a model's offer of one is laid before a
person: its words, its time, the quiet hours, the room among those that are kept.

Reads the order book and the world; changes nothing, and asks no brain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.schedule import ScheduleCommand
from planner.language.sentence import parse
from planner.orders import world
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder, OrderQuestion, judge_words, order_of_text
from planner.orders.order import MAX_ORDERS
from planner.orders.rule import is_quiet, settle, upcoming
from planner.plan import AnswerPlan, Clarify, Code, Refuse, plan_record, words_of
from planner.plan.timing import CronRule, EventRule, EveryRule

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.mission.events import Planned
    from planner.mission.state import MissionState
    from planner.navigation import ObstacleReport
    from planner.orders.keeper import OrderKeeper
    from planner.orders.order import StandingOrder
    from planner.plan import Bilingual, StepRecord
    from planner.plan.timing import Rule

QUIET_LOOKED = 30
"""Runs that must not all lie in the quiet hours."""


class NewOrderJudge:
    """Say whether an order can be kept now, and by which rule."""

    def __init__(
        self,
        keeper: OrderKeeper,
        missions: Callable[[], MissionState],
        report: Callable[[], ObstacleReport | None],
    ) -> None:
        """Take the keeper, and how missions and lidar are read as they are now."""
        self._keeper, self._missions, self._report = keeper, missions, report

    def judge(self, new: NewOrder, now_unix_s: float) -> Rule:
        """Return the rule of an order that is given now.

        Raises:
            OrderRefusal: it can't be kept.
        """
        judge_words(new)
        if isinstance(new.when, EventRule):
            lacking = world.lacks(self._missions(), new.when.event, self._report())
            if lacking is not None:
                raise OrderRefusal("order_no_eyes", lacking, why=say(f"order_lacks.{lacking}"))
        rule = settle(new.when, now_unix_s, self._keeper.book.zone)
        self.judge_quiet(rule, now_unix_s)
        self.judge_room(new, rule)
        return rule

    def judge_quiet(self, rule: Rule, now_unix_s: float) -> None:
        """Refuse a rule all of whose runs are left out. Raises OrderRefusal."""
        quiet, zone = self._keeper.book.quiet, self._keeper.book.zone
        if quiet is None or not isinstance(rule, (CronRule, EveryRule)):
            return
        runs = upcoming(rule, now_unix_s, zone, QUIET_LOOKED)
        if all(is_quiet(quiet, run_s, zone) for run_s in runs):
            raise OrderRefusal("order_always_quiet", quiet.text, quiet=quiet.text)

    def judge_room(self, new: NewOrder, rule: Rule) -> None:
        """Refuse one more than can be kept. Raises OrderRefusal."""
        kept = [o for o in self._keeper.book.orders.values() if not o.ended]
        if len(kept) >= MAX_ORDERS and self.find_same(new, rule) is None:
            raise OrderRefusal("orders_full", f"{MAX_ORDERS} are kept", most=MAX_ORDERS)

    def find_same(self, new: NewOrder, rule: Rule) -> StandingOrder | None:
        """Return the order that is this very one already; "in 20 minutes" twice are two."""
        if not isinstance(rule, (CronRule, EventRule)):
            return None
        kept = self._keeper.book.orders.values()
        return next(
            (o for o in kept if (o.rule, o.order) == (rule, new.order) and not o.paused), None
        )

    def refuse_offer(self, text: str) -> Bilingual | None:
        """Return why a sentence could not be kept if a person said it now; None where it could.

        None as well of a sentence that is no standing order.
        """
        if not isinstance(parse(text).intent, ScheduleCommand):
            return None
        try:
            self.judge(order_of_text(text, None, "offer"), self._keeper.clocks.unix())
        except OrderRefusal as refused:
            return refused.message
        return None


LOST = frozenset({Code.NOT_UNDERSTOOD, Code.OUT_OF_SCOPE})


def is_remark(planned: Planned) -> bool:
    """Tell whether a thought finds nothing that the robot could do: "pizza tonight" is no order."""
    plan = planned.plan
    lost = isinstance(plan, Clarify | Refuse) and plan.code in LOST
    return isinstance(plan, AnswerPlan) or (lost and not getattr(plan, "options", ()))


def judge_deed(new: NewOrder, planned: Planned) -> tuple[StepRecord, ...]:
    """Return the steps that an order may do each time.

    Raises:
        OrderRefusal: it can't be kept.
        OrderQuestion: the brain asks about it.
    """
    plan = planned.plan
    if isinstance(plan, Clarify):
        raise OrderQuestion(plan)
    if isinstance(plan, AnswerPlan):
        raise OrderRefusal("order_no_deed", new.order[:120], order=new.order[:120])
    if plan is None or isinstance(plan, Refuse):
        failed = planned.failure.message if planned.failure is not None else None
        why = failed or words_of(plan) or say("standing.none")
        raise OrderRefusal("order_not_understood", why.en, order=new.order[:120], why=why)
    if planned.unasked:
        raise OrderRefusal("order_unasked", "motion that nobody said", order=new.order[:120])
    steps = plan_record(plan).steps
    first = next((s for s in steps if s.kind in ("come_back", "go_to", "patrol")), None)
    if first is not None and first.kind == "come_back":
        raise OrderRefusal("order_leans", "come back to where?")
    return steps
