"""Know what the owner's tool servers offer, and call one tool: judged, counted, bounded.

Nobody waits for a server: lists are fetched beside everything else, and one that hangs or is down
is asked again later. A call is judged anew by the settings and the newest list, whatever a plan
says. Its result is words of a stranger, and stays apart from what we say of it.
"""

from __future__ import annotations

import asyncio
import logging
import time
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from planner.language.catalogue import message, say
from planner.language.plan_words import name_call
from planner.mission.events import ToolAnswered
from planner.outbound import CallFailure
from planner.plan import Code, Tool
from planner.state_database import StateUnavailable
from planner.tool_servers.calls import CallLedger
from planner.tool_servers.listing import ToolListing, arguments_of, clean, judge_listing

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from planner.mission.effects import AskTool
    from planner.outbound.tool_server import ToolServer
    from planner.settings import ToolServerSettings
    from planner.state_database import StateDatabase

log = logging.getLogger(__name__)

FRESH_S = 900.0
"""A list is fetched again after so long."""
RETRY_S, MOST_RETRY_S = 15.0, 600.0
"""After a failure; doubles."""
MOST_READ = 900
"""Characters of an answer that are kept, shown and told."""
_PROBLEMS = frozenset(
    {"unreachable", "refused_address", "timeout", "redirect", "bad_key", "rate_limited"}
    | {"unknown_route", "bad_request", "server_error", "too_large", "bad_reply", "tool_error"}
    | {"needs_input"}
)


@dataclass(frozen=True, slots=True)
class ServerState:
    """Say how one server stands."""

    name: str
    settings: ToolServerSettings
    listing: ToolListing = field(default_factory=ToolListing)
    problem: str | None = "not_asked_yet"
    """A stable code of why its list could not be fetched last; None: it was."""
    detail: str = ""
    fetched_s: float | None = None
    """When the list came, on the monotonic clock."""


class ToolDesk:
    """Hold the owner's servers. Does nothing, and loads nothing, where there are none."""

    def __init__(
        self,
        servers: Mapping[str, ToolServerSettings],
        database: StateDatabase,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Open nothing yet."""
        self._states = {name: ServerState(name, each) for name, each in servers.items()}
        self._ledger, self._clock = CallLedger(database), clock
        self._clients: dict[str, ToolServer] = {}
        self._tasks: list[asyncio.Task[None]] = []
        self._tools: tuple[Tool, ...] = ()

    @property
    def tools(self) -> tuple[Tool, ...]:
        """Return what may be asked now, in the order of the settings."""
        return self._tools

    @property
    def states(self) -> tuple[ServerState, ...]:
        """Return how each server stands."""
        return tuple(self._states.values())

    def count_today(self) -> dict[str, int]:
        """Return today's calls by server; blocks on the disk."""
        return self._ledger.list_today()

    async def start(self) -> None:
        """Begin to fetch the lists; returns at once."""
        for name in self._states:
            work = self._keep_fresh(name)
            self._tasks.append(asyncio.create_task(work, name=f"tools of {name}"))

    async def close(self) -> None:
        """End everything, and give the connections back."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        for client in self._clients.values():
            await client.close()

    async def _keep_fresh(self, name: str) -> None:
        retry_s = RETRY_S
        while True:
            good = await self.fetch(name)
            await asyncio.sleep(FRESH_S if good else retry_s)
            retry_s = RETRY_S if good else min(2.0 * retry_s, MOST_RETRY_S)

    async def fetch(self, name: str) -> bool:
        """Fetch one server's list; return whether it came. What was known is kept meanwhile."""
        state = self._states[name]
        try:
            listed = await (await self._client(name)).list_tools()
        except CallFailure as failure:
            if state.problem != failure.why:
                log.warning("tools_unreachable: %s: %s (%s)", name, failure.why, failure)
            self._states[name] = replace(
                state, problem=failure.why, detail=clean(str(failure), 200)
            )
            return False
        listing = judge_listing(name, state.settings, listed)
        self._states[name] = replace(
            state, listing=listing, problem=None, detail="", fetched_s=self._clock()
        )
        self._tools = tuple(tool for each in self._states.values() for tool in each.listing.tools)
        if listing != state.listing:
            log.info("%s offers %d tools", name, len(listing.tools))
        return True

    async def _client(self, name: str) -> ToolServer:
        if name not in self._clients:
            from planner.outbound.tool_server import ToolServer  # httpx costs 0.1 s

            chosen = self._states[name].settings
            key = chosen.key.get_secret_value() if chosen.key is not None else ""
            self._clients[name] = ToolServer(
                chosen.address, key, timeout_s=chosen.timeout_s, most_bytes=chosen.max_bytes
            )
        return self._clients[name]

    async def answer(self, asked: AskTool) -> ToolAnswered:
        """Make a call and return what came of it; what fails has a code."""
        tool = next((each for each in self._tools if each.name == asked.tool), None)
        if tool is None:
            return fail_call(asked, "tool_unknown")
        try:
            arguments = arguments_of(tool, asked.arguments)
        except ValueError as wrong:
            return fail_call(asked, "tool_arguments", str(wrong))
        call = name_call(asked.tool, asked.arguments)
        if tool.writes and not asked.agreed:
            return ToolAnswered(asked.id, asked.ticket, say("tool.shall_i", call=call), asks=True)
        if (over := await self._count(tool.server, asked.id)) is not None:
            return fail_call(asked, over)
        log.info("goal %s calls %s", asked.id, tool.name)
        try:
            client = await self._client(tool.server)
            reply = await client.call(tool.name.partition(".")[2], arguments)
        except CallFailure as failure:
            log.warning("goal %s: %s: %s (%s)", asked.id, tool.name, failure.why, failure)
            return fail_call(asked, failure.why if failure.why in _PROBLEMS else "bad_reply")
        words = clean(reply.text, MOST_READ)
        read = say("tool.answers", server=tool.server, words=words) if words else None
        if reply.is_error:
            return replace(fail_call(asked, "tool_error"), read=read)
        read = read or say("tool.answers_nothing", server=tool.server)
        return ToolAnswered(asked.id, asked.ticket, say("tool.asked", call=call), read)

    async def _count(self, server: str, goal: str) -> str | None:
        """Count a call before it is made, or return why it may not be."""
        chosen = self._states[server].settings
        bounds = (chosen.goal_calls, chosen.day_calls)
        try:
            return await asyncio.to_thread(self._ledger.count, server, goal, *bounds)
        except StateUnavailable as broken:
            log.warning("calls of tools can't be counted: %s", broken)
            return "tool_uncounted"


def fail_call(asked: AskTool, problem: str, detail: str = "") -> ToolAnswered:
    """Return a failure in our own words; ``detail`` is ours, too, never a server's."""
    why = say(f"tool_problem.{problem}", detail=clean(detail, 120))
    said = message(Code.TOOL_FAILED, call=name_call(asked.tool, asked.arguments), why=why)
    return ToolAnswered(asked.id, asked.ticket, said, problem=problem)
