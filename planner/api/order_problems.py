"""Say over HTTP why a standing order was refused."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.api.problems import HttpProblem

if TYPE_CHECKING:
    from planner.orders.errors import OrderRefusal

STATUS = {
    "unknown_order": 404,
    "order_ended": 409,
    "orders_full": 409,
    "calendar_changed": 409,
    "order_skips_full": 409,
    "orders_unwritable": 503,
}


def problem(refused: OrderRefusal) -> HttpProblem:
    """Say a refusal over HTTP, in both languages."""
    status = STATUS.get(refused.code, 422)
    return HttpProblem(status, refused.code, refused.detail, message=refused.message.model_dump())
