"""Serve the owner's tool servers: how each stands, what may be asked, and why the rest may not."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from fastapi import APIRouter
from pydantic import BaseModel

from planner.language.catalogue import say
from planner.plan import Bilingual, ToolParameter
from planner.state_database import StateUnavailable

if TYPE_CHECKING:
    from planner.api.interfaces import Services
    from planner.tool_servers.desk import ServerState


class ToolView(BaseModel):
    """Show one tool that may be asked."""

    name: str
    about: str
    """The server's own words: data."""
    parameters: tuple[ToolParameter, ...]
    writes: bool
    """A person says yes to each call."""


class LeftOutTool(BaseModel):
    """Show one tool that may not be asked, with a stable code and the cure."""

    name: str
    code: str
    message: Bilingual


class ToolServerView(BaseModel):
    """Show one server."""

    name: str
    host: str
    tools: tuple[ToolView, ...]
    left_out: tuple[LeftOutTool, ...]
    problem: str | None
    """Why its list could not be fetched last, a stable code; none: it was."""
    message: Bilingual | None
    calls_today: int | None
    """None: the counts can't be read."""
    day_calls: int


class ToolServerList(BaseModel):
    """Show all servers that the owner lists."""

    asked_by: str | None
    """The model that may ask them; none: the built-in rules know no tools."""
    message: Bilingual | None
    """The cure where nobody may ask them."""
    servers: tuple[ToolServerView, ...]


def routes(services: Services) -> APIRouter:
    """Return the route of the owner's tool servers."""
    router = APIRouter(prefix="/v1/tools", tags=["tools"])

    @router.get("", operation_id="list_tools")
    async def several() -> ToolServerList:
        """List the owner's servers as they stood when they were asked last; nothing is asked."""
        counts: dict[str, int] | None
        try:
            counts = await asyncio.to_thread(services.tools.count_today)
        except StateUnavailable:
            counts = None
        name = services.brain.tag.name
        is_model = name != "offline"
        return ToolServerList(
            asked_by=name if is_model else None,
            message=None if is_model else say("tool_problem.no_model"),
            servers=tuple(_show(state, counts) for state in services.tools.states),
        )

    return router


def _show(state: ServerState, counts: dict[str, int] | None) -> ToolServerView:
    left_out = (
        LeftOutTool(name=name, code=code, message=say(f"tool_problem.{code}"))
        for name, code in state.listing.left_out
    )
    return ToolServerView(
        name=state.name,
        host=state.settings.address.host,
        tools=tuple(
            ToolView(name=t.name, about=t.about, parameters=t.parameters, writes=t.writes)
            for t in state.listing.tools
        ),
        left_out=tuple(left_out),
        problem=state.problem,
        message=None if state.problem is None else say(f"tool_problem.{state.problem}"),
        calls_today=None if counts is None else counts.get(state.name, 0),
        day_calls=state.settings.day_calls,
    )
