"""Follow the planner's event socket from another process, with the token that this one has.

Owns the socket and its dialling; what a frame means is the follower's.
"""

from __future__ import annotations

import asyncio
import base64
import json
import logging
import os
import ssl
from typing import TYPE_CHECKING, Any, NoReturn

from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException

from pons.http import AUTHORITY, PlannerDown, PlannerProblem
from processes.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable

    from pons.settings import LaunchSettings

log = logging.getLogger("events")

SILENT_S = 5.0
"""The planner says how the robot is at least five times a second."""
_FIRST_S, _LONGEST_S = 0.5, 5.0
_MAX_FRAME_BYTES = 4_000_000
_HEAD = 60
"""A frame's kind stands so early: others are not worth parsing."""


async def follow_events(
    settings: LaunchSettings,
    kinds: Iterable[str],
    take: Callable[[dict[str, Any]], Awaitable[None]],
    lost: Callable[[], None],
) -> NoReturn:
    """Hand on frames of some kinds for ever; a planner that is away is dialled again.

    Args:
        settings: where the planner is.
        kinds: of frames; each connection begins with a ``snapshot``.
        take: is given each frame; it may ask the planner, and raise as ``pons.http.call``.
        lost: is told when a connection ends or can't be made.
    """
    backoff, told = Backoff(_FIRST_S, _LONGEST_S), ""
    marks = tuple(f'"kind":"{kind}"' for kind in kinds)
    while True:
        try:
            await _follow_once(settings, marks, take, backoff)
        except (OSError, TimeoutError, WebSocketException, PlannerDown, PlannerProblem) as why:
            if (trouble := f"planner_down: {settings.url}: {why}") != told:
                told = trouble
                log.warning("%s", trouble)
        lost()
        await asyncio.sleep(backoff.pause_after())


async def _follow_once(
    settings: LaunchSettings,
    marks: tuple[str, ...],
    take: Callable[[dict[str, Any]], Awaitable[None]],
    backoff: Backoff,
) -> None:
    async with connect(
        settings.url.replace("http", "ws", 1) + "/v1/events",
        ssl=_tls_context(settings),
        subprotocols=_subprotocols(),  # type: ignore[arg-type]  # plain words are enough
        max_size=_MAX_FRAME_BYTES,
        max_queue=4,
        compression=None,
        open_timeout=SILENT_S,
        close_timeout=1.0,
        proxy=None,
    ) as socket:
        while True:
            async with asyncio.timeout(SILENT_S):
                text = await socket.recv()
            if isinstance(text, str) and any(mark in text[:_HEAD] for mark in marks):
                await take(json.loads(text))
                backoff.reset()


def _tls_context(settings: LaunchSettings) -> ssl.SSLContext | None:
    """Return what judges the planner's certificate, as ``pons.http`` does."""
    if not settings.tls:
        return None
    file = settings.authority or settings.home / AUTHORITY
    there = settings.authority is not None or os.access(file, os.R_OK)
    return ssl.create_default_context(cafile=str(file) if there else None)


def _subprotocols() -> list[str] | None:
    """Return how the token is shown where one is set (planner/api/access.py)."""
    token = os.environ.get("PONS_OPERATOR_TOKEN", "")
    if not token:
        return None
    word = base64.urlsafe_b64encode(token.encode()).decode().rstrip("=")
    return ["pons.v1", f"bearer.{word}"]
