"""Be a model's server that fails in every way that ``faults`` names, step by step."""

from __future__ import annotations

import itertools
import json
from typing import TYPE_CHECKING, Any

from starlette.responses import Response, StreamingResponse

from planner.brain import ThinkRequest
from planner.plan import StepPlan
from pons.mock_llm import MockServer
from pons.mock_llm.completion import EVENTS, Cut
from pons.mock_llm.replies import reply_of
from tests.pons.mock_llm import bad_pictures, bad_streams
from tests.pons.mock_llm.bad_answers import BARREN, refusal_of
from tests.pons.mock_llm.bad_completion import bad_completion, bytes_of
from tests.pons.mock_llm.bad_replies import hallucinate, hostile, shape_reply
from tests.pons.mock_llm.faults import BadSwitches
from tests.pons.mock_llm.pictures import asked_of

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

    async def instead(self, fault: str | None, body: Body, request: Request) -> Response | None:
        if fault == "slow_pictures" and bad_pictures.holds_picture(body):
            return await self.hang(request)
        refused = refusal_of(fault, body, self.switches.retry_after)
        return refused or await super().instead(fault, body, request)

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
        return await super().plan(fault, asked, body)

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
