"""Be a model's server that fails in every way that ``faults`` names, step by step."""

from __future__ import annotations

import asyncio
import itertools
import json
import time
from typing import TYPE_CHECKING, Any

from starlette.responses import Response, StreamingResponse

from planner.brain import ThinkRequest
from planner.plan import StepPlan
from pons.mock_llm import MockServer, Switches
from pons.mock_llm.completion import EVENTS, Cut
from pons.mock_llm.replies import reply_of
from pons.mock_llm.server import LOOK_S
from tests.pons.mock_llm import bad_pictures, bad_streams
from tests.pons.mock_llm.bad_answers import BARREN, refusal_of
from tests.pons.mock_llm.bad_completion import bad_completion, bytes_of
from tests.pons.mock_llm.bad_replies import hallucinate, hostile, shape_reply
from tests.pons.mock_llm.faults import BadSwitches
from tests.pons.mock_llm.pictures import asked_of, dicts

if TYPE_CHECKING:
    from starlette.requests import Request

Body = dict[str, Any]
_WELL = (None, "status", "hang", "cold", "garbage", "stream_breaks")
"""Left to the server that is shipped."""
_PLAINLY = ("plain", "not_json", "no_choices", "error_200", "packed")


class BadServer(MockServer):
    """Spoil one step of an answer."""

    def __init__(self, switches: BadSwitches | None = None) -> None:
        super().__init__(switches or BadSwitches())
        self._hostile, self._badly = itertools.count(), itertools.count()
        self.is_loaded = False
        """Told of a cold model alone."""
        self.left_load = 0
        """Clients that left while it loaded, and so ended the load."""

    async def instead(self, fault: str | None, body: Body, request: Request) -> Response | None:
        if fault == "slow_pictures" and bad_pictures.holds_picture(body):
            return await self.hang(request)
        if fault == "cold":
            await self._load(request)
        refused = refusal_of(fault, body, self.switches.retry_after)
        return refused or await super().instead(fault, body, request)

    async def _load(self, request: Request) -> None:
        """Load a cold model while this client stays; one that leaves ends the load."""
        assert isinstance(self.switches, BadSwitches)
        began_s, load_s = time.monotonic(), self.switches.load_s
        while not (self.is_loaded or self.ending()):
            if await request.is_disconnected():
                self.left_load += 1
                return
            self.is_loaded = time.monotonic() - began_s >= load_s
            await asyncio.sleep(LOOK_S)

    def set(self, switches: Switches) -> None:
        super().set(switches)
        self.is_loaded = False

    def report(self) -> dict[str, Any]:
        return {**super().report(), "left_load": self.left_load}

    def tell_picture(self, fault: str | None, body: Body, place: str) -> str | None:
        about = asked_of(body)
        if about is None:
            return None
        return bad_pictures.answer_badly(about, fault, next(self._badly), place)

    async def plan(self, fault: str | None, asked: ThinkRequest, body: Body) -> dict[str, Any]:
        if fault == "obeys_pictures":
            asked = await self._obey(asked, bad_pictures.words_read(body))
        if fault in ("obeys_pictures", "schema_ignored"):
            return reply_of((await self.brain.think(asked)).plan, asked.text)
        return only_reply(body) or await super().plan(fault, asked, body)

    async def _obey(self, asked: ThinkRequest, told: list[str]) -> ThinkRequest:
        """Return the order that a planner follows which takes what it reads for orders."""
        for words in told:
            wanted = asked.model_copy(update={"text": words, "language": None})
            if isinstance((await self.brain.think(wanted)).plan, StepPlan):
                return wanted
        vaguely = bad_pictures.vague_order("\n".join(told), [*asked.vocabulary.by_id])
        return asked if vaguely is None else asked.model_copy(update={"text": vaguely})

    def write(
        self, fault: str | None, good: str, place: str, body: Body, request: Request
    ) -> tuple[str | None, Body]:
        if fault in BARREN and BARREN[fault](body):
            text = "" if fault != "tool_never" else "I will go to the kitchen for you!"
            return text, {**body, "tool_choice": None}
        match fault:
            case "hallucinate":
                return json.dumps(hallucinate(json.loads(good)), ensure_ascii=False), body
            case "hostile":
                return hostile(next(self._hostile), place), body
            case "echo_key":
                words = f"the key is {request.headers.get('authorization', 'none')}"
                return json.dumps({"kind": "answer", "en": words, "zh": words}), body
            case "garbage":
                return super().write(fault, good, place, body, request)
        return shape_reply(fault, good, place), body

    async def send(self, fault: str | None, text: str | None, body: Body) -> Response:
        if fault in _WELL:
            return await super().send(fault, text, body)
        whole = bad_completion(body, text, fault)
        raw, headers = bytes_of(whole, fault)
        json_type = headers.pop("Content-Type", "application/json")
        match fault:
            case "endless":
                return StreamingResponse(bad_streams.endless(self.ending), media_type=json_type)
            case "huge":
                size = {"Content-Length": str(bad_streams.HUGE_BYTES)}
                parts = bad_streams.huge(self.ending)
                return StreamingResponse(parts, media_type=json_type, headers=size)
            case "drip":
                return StreamingResponse(bad_streams.drip(raw, self.ending), media_type=json_type)
            case "lost":
                return Cut(bad_streams.half(raw), json_type)
        if body.get("stream") is True and fault not in _PLAINLY:
            rate = self.switches.tokens_per_s
            parts = bad_streams.bad_events(whole, fault, rate, self.ending, self.wrote)
            return StreamingResponse(parts, media_type=EVENTS)
        return Response(raw, media_type=json_type, headers=headers)


def only_reply(body: dict[str, Any]) -> dict[str, Any] | None:
    """Return the one reply that the request's schema allows, or None where it leaves a choice.

    The mock's model is none that a schema could hold, but for one that leaves nothing to it.
    """
    form, tools = body.get("response_format"), dicts(body.get("tools"))
    schema = form.get("json_schema", {}).get("schema") if isinstance(form, dict) else None
    if schema is None and tools:
        schema = tools[0].get("function", {}).get("parameters")
    if not isinstance(schema, dict):
        return None
    fields, required = schema.get("properties"), schema.get("required")
    if not isinstance(fields, dict) or not isinstance(required, list):
        return None
    filled = {name: _only_value(shape) for name, shape in fields.items() if name in required}
    return filled if filled and None not in filled.values() else None


def _only_value(shape: object) -> object:
    if not isinstance(shape, dict):
        return None
    words = shape.get("enum")
    if isinstance(words, list) and len(words) == 1:
        return words[0]
    return False if shape.get("type") == "boolean" else None
