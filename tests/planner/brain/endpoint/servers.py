"""Stand where a model's server would: scripted answers over httpx's own transport, all kept."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

import httpx

from planner.brain import ThinkRequest, ThinkResult
from planner.brain.endpoint import EndpointBrain
from planner.plan import Vocabulary
from planner.settings import ModelSettings

KEY = "sk-test-5f3a9b7c"
URL = "http://127.0.0.1:9/v1"
GO = '{"kind":"plan","steps":[{"kind":"go_to","place":"kitchen"}]}'

Answer = httpx.Response | Exception | Callable[[], httpx.Response]


def raw(body: bytes, status: int = 200, headers: dict[str, str] | None = None) -> httpx.Response:
    """Return an answer that is still on the wire."""
    return httpx.Response(status, stream=httpx.ByteStream(body), headers=headers)


def answer(
    content: object, status: int = 200, headers: dict[str, str] | None = None
) -> httpx.Response:
    """Return an answer of JSON."""
    return raw(json.dumps(content).encode(), status, headers)


def wrote(text: str | None, **message: Any) -> httpx.Response:
    """Return a completion in which the model wrote a text."""
    return answer({"choices": [{"message": {"role": "assistant", "content": text, **message}}],
                   "usage": {"total_tokens": 11}})  # fmt: skip


class Endless(httpx.AsyncByteStream):
    """Send chunks for ever, and count them."""

    def __init__(self, chunk: bytes, pause_s: float = 0.0) -> None:
        self._chunk, self._pause_s = chunk, pause_s
        self.sent = 0

    async def __aiter__(self) -> AsyncIterator[bytes]:
        while True:
            self.sent += len(self._chunk)
            yield self._chunk
            await asyncio.sleep(self._pause_s)


class Server:
    """Answer from a script; the last line again and again."""

    def __init__(self, *answers: Answer) -> None:
        self._answers = answers
        self.requests: list[httpx.Request] = []

    async def __call__(self, request: httpx.Request) -> httpx.Response:
        self.requests.append(request)
        given = self._answers[min(len(self.requests), len(self._answers)) - 1]
        if isinstance(given, Exception):
            raise given
        if isinstance(given, httpx.Response):
            # A response is read once; the script's last line serves more often.
            stream = given.stream
            return httpx.Response(given.status_code, stream=stream, headers=given.headers)
        return given()

    @property
    def bodies(self) -> list[Any]:
        """Return what was asked, in order."""
        return [json.loads(request.content) for request in self.requests]


def settings(**more: Any) -> ModelSettings:
    """Return settings of a local model."""
    return ModelSettings.model_validate(
        {"url": URL, "name": "m", "key": KEY, "load_timeout_s": 0.0, **more}
    )


def brain(server: Server, home: Path, **more: Any) -> EndpointBrain:
    """Return a brain whose network is the script."""
    return EndpointBrain(settings(**more), home, transport=httpx.MockTransport(server))


def think(
    made: EndpointBrain, vocabulary: Vocabulary, text: str = "go to the kitchen"
) -> ThinkResult:
    """Think once, and close."""

    async def once() -> ThinkResult:
        try:
            return await made.think(ThinkRequest(text=text, vocabulary=vocabulary))
        finally:
            await made.close()

    return asyncio.run(once())
