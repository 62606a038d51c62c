"""Serve a model of a test's own over HTTP: an OpenAI-compatible endpoint, filled by a function."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

Body = dict[str, Any]
Reply = Callable[[Body], str]


class Refused(Exception):
    """The server answers with 400 and these words."""


@dataclass
class ModelServer:
    """Hold where a model listens and what it was asked."""

    url: str = ""
    bodies: list[Body] = field(default_factory=list)


def told_data(body: Body) -> dict[str, Any]:
    """Return what a request's first message of the person tells, as data."""
    content = next(m["content"] for m in body["messages"] if m["role"] == "user")
    parts = [{"text": content}] if isinstance(content, str) else content
    text = next(part["text"] for part in parts if "text" in part)
    found: dict[str, Any] = json.loads(text[max(0, text.rfind('\n{"')) :])
    return found


def picture_url(body: Body) -> str:
    """Return the picture of a request; empty where there is none."""
    for sent in body["messages"]:
        for part in sent["content"] if isinstance(sent["content"], list) else ():
            if "image_url" in part:
                return str(part["image_url"]["url"])
    return ""


@contextmanager
def served_model(reply: Reply) -> Iterator[ModelServer]:
    """Serve on a free port of the loopback until the block ends."""
    served = ModelServer()

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            served.bodies.append(body)
            try:
                self._say(200, _completion(reply(body)))
            except Refused as no:
                self._say(400, {"error": {"message": str(no)}})

        def _say(self, status: int, answer: Body) -> None:
            raw = json.dumps(answer).encode()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(raw)))
            self.end_headers()
            self.wfile.write(raw)

        def log_message(self, format: str, *args: object) -> None:  # noqa: A002  # the base names it
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    served.url = f"http://127.0.0.1:{server.server_address[1]}/v1"
    try:
        yield served
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def _completion(text: str) -> Body:
    said = {"role": "assistant", "content": text}
    return {
        "id": "1",
        "object": "chat.completion",
        "model": "m",
        "choices": [{"index": 0, "message": said, "finish_reason": "stop"}],
        "usage": {"prompt_tokens": 10, "completion_tokens": 10, "total_tokens": 20},
    }
