"""Answer chat completions as a mock's switches say."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from fastapi import FastAPI, Request
from pydantic import ValidationError
from starlette.responses import JSONResponse, Response

from pons.mock_llm.request_parser import request_of
from pons.mock_llm.server import MockServer, error

MAX_BODY = 4_000_000


def build(mock: MockServer) -> FastAPI:
    """Return the application of one mock."""
    app = FastAPI(title="pons mock-llm", docs_url=None, redoc_url=None, openapi_url=None)
    app.state.mock = mock

    @app.get("/mock")
    async def look() -> dict[str, Any]:
        return mock.report()

    @app.post("/mock")
    async def switch(request: Request) -> Response:
        try:
            mock.set(type(mock.switches).model_validate_json(await raw_of(request) or b""))
        except ValidationError as wrong:
            return JSONResponse({"detail": str(wrong)}, status_code=422)
        return JSONResponse(mock.report())

    @app.get("/v1/models")
    async def models() -> dict[str, Any]:
        return {"object": "list", "data": [{"id": "pons-mock", "object": "model"}]}

    @app.post("/v1/chat/completions")
    async def complete(request: Request) -> Response:
        fault, body = mock.next_fault(), object_of(await raw_of(request))
        if body is None:
            return error(400, "the body is no JSON object of a chat request")
        await asyncio.sleep(mock.switches.delay_s)
        early = await mock.instead(fault, body, request)
        if early is not None:
            return early
        asked = request_of(body)
        place = next(iter(asked.vocabulary.by_id), "kitchen")
        told = mock.tell_picture(fault, body, place)
        if told is not None:
            return await mock.send(fault, told, body)
        good = json.dumps(await mock.plan(fault, asked, body), ensure_ascii=False)
        text, body = mock.write(fault, good, place, body, request)
        return await mock.send(fault, text, body)

    return app


async def raw_of(request: Request) -> bytes | None:
    """Return a request's body; None where it is too long."""
    raw = bytearray()
    async for chunk in request.stream():
        raw += chunk
        if len(raw) > MAX_BODY:
            return None
    return bytes(raw)


def object_of(raw: bytes | None) -> dict[str, Any] | None:
    """Return the JSON object that a body is; None where it is none."""
    try:
        body = json.loads(raw or b"")
    except (ValueError, RecursionError):
        return None
    return body if isinstance(body, dict) else None
