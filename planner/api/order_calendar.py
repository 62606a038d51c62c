"""Serve standing orders as an iCalendar file, and take one: told first, kept by a yes."""

from __future__ import annotations

import uuid
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Response
from pydantic import Field

from planner.api.order_problems import problem
from planner.api.schemas import Body, Source
from planner.orders.calendar_import import ImportedEntry, keep_proposed, propose
from planner.orders.calendar_orders import write_orders
from planner.orders.calendar_text import MOST_CHARACTERS
from planner.orders.errors import OrderRefusal
from planner.orders.telling import tell_record, tell_rule

if TYPE_CHECKING:
    from planner.orders.factory import StandingOrders

CALENDAR = "text/calendar; charset=utf-8"


class CalendarFile(Body):
    """Take orders from a calendar: without ``agreed`` they are told, and nothing is kept."""

    calendar: Annotated[str, Field(min_length=1, max_length=MOST_CHARACTERS)]
    """The text of an iCalendar file."""
    agreed: Annotated[str, Field(min_length=32, max_length=32)] | None = None
    """The ``agree`` of the answer that told them: a person's yes to just these."""
    source: Source = "api"


def add_routes(router: APIRouter, orders: StandingOrders) -> None:
    """Add the calendar to the routes of orders; before those that take an id."""

    @router.get(".ics", operation_id="export_orders", response_class=Response,
                responses={200: {"content": {CALENDAR: {}}}})  # fmt: skip
    async def export() -> Response:
        """Write the standing orders that have not ended as an iCalendar file."""
        keeper = orders.keeper
        kept = sorted(keeper.book.orders.values(), key=lambda order: order.number)
        text = write_orders(kept, keeper.book.zone, keeper.clocks.unix())
        return Response(text, media_type=CALENDAR)

    @router.post(".ics", operation_id="import_orders")
    async def take(new: CalendarFile) -> dict[str, Any]:
        """Tell what a calendar file would have kept; with ``agreed``, keep just that.

        Nothing of a file is kept without a yes. What can't be kept is told with its code, and why.
        """
        desk, goal_id = orders.intake, f"order-{uuid.uuid4().hex[:12]}"
        try:
            imported = await propose(new.calendar, orders.keeper, desk, new.source, goal_id)
            agreed = new.agreed
            kept = await keep_proposed(imported, agreed, desk, goal_id) if agreed else ()
        except OrderRefusal as refused:
            raise problem(refused) from None
        return {
            "agree": imported.digest,
            "proposed": [_view(orders, each) for each in imported.proposals if each.new],
            "refused": [
                {"name": p.name, "code": p.refused.code, "message": p.refused.message.model_dump()}
                for p in imported.proposals
                if p.refused is not None
            ],
            "kept": [order.id for order in kept],
        }


def _view(orders: StandingOrders, each: ImportedEntry) -> dict[str, Any]:
    if each.new is None or each.rule is None:
        return {}
    when = tell_rule(each.rule, orders.keeper.book.zone, orders.keeper.clocks.unix())
    return {
        "name": each.name,
        "order": each.new.order,
        "reminder": each.new.reminder,
        "when": when.model_dump(),
        "does": tell_record(orders.intake.facts, each.allowed).model_dump(),
        "may": [step.model_dump(mode="json", exclude_none=True) for step in each.allowed],
        "skipped": [day.isoformat() for day in each.new.skipped],
        "paused": each.new.paused,
    }
