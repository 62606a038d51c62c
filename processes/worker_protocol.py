"""Frames between a process and its worker (two lengths, JSON, bytes), and a worker's failures.

JSON and not pickle: what is read here is checked for shape, and nothing that arrives can run. Pure.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from struct import Struct
from typing import Any, ClassVar

HEADER = Struct(">II")
MAX_HEAD_BYTES = 8_000_000
"""Twice a route of 100 km at 0.1 m."""
MAX_BODY_BYTES = 100_000_000
"""Ten times the largest colour and depth pictures that the wire lets through."""

Frame = tuple[dict[str, Any], bytes]


def pack(head: dict[str, Any], *bodies: bytes) -> bytes:
    """Return one frame. Raises ValueError for a number that is not finite."""
    text = json.dumps(head, separators=(",", ":"), allow_nan=False).encode()
    return b"".join((HEADER.pack(len(text), sum(map(len, bodies))), text, *bodies))


def read_lengths(header: bytes) -> tuple[int, int]:
    """Return the lengths of JSON and bytes.

    Raises:
        ValueError: longer than any frame of ours; the stream is another's or out of step.
    """
    head, body = HEADER.unpack(header)
    if head <= MAX_HEAD_BYTES and body <= MAX_BODY_BYTES:
        return head, body
    raise ValueError(
        f"a frame of {head} + {body} bytes; at most {MAX_HEAD_BYTES} + {MAX_BODY_BYTES}"
    )


def unpack(text: bytes) -> dict[str, Any]:
    """Return a frame's JSON. Raises ValueError where it is not an object."""
    content = json.loads(text)
    if isinstance(content, dict):
        return content
    raise ValueError(f"expected a JSON object, got {type(content).__name__}")


class WorkerFailure(Exception):
    """Why a worker gave no answer. Each worker derives its own, with its table of codes."""

    reasons: ClassVar[Mapping[str, tuple[str, str]]]
    """Every code with its sentence in English and Chinese."""

    def __init__(self, code: str, detail: str = "") -> None:
        """Keep the code, and a sentence in both languages with the particulars."""
        en, zh = self.reasons[code]
        super().__init__(f"{code}: {en}" + (f" ({detail})" if detail else ""))
        self.code = code
        self.detail = detail
        self.message = {
            "en": f"{en} ({detail})" if detail else en,
            "zh": f"{zh}（{detail}）" if detail else zh,
        }


@dataclass(frozen=True, slots=True)
class FailureCodes:
    """Name one worker's codes for the ways in which its process can end."""

    failure: type[WorkerFailure]
    down: str
    """The process is not started, busy, or being started again."""
    died: str
    """The process ended, or sent what is not an answer, during a request."""
    timed_out: str

    def to_failure(self, code: object, detail: object = "") -> WorkerFailure:
        """Return the failure of a code that came; ``down`` where the table does not have it."""
        is_known = isinstance(code, str) and code in self.failure.reasons
        return self.failure(str(code) if is_known else self.down, str(detail))
