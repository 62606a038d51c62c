"""Answer chat completions as the switches say. One application is one mock; it keeps counts."""

from __future__ import annotations

import asyncio
import itertools
import json
import time
from collections import Counter, deque
from collections.abc import Callable
from typing import Any

from fastapi import FastAPI, Request
from starlette.responses import JSONResponse, Response, StreamingResponse

from planner.brain import OfflineBrain, ThinkRequest
from planner.plan import StepPlan
from pons.mock_llm import pictures, streams, voices
from pons.mock_llm.completion import bytes_of, completion
from pons.mock_llm.error_replies import BARREN, LOOK_S, error, instead_of_a_reply
from pons.mock_llm.fault_switches import Switches
from pons.mock_llm.replies import GARBAGE, hallucinate, hostile, reply_of, shape_reply
from pons.mock_llm.request_parser import only_reply, request_of

MAX_BODY = 4_000_000
KEPT = 1000
EVENTS = "text/event-stream"


class Mock:
    """Hold the switches and the requests."""

    def __init__(self, switches: Switches) -> None:
        self.switches = switches
        self.calls = 0
        self.left = switches.times
        self.served: Counter[str] = Counter()
        self.hostile = itertools.count()
        self.badly = itertools.count()
        self.is_loaded = False
        """Told of a cold model alone."""
        self.left_load = 0
        """Clients that left while it loaded, and so ended the load."""
        self.wrote_s: deque[float] = deque(maxlen=KEPT)
        """When the last token of each stream was sent, on the monotonic clock of this machine."""
        self.ending: Callable[[], bool] = lambda: False
        """Tells that the server is asked to end, so that what hangs lets go."""

    def set(self, switches: Switches) -> None:
        """Behave so from now on; counts go on, the fault's number of times begins anew."""
        self.switches, self.left, self.is_loaded = switches, switches.times, False

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
        counts = {"calls": self.calls, "served": dict(self.served), "left_load": self.left_load}
        return {"switches": shown, **counts, "wrote_s": list(self.wrote_s)}

    async def load(self, request: Request) -> None:
        """Load a cold model while this client stays; one that leaves ends the load."""
        began_s = time.monotonic()
        while not (self.is_loaded or self.ending()):
            if await request.is_disconnected():
                self.left_load += 1
                return
            self.is_loaded = time.monotonic() - began_s >= self.switches.load_s
            await asyncio.sleep(LOOK_S)

    def wrote(self) -> None:
        """Note that a stream's last token is out."""
        self.wrote_s.append(time.monotonic())


def build(switches: Switches | None = None) -> FastAPI:
    """Return the application of one mock."""
    mock, brain = Mock(switches or Switches()), OfflineBrain()
    app = FastAPI(title="pons mock-llm", docs_url=None, redoc_url=None, openapi_url=None)
    app.state.mock = mock
    _add_voices(app, mock)

    @app.get("/mock")
    async def look() -> dict[str, Any]:
        return mock.report()

    @app.post("/mock")
    async def switch(wanted: Switches) -> dict[str, Any]:
        mock.set(wanted)
        return mock.report()

    @app.get("/v1/models")
    async def models() -> dict[str, Any]:
        return {"object": "list", "data": [{"id": "pons-mock", "object": "model"}]}

    @app.post("/v1/chat/completions")
    async def complete(request: Request) -> Response:
        fault = mock.next_fault()
        body = await _body(request)
        if body is None:
            return error(400, "the body is no JSON object of a chat request")
        if fault == "cold":
            await mock.load(request)
        await asyncio.sleep(mock.switches.delay_s)
        early = await instead_of_a_reply(fault, mock.switches, mock.ending, body, request)
        if early is not None:
            return early
        about = pictures.asked_of(body)
        asked = request_of(body)
        if about is not None:
            place = next(iter(asked.vocabulary.by_id), "kitchen")
            said = pictures.answer(about, fault, next(mock.badly), place)
            return await _answer(fault, completion(body, said, fault), body, mock)
        if fault == "obeys_pictures":
            asked = await obeying(brain, asked, pictures.words_read(body))
        held = only_reply(body) if fault != "schema_ignored" else None
        reply = held or reply_of((await brain.think(asked)).plan, asked.text)
        good = json.dumps(reply, ensure_ascii=False)
        known = next(iter(asked.vocabulary.by_id), "kitchen")
        text = _reply_text(fault, good, mock, known, request)
        if fault in BARREN and BARREN[fault](body):
            text = "" if fault != "tool_never" else "I will go to the kitchen for you!"
            body = {**body, "tool_choice": None}
        return await _answer(fault, completion(body, text, fault), body, mock)

    return app


def _add_voices(app: FastAPI, mock: Mock) -> None:
    """Add the routes of a server that hears and speaks."""

    @app.post("/v1/audio/transcriptions")
    async def transcribe(request: Request) -> Response:
        fault = mock.next_fault()
        raw = await _raw(request)
        await asyncio.sleep(mock.switches.delay_s)
        early = await instead_of_a_reply(fault, mock.switches, mock.ending, {}, request)
        if early is not None:
            return early
        told = None if raw is None else voices.transcription(mock.switches, raw)
        if told is None:
            return error(400, "no WAV came with the request")
        if fault == "garbage":
            return Response(GARBAGE[mock.calls % len(GARBAGE)], media_type="application/json")
        return JSONResponse(told)

    @app.post("/v1/audio/speech")
    async def speak(request: Request) -> Response:
        fault = mock.next_fault()
        body = await _body(request)
        await asyncio.sleep(mock.switches.delay_s)
        early = await instead_of_a_reply(fault, mock.switches, mock.ending, {}, request)
        if early is not None:
            return early
        if body is None or not isinstance(body.get("input"), str):
            return error(400, "the body is no JSON object with a text input")
        sound = b"no sound" if fault == "garbage" else voices.tone(body["input"])
        return Response(sound, media_type="audio/wav")


async def obeying(brain: OfflineBrain, asked: ThinkRequest, told: list[str]) -> ThinkRequest:
    """Return the order that a planner follows which takes what it reads of pictures for orders."""
    for words in told:
        wanted = asked.model_copy(update={"text": words, "language": None})
        if isinstance((await brain.think(wanted)).plan, StepPlan):
            return wanted
    vaguely = pictures.vague_order("\n".join(told), [*asked.vocabulary.by_id])
    return asked if vaguely is None else asked.model_copy(update={"text": vaguely})


async def _raw(request: Request) -> bytes | None:
    raw = bytearray()
    async for chunk in request.stream():
        raw += chunk
        if len(raw) > MAX_BODY:
            return None
    return bytes(raw)


async def _body(request: Request) -> dict[str, Any] | None:
    raw = await _raw(request)
    if raw is None:
        return None
    try:
        body = json.loads(raw)
    except (ValueError, RecursionError):
        return None
    return body if isinstance(body, dict) else None


def _reply_text(
    fault: str | None, good: str, mock: Mock, known: str, request: Request
) -> str | None:
    """Return the content of the reply."""
    match fault:
        case "garbage":
            return GARBAGE[mock.served["garbage"] % len(GARBAGE)]
        case "hallucinate":
            return json.dumps(hallucinate(json.loads(good)), ensure_ascii=False)
        case "hostile":
            return hostile(next(mock.hostile), known)
        case "echo_key":
            words = f"the key is {request.headers.get('authorization', 'none')}"
            return json.dumps({"kind": "answer", "en": words, "zh": words})
    return shape_reply(fault, good, known)


async def _answer(
    fault: str | None, whole: dict[str, Any], body: dict[str, Any], mock: Mock
) -> Response:
    """Send a completion, as a stream where one was asked for."""
    ending, rate = mock.ending, mock.switches.tokens_per_s
    raw, headers = bytes_of(whole, fault)
    json_type = headers.pop("Content-Type", "application/json")
    match fault:
        case "endless":
            return StreamingResponse(streams.endless(ending), media_type=json_type)
        case "huge":
            size = {"Content-Length": str(streams.HUGE_BYTES)}
            return StreamingResponse(streams.huge(ending), media_type=json_type, headers=size)
        case "drip":
            return StreamingResponse(streams.drip(raw, ending), media_type=json_type)
        case "lost":
            return streams.Cut(streams.half(raw), json_type)
    plainly = fault in ("plain", "not_json", "no_choices", "error_200", "packed")
    if body.get("stream") is True and not plainly:
        events = streams.events(whole, fault, rate, ending, mock.wrote)
        if fault == "stream_breaks":
            return streams.Cut(events, EVENTS)
        return StreamingResponse(events, media_type=EVENTS)
    if rate is not None:
        await asyncio.sleep(whole["usage"]["completion_tokens"] / rate)
    return Response(raw, media_type=json_type, headers=headers)
