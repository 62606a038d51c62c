"""Be a model's server that works, or that fails in one of the few ways that a person may try.

Every step of an answer is a method: the tests' own server spoils many more of them.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections import Counter, deque
from collections.abc import AsyncIterator, Callable
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field, field_validator
from starlette.responses import JSONResponse, Response, StreamingResponse

from planner.brain import OfflineBrain, ThinkRequest
from pons.mock_llm.completion import EVENTS, Cut, completion, events
from pons.mock_llm.replies import GARBAGE, reply_of

if TYPE_CHECKING:
    from starlette.requests import Request

KEPT = 1000
LOOK_S = 0.05
FAULTS: dict[str, str] = {
    "status": "answer with an HTTP status, 500 unless --status says which",
    "hang": "take the request and never answer",
    "garbage": "reply with prose and broken JSON",
    "stream_breaks": "close the connection in the middle of a stream",
}


class Switches(BaseModel):
    """Say how the mock behaves from now on."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    faults: ClassVar[dict[str, str]] = FAULTS
    fault: str | None = None
    times: int | None = Field(default=None, ge=1, le=1_000_000)
    """Calls until the fault is gone; None: it stays."""
    delay_s: float = Field(default=0.0, ge=0.0, le=3600.0)
    tokens_per_s: float | None = Field(default=None, ge=0.1, le=100_000.0)
    """How fast the model writes, four characters to a token; None: at once."""
    status: int = Field(default=500, ge=400, le=599)
    retry_after: str | None = Field(default=None, max_length=100)
    """The header of that name, as it is."""

    @field_validator("fault")
    @classmethod
    def _check_fault(cls, fault: str | None) -> str | None:
        if fault is not None and fault not in cls.faults:
            raise ValueError(f"unknown fault {fault!r}; known: {', '.join(cls.faults)}")
        return fault


class MockServer:
    """Hold the switches and the requests, and answer step by step."""

    def __init__(self, switches: Switches) -> None:
        self.switches, self.brain = switches, OfflineBrain()
        self.calls, self.left = 0, switches.times
        self.served: Counter[str] = Counter()
        self.wrote_s: deque[float] = deque(maxlen=KEPT)
        """When the last token of each stream was sent, on the monotonic clock of this machine."""
        self.ending: Callable[[], bool] = lambda: False
        """Tells that the server is asked to end, so that what hangs lets go."""

    def set(self, switches: Switches) -> None:
        """Behave so from now on; counts go on, the fault's number of times begins anew."""
        self.switches, self.left = switches, switches.times

    def next_fault(self) -> str | None:
        """Return the fault of this call."""
        fault = self.switches.fault if self.left is None or self.left > 0 else None
        if fault is not None and self.left is not None:
            self.left -= 1
        self.calls += 1
        self.served[fault or "none"] += 1
        return fault

    def report(self) -> dict[str, Any]:
        """Return switches and counts."""
        shown = self.switches.model_dump(mode="json")
        counts = {"calls": self.calls, "served": dict(self.served)}
        return {"switches": shown, **counts, "wrote_s": list(self.wrote_s)}

    async def instead(
        self, fault: str | None, body: dict[str, Any], request: Request
    ) -> Response | None:
        """Return an answer that is no completion, or None where one is due."""
        if fault == "status":
            wait = self.switches.retry_after
            later = {"Retry-After": wait} if wait is not None else {}
            return error(self.switches.status, f"mock status {self.switches.status}", later)
        if fault == "hang":
            return await self.hang(request)
        return None

    async def hang(self, request: Request) -> Response:
        """Wait until the client leaves."""
        while not (self.ending() or await request.is_disconnected()):  # noqa: ASYNC110  # nothing tells of it
            await asyncio.sleep(LOOK_S)
        return error(499, "the client left")

    def tell_picture(self, fault: str | None, body: dict[str, Any], place: str) -> str | None:
        """Return the reply to a question about a picture; None where an order is given.

        This model sees nothing. ``place`` is thought to exist.
        """
        del fault, body, place
        return None

    async def plan(
        self, fault: str | None, asked: ThinkRequest, body: dict[str, Any]
    ) -> dict[str, Any]:
        """Return the reply to an order."""
        del fault, body
        return reply_of((await self.brain.think(asked)).plan, asked.text)

    def write(
        self, fault: str | None, good: str, place: str, body: dict[str, Any], request: Request
    ) -> tuple[str | None, dict[str, Any]]:
        """Return what the model writes for a good reply, and the request as it takes it."""
        del place, request
        garbage = GARBAGE[self.served["garbage"] % len(GARBAGE)]
        return garbage if fault == "garbage" else good, body

    async def send(self, fault: str | None, text: str | None, body: dict[str, Any]) -> Response:
        """Send a text as a completion, as a stream where one was asked for."""
        whole, rate = completion(body, text), self.switches.tokens_per_s
        if body.get("stream") is not True:
            if rate is not None:
                await asyncio.sleep(whole["usage"]["completion_tokens"] / rate)
            return Response(json.dumps(whole, ensure_ascii=False), media_type="application/json")
        breaks = fault == "stream_breaks"
        parts: AsyncIterator[bytes] = events(whole, rate, self.wrote, breaks=breaks)
        make = Cut if breaks else StreamingResponse
        return make(parts, media_type=EVENTS)

    def wrote(self) -> None:
        """Note that a stream's last token is out."""
        self.wrote_s.append(time.monotonic())


def error(
    status: int, words: str, headers: dict[str, str] | None = None, code: str | None = None
) -> Response:
    """Return an error as OpenAI's servers write one."""
    content = {"error": {"message": words, "type": "mock", "code": code or status}}
    return JSONResponse(content, status_code=status, headers=headers)
