"""Serve the standing orders with goals: think about one ahead, give one, hold one to its order.

The missions' door for ``planner.orders``, which knows when; all that walks a goal is the missions'
own. A goal of a standing order passes every gate that a person's does, and clears no hold: it
carries no person's act.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from planner.brain.situation import Situation
from planner.language.catalogue import join, message, say
from planner.mission.awaited_word import WAITS
from planner.mission.effects import AskBrain
from planner.mission.errors import QueueFull
from planner.mission.events import Cancel, Planned, Submitted
from planner.mission.open_questions import count_open, has_room
from planner.mission.outcomes import moves, plain_outcome
from planner.mission.plan_check import key_of_deed, unwalkable
from planner.mission.state import ORDER_SOURCE, GoalKey, Mission, MissionState
from planner.mission.transitions import FIRST
from planner.plan import (
    STEPLESS,
    Bilingual,
    Clarify,
    Code,
    Language,
    Refuse,
    Step,
    StepPlan,
    StepRecord,
    plan_record,
)

if TYPE_CHECKING:
    from planner.language.schedule import ChangeOrders, OrderCommand
    from planner.mission.loop import Loop
    from planner.mission.plan_request import RefusesOffer
    from planner.mission.request_keys import Repeats
    from planner.mission.tasks import Think


class OrderDesk(Protocol):
    """Keep the standing orders, as ``planner.orders`` does."""

    async def take(self, command: OrderCommand, ask: AskBrain, given: Mission) -> Planned | None:
        """Carry out what a person said about standing orders, and say what came of it.

        None where it may mean something else, and no order is kept that it fits.
        """

    async def change(self, command: ChangeOrders, language: Language) -> Bilingual | None:
        """Remove, pause or resume the orders that are meant, and say which; None: none is meant."""

    def allowed_steps(self, source: str) -> tuple[StepRecord, ...] | None:
        """Return what the standing order of a goal may do; None where it is none of ours."""

    def sentence_of(self, source: str) -> tuple[str, str | None]:
        """Return the sentence of a goal's standing order, and a reminder's fixed words."""

    def refuse_offer(self, text: str) -> Bilingual | None:
        """Return why a standing order that a model offers could not be kept; None: it could."""


def is_of_order(mission: Mission | None) -> bool:
    """Tell whether a standing order gave this goal."""
    return mission is not None and mission.source.startswith(ORDER_SOURCE)


def take_back_offers(planned: Planned, refuses: RefusesOffer) -> Planned:
    """Return a brain's question without the standing orders that a yes could not keep, and say why.

    Law: what a person would only be refused after a yes is never offered.
    """
    plan = planned.plan
    if not isinstance(plan, Clarify):
        return planned
    reasons = {each.text: why for each in plan.options if (why := refuses(each.text)) is not None}
    if not reasons:
        return planned
    left = tuple(each for each in plan.options if each.text not in reasons)
    why = next(iter(reasons.values()))
    if not left:
        told = message(Code.ORDER_NOT_KEPT, why=why)
        return replace(planned, plan=Refuse(code=Code.ORDER_NOT_KEPT, reason=told))
    question = join((plan.question, why))
    return replace(planned, plan=Clarify(code=plan.code, question=question, options=left))


def hold_to_order(planned: Planned, allowed: tuple[StepRecord, ...] | None) -> Planned:
    """Return a plan for a standing order's goal, in which all motion beyond the order is unasked.

    Law: such a step waits for a person's yes, whichever brain wrote it. Where the order is gone,
    every step that moves does.
    """
    if not isinstance(planned.plan, StepPlan):
        return planned
    known = {key_of_deed(step) for step in allowed or ()}
    steps = plan_record(planned.plan).steps
    beyond = {i for i, step in enumerate(steps) if moves(step) and key_of_deed(step) not in known}
    return replace(planned, unasked=tuple(sorted({*planned.unasked, *beyond})))


class StandingGoals:
    """Give goals without a person's sentence: the one door for ``planner.orders``."""

    def __init__(self, loop: Loop, think: Think, repeats: Repeats) -> None:
        """Take the loop, how sentences are understood, and the requests that came before."""
        self._loop, self._think, self._repeats = loop, think, repeats

    @property
    def book(self) -> MissionState:
        """Return where everything stands."""
        return self._loop.book

    def publish(self, event: dict[str, Any]) -> None:
        """Tell every page that listens."""
        self._loop.hub.publish(event)

    def find(self, key: str) -> str | None:
        """Return the goal that was given with this key before, also by a process that is gone."""
        before = self._repeats.find(key)
        return before.goal if before is not None else None

    async def consider(
        self, text: str, language: Language, goal_id: str, standing: str = "",
        deed: StepPlan | None = None,
    ) -> Planned:  # fmt: skip
        """Have an order understood and judged as a goal would be; nothing is given.

        Args:
            text: the order.
            language: its language.
            goal_id: to whose account a model's calls go.
            standing: the whole sentence, with its time.
            deed: its plan, where it is known without a brain.
        """
        ask = AskBrain(goal_id, text, language, order=text, standing=standing)
        planned = Planned(goal_id, deed)
        if deed is None:
            planned = await self._think(replace(ask, situation=Situation()))
        plan = planned.plan
        if not isinstance(plan, StepPlan):
            return planned
        if plan.does in STEPLESS:
            said = plain_outcome(Code.BAD_PLAN, why=say("plan.no_steps"))
            return Planned(planned.id, None, said, planned.brain)
        stand_in = Mission(
            id=goal_id, order=0, text=text, language=language, state=FIRST,
            created_unix_s=0.0, updated_unix_s=0.0,
        )  # fmt: skip
        outcome = unwalkable(self.book, stand_in, plan_record(plan).steps)
        return planned if outcome is None else Planned(planned.id, None, outcome, planned.brain)

    async def give(
        self, goal_id: str, text: str, language: Language, key: str, source: str,
        steps: tuple[Step, ...] = (),
    ) -> str:  # fmt: skip
        """Give the goal of one firing and return its id; the same key gives the same goal.

        With ``steps`` these are walked, and the text is told and read by nobody.

        Raises:
            QueueFull: there is no room among the open goals.
            JournalDown: it can't be written down, so it was not taken.
        """
        if (before := self.find(key)) is not None:
            return before
        if not has_room(self.book):
            raise QueueFull(count_open(self.book))
        body = hashlib.sha256(f"{source}\n{text}".encode()).hexdigest()[:32]
        request = GoalKey(key, body, goal_id)
        self._repeats.remember(request)
        given = Submitted(goal_id, text, language, points=steps, source=source, by="order")
        self._loop.event(given, request)
        await self._repeats.ensure_written(self._loop, goal_id, request)
        return goal_id

    def outcome(self, goal_id: str) -> Mission | None:
        """Return a goal that has ended; None while it is open."""
        mission = self.book.missions.get(goal_id)
        return mission if mission is not None and mission.has_ended else None

    def waits(self, goal_id: str) -> bool:
        """Tell whether a goal waits for a person's word."""
        mission = self.book.missions.get(goal_id)
        return mission is not None and mission.state in WAITS

    def cancel(self, goal_id: str) -> None:
        """End a goal, where it has not ended."""
        self._loop.obey(Cancel(goal_id))
