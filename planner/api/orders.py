"""Serve standing orders: give one in words or by its time, look, pause, resume, remove.

Translates; decides nothing. Who may look may list them; whatever changes them is an operator's.
"""

from __future__ import annotations

import uuid
from datetime import date, datetime
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Path, Query, Request, Response
from pydantic import AwareDatetime, Field, model_validator

from planner.api.crowd import address_of
from planner.api.interfaces import Services
from planner.api.order_calendar import add_routes
from planner.api.order_problems import problem
from planner.api.problems import HttpProblem
from planner.api.rates import Rates
from planner.api.schemas import Body, Source, law_broken
from planner.language.sentence import language_of
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import NewOrder, OrderQuestion, order_of_text, tell_question
from planner.orders.order import MAX_ORDERS, Firing, FiringState, StandingOrder
from planner.orders.rule import coming_runs
from planner.orders.telling import say_goal_of_reminder, tell_deed, tell_missed, tell_when
from planner.orders.zone import name_of
from planner.plan import Language
from planner.plan.timing import (
    MAX_AHEAD_S,
    AtRule,
    CronRule,
    EventRule,
    EveryRule,
    InRule,
    SpokenRule,
    WorldEvent,
)
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from planner.orders.factory import StandingOrders

A_SECOND, AT_ONCE = 1.0, 20
"""New orders of one address: each costs a thought."""
RUNS_SHOWN = 5
HISTORY = 50

MAX_SENT = 20_000
"""Characters; a longer order than may be kept is refused by its own code, with what may be."""

OrderId = Annotated[str, Path(min_length=1, max_length=64)]
"""As a list shows it; another one is unknown, and told with those that there are."""
Seconds = Annotated[float, Field(gt=0.0, le=MAX_AHEAD_S)]


class OrderTime(Body):
    """Say when: exactly one of these."""

    cron: Annotated[str, Field(min_length=9, max_length=100)] | None = None
    """Five fields as cron has them, in the robot's time zone: ``0 20 * * 1-5``."""
    at: AwareDatetime | None = None
    in_s: Seconds | None = None
    every_s: Seconds | None = None
    event: WorldEvent | None = None

    @model_validator(mode="after")
    def _one_time(self) -> OrderTime:
        given = [n for n in type(self).model_fields if getattr(self, n) is not None]
        if len(given) != 1:
            raise law_broken("one_time")
        return self

    @property
    def rule(self) -> SpokenRule | AtRule:
        """Return it as a rule."""
        if self.cron is not None:
            return CronRule(cron=self.cron)
        if self.at is not None:
            return AtRule(unix_s=max(0.0, min(self.at.timestamp(), 4e9)))
        if self.in_s is not None:
            return InRule(seconds=self.in_s)
        if self.every_s is not None:
            return EveryRule(seconds=self.every_s)
        return EventRule(event=self.event or WorldEvent.PERSON_SEEN)


OrderWords = Annotated[str, Field(min_length=1, max_length=MAX_SENT)]


class NewStandingOrder(Body):
    """Give a standing order: a whole sentence, or what and when apart; or a reminder's words."""

    text: OrderWords | None = None
    """Without ``when`` a whole sentence: "every evening at eight check the door"."""
    when: OrderTime | None = None
    reminder: Annotated[str, Field(max_length=MAX_SENT)] | None = None
    """With ``when``, in place of ``text``: the words to be reminded of."""
    language: Language | None = None
    source: Source = "api"

    @model_validator(mode="after")
    def _one_deed(self) -> NewStandingOrder:
        if (self.text is None) == (self.reminder is None):
            raise law_broken("text_or_reminder")
        if self.reminder is not None and self.when is None:
            raise law_broken("reminder_when")
        return self


class SkippedDay(Body):
    """Name a day by the robot's own calendar."""

    day: date


def routes(services: Services) -> APIRouter:
    """Return the routes below /v1/orders."""
    router = APIRouter(prefix="/v1/orders", tags=["orders"])
    orders = services.orders
    add_routes(router, orders)
    _looking(router, orders)
    _giving(router, orders)
    _changing(router, orders)
    return router


def _looking(router: APIRouter, orders: StandingOrders) -> None:
    @router.get("", operation_id="list_orders")
    async def several() -> dict[str, Any]:
        """List the standing orders with their next run, the time zone and the quiet hours."""
        return orders_view(orders)

    @router.get("/firings", operation_id="list_firings")
    async def firings(
        limit: Annotated[int, Query(ge=1, le=HISTORY)] = 20,
    ) -> dict[str, Any]:
        """List the newest runs of all orders: what came of each, or why it did not run."""
        try:
            newest = await orders.keeper.newest(limit)
        except StateUnavailable as error:
            raise problem(OrderRefusal("orders_unwritable", str(error))) from None
        kept = orders.keeper.book.orders
        told = [_view_run(orders, kept[each.order], each) for each in newest if each.order in kept]
        return {"firings": told}

    @router.get("/{order_id}", operation_id="get_order")
    async def one(
        order_id: OrderId, limit: Annotated[int, Query(ge=1, le=HISTORY)] = 20
    ) -> dict[str, Any]:
        """Show one order whole: its next runs, and its history, newest first."""
        try:
            order = orders.intake.find(order_id)
            history = await orders.keeper.history(order_id, limit)
        except OrderRefusal as refused:
            raise problem(refused) from None
        except StateUnavailable as error:
            raise problem(OrderRefusal("orders_unwritable", str(error))) from None
        runs = _runs(orders, order)
        return {
            **order_view(orders, order),
            "runs": runs,
            "history": [firing_view(orders, f) for f in history],
        }


def _giving(router: APIRouter, orders: StandingOrders) -> None:
    rates = Rates(A_SECOND, AT_ONCE)

    @router.post("", status_code=201, operation_id="give_order")
    async def give(new: NewStandingOrder, request: Request, response: Response) -> dict[str, Any]:
        """Keep a standing order; it is understood and judged now as it will be each time.

        200 where this very order is kept already. Nothing moves.
        """
        address = address_of(request.client.host) if request.client else ""
        if (wait_s := rates.wait_s(address)) is not None:
            detail = f"at most {AT_ONCE} at once, then {A_SECOND:g} a second; wait {wait_s:.1f} s"
            raise HttpProblem(429, "too_many_goals", detail)
        known = set(orders.keeper.book.orders)
        try:
            order = await orders.intake.give(_read_body(new), f"order-{uuid.uuid4().hex[:12]}")
        except OrderRefusal as refused:
            raise problem(refused) from None
        except OrderQuestion as question:
            said = tell_question(question.asked)
            raise HttpProblem(
                422, "order_unclear", said.en, message=said.model_dump(),
                options=[option.model_dump() for option in question.asked.options],
            ) from None  # fmt: skip
        if order.id in known:
            response.status_code = 200
        told = orders.intake.tell_one(order)
        return {**order_view(orders, order), "told": told.model_dump()}


def _read_body(new: NewStandingOrder) -> NewOrder:
    if new.when is None:
        return order_of_text(new.text or "", new.language, new.source)
    words = new.text if new.text is not None else new.reminder or ""
    language = new.language or language_of(words)
    order = say_goal_of_reminder(language.value, words) if new.text is None else words
    return NewOrder(
        new.when.rule, order, language, words or order, reminder=new.reminder, source=new.source
    )


def _changing(router: APIRouter, orders: StandingOrders) -> None:
    @router.post("/{order_id}/pause", operation_id="pause_order")
    async def pause(order_id: OrderId) -> dict[str, Any]:
        """Pause an order: nothing of it is due until it is resumed."""
        return await _change(order_id, paused=True)

    @router.post("/{order_id}/resume", operation_id="resume_order")
    async def resume(order_id: OrderId) -> dict[str, Any]:
        """Let a paused order be due again, from now on."""
        return await _change(order_id, paused=False)

    @router.post("/{order_id}/skip", operation_id="skip_order")
    async def skip(order_id: OrderId, skipped: SkippedDay) -> dict[str, Any]:
        """Leave one day out of an order: its runs of that day are not due, and nobody misses them.

        Resuming the order takes all such days back; an order of that day alone is removed.
        """
        try:
            return order_view(orders, await orders.intake.skip(order_id, skipped.day))
        except OrderRefusal as refused:
            raise problem(refused) from None

    @router.delete("/{order_id}", operation_id="remove_order")
    async def remove(order_id: OrderId) -> dict[str, Any]:
        """Remove an order, with its history. A goal of it that runs goes on."""
        try:
            return order_view(orders, await orders.intake.remove(order_id))
        except OrderRefusal as refused:
            raise problem(refused) from None

    async def _change(order_id: str, *, paused: bool) -> dict[str, Any]:
        try:
            order = await orders.intake.pause(order_id, paused=paused)
        except OrderRefusal as refused:
            raise problem(refused) from None
        return order_view(orders, order)


def orders_view(orders: StandingOrders) -> dict[str, Any]:
    """Return all standing orders, as a page shows them."""
    book = orders.keeper.book
    kept = sorted(book.orders.values(), key=lambda o: (o.ended, -o.number if o.ended else o.number))
    return {
        "version": orders.keeper.version,
        "timezone": name_of(book.zone),
        "now": _time(orders, orders.keeper.clocks.unix()),
        "quiet": book.quiet.text if book.quiet is not None else None,
        "trouble": orders.keeper.trouble,
        "most": MAX_ORDERS,
        "orders": [order_view(orders, order) for order in kept],
    }


def order_view(orders: StandingOrders, order: StandingOrder) -> dict[str, Any]:
    """Return one standing order as people and pages read it."""
    book = orders.keeper.book
    due_s = book.due.get(order.id)
    when = tell_when(order, book.zone, orders.keeper.clocks.unix())
    resumes_s = order.resume_unix_s
    return {
        "id": order.id,
        "text": order.text,
        "order": order.order,
        "language": order.language.value,
        "rule": order.rule.model_dump(mode="json"),
        "when": when.model_dump(),
        "does": tell_deed(orders.intake.facts, order).model_dump(),
        "may": [step.model_dump(mode="json", exclude_none=True) for step in order.allowed],
        "reminder": order.reminder,
        "source": order.source,
        "state": "ended" if order.ended else "paused" if order.paused else "active",
        "resumes": _time(orders, resumes_s) if resumes_s is not None else None,
        "skipped": [day.isoformat() for day in order.skipped],
        "next": _time(orders, due_s) if due_s is not None else None,
        "created": _time(orders, order.created_unix_s),
        "fired": order.fired,
        "missed": order.missed,
    }


def firing_view(orders: StandingOrders, firing: Firing) -> dict[str, Any]:
    """Return one firing as people read it."""
    kept = firing.model_dump(mode="json", exclude={"due_unix_s", "at_unix_s", "until_unix_s"})
    until_s = firing.until_unix_s
    return {
        **kept,
        "due": _time(orders, firing.due_unix_s),
        "at": _time(orders, firing.at_unix_s),
        "until": _time(orders, until_s) if until_s is not None else None,
    }


def _view_run(orders: StandingOrders, order: StandingOrder, firing: Firing) -> dict[str, Any]:
    """Return a firing with its order's words, and in words why it did not run."""
    if firing.told is None and firing.state is FiringState.MISSED:
        zone, now_s = orders.keeper.book.zone, orders.keeper.clocks.unix()
        firing = firing.model_copy(update={"told": tell_missed(order, firing, zone, now_s)})
    return {**firing_view(orders, firing), "text": order.text}


def _runs(orders: StandingOrders, order: StandingOrder) -> list[str]:
    due_s = orders.keeper.book.due.get(order.id)
    if due_s is None:
        return []
    later = coming_runs(order, due_s, orders.keeper.book.zone, RUNS_SHOWN - 1)
    return [_time(orders, each) for each in (due_s, *later)]


def _time(orders: StandingOrders, unix_s: float) -> str:
    """Return an instant on the robot's own clock, with its offset."""
    return datetime.fromtimestamp(unix_s, orders.keeper.book.zone).isoformat(timespec="seconds")
