"""Serve the meter: the model's cost, the limits, and when the budget comes back."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query

from planner.api.interfaces import Services
from planner.budget import Usage

OneGoal = Annotated[str | None, Query(max_length=80)]


def routes(services: Services) -> APIRouter:
    """Return the meter's route."""
    router = APIRouter(prefix="/v1", tags=["usage"])

    @router.get("/usage", operation_id="get_usage")
    async def usage(goal: OneGoal = None) -> Usage:
        """Show calls, tokens, seconds and money spent today, and by one goal where it is named."""
        await services.budget.look(goal)
        return services.budget.usage(goal)

    return router


def usage_view(services: Services) -> dict[str, Any]:
    """Return the meter as the event stream tells it."""
    return services.budget.usage().model_dump(mode="json")
