"""Class what a server answers by its status: a reply, a body to be made simpler, or a failure.

Pure. Servers differ in the status with which they refuse a mode that they don't know, so its words
count as well.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import httpx

from planner.brain.endpoint.error_body import complaint_of, declined_by, generated_by
from planner.brain.endpoint.image_content import not_taken
from planner.brain.errors import BrainDown

BUSY = frozenset({408, 409, 425, 429})
PAUSE_S = 0.5
"""Before the second try, where the server names no time."""
_MODES = re.compile(
    r"response_format|json_schema|json_object|json schema|tool_choice|structured.?output|guided_"
    r"|grammar|\btools?\b.{0,40}support|support.{0,40}\btools?\b|requested parameters"
)
_NO_MODEL = re.compile(r"\bmodel\b.{0,60}\b(?:not exist|not found|does not exist|doesn't exist)")
"""What DeepSeek and others answer with 400: no simpler body would find the model."""


class BadRequest(Exception):
    """The server refused the body: perhaps a simpler one pleases it. Holds its words.

    ``generated``: the model did reply, and the server itself found that it does not fit (Groq).
    ``declined``: the server's own filter refused the order; no other body will please it.
    """

    def __init__(self, said: str, generated: str | None = None, declined: bool = False) -> None:
        super().__init__(said)
        self.generated = generated
        self.declined = declined


@dataclass(frozen=True, slots=True)
class Again:
    """Hold a failure that another try may mend, and when."""

    down: BrainDown
    after_s: float = 0.0
    lost: bool = False
    """The connection was lost; perhaps it had only idled too long."""


def judged(response: httpx.Response, content: object, said: str) -> Again:
    """Class an answer that is no 2xx; ``said`` are its words without the key.

    Raises:
        BadRequest: another body may do.
        BrainDown: everything else that no other try mends, with ``why``.
    """
    status = response.status_code
    if 300 <= status < 400:
        raise BrainDown(f"status {status}; redirects are not followed", why="redirect")
    if status in (401, 403):
        raise BrainDown(said, why="bad_key")
    if status in BUSY:
        return Again(BrainDown(said, why="rate_limited"), _wait_s(response))
    words = said.lower()
    modes = _MODES.search(words) is not None or not_taken(words)
    if status in (400, 422) and _NO_MODEL.search(words) and not modes:
        raise BrainDown(said, why="unknown_model")
    if status in (400, 422) or modes:
        raise BadRequest(said, generated_by(content), declined_by(content))
    if status in (404, 405, 410):
        raise BrainDown(said, why="unknown_model")
    if status >= 500:
        loads = status == 503 and "load" in said.lower()
        return Again(BrainDown(said, why="loading" if loads else "server_error"), _wait_s(response))
    raise BrainDown(said, why="bad_request")


def words_of(status: int, content: object) -> str:
    """Return an answer's words in one short line."""
    return f"status {status}: {complaint_of(content)}"


def _wait_s(response: httpx.Response) -> float:
    """Return the pause before the next try [s]; a time that is no number counts as for ever."""
    asked = response.headers.get("retry-after")
    if asked is None:
        return PAUSE_S
    try:
        seconds = float(asked)
    except ValueError:
        return float("inf")
    return seconds if seconds >= 0.0 else float("inf")
