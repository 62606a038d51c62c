"""Attach a picture to a question as OpenAI's protocol has it, and read why a server takes none.

Pure. Sources of the words, read in November 2026: llama.cpp answers 500 "image input is not
supported", vLLM 500 or 400, Ollama 400 "this model does not support image input", OpenAI 400
"image_url is only supported by certain models", DeepSeek 400 or 422 "unknown variant `image_url`,
expected `text`", routers 404 "no endpoints found that support image input".
"""

from __future__ import annotations

import base64
import re
from typing import Any

from planner.brain.schema import Message

MAX_JPEG_BYTES = 500_000
"""Twice what 1024 pixels take; to pack more would hold the event loop for over 10 ms."""
TOKENS = 1500
"""Counted for a picture before the server says what it billed, rather too many: with a long side of
1024 tiles of 512 px cost 765, patches of 28 or 32 px 1 369 or 1 024, an area by 750 1 398."""
_NOT_TAKEN = re.compile(
    r"image[ _]?(?:input|url|content)s?\b.{0,60}(?:not supported|unsupported|only supported)"
    r"|(?:not|n't|found that) support.{0,30}\b(?:images?|vision|multi-?modal)"
    r"|unsupported content part|unknown variant.{0,4}image_url|not a multi-?modal model|mmproj"
    r"|missing data required for image|at most 0 image"
)
_THIS_ONE = re.compile(
    r"(?:invalid|corrupt|malformed|decode|process|load).{0,30}\bimage|base64"
    r"|\bimage\b.{0,40}(?:invalid|corrupt|too large|too small|exceed|decoded?)"
)
_AT_ALL = re.compile(
    r"\bimages?\b|image_url|vision|multi-?modal"
    r"|content.{0,60}\b(?:string|text)\b|\b(?:string|text)\b.{0,60}content"
)
_THE_WAY = re.compile(
    r"response_format|json_|tool_choice|\btools?\b|temperature|max_\w*tokens|too long|context"
)
_DATA_URL = re.compile(rb'"data:image/jpeg;base64,[A-Za-z0-9+/=]*"')


def data_url(jpeg: bytes) -> str:
    """Return a picture as a URL that holds it."""
    return f"data:image/jpeg;base64,{base64.b64encode(jpeg).decode('ascii')}"


def attached(messages: list[Message], url: str) -> list[dict[str, Any]]:
    """Return the messages with the picture in the person's first one, behind its words."""
    sent: list[dict[str, Any]] = [{str(k): v for k, v in each.items()} for each in messages]
    first = next(message for message in sent if message["role"] == "user")
    words = {"type": "text", "text": first["content"]}
    first["content"] = [words, {"type": "image_url", "image_url": {"url": url}}]
    return sent


def weighed(body: bytes) -> tuple[bytes, int]:
    """Return a body without its pictures, and the tokens that they may cost."""
    plain, count = _DATA_URL.subn(b"", body)
    return plain, count * TOKENS


def not_taken(said: str) -> bool:
    """Tell whether a server's words, in small letters, are plainly that it takes no pictures."""
    return _NOT_TAKEN.search(said) is not None


def why_refused(said: str) -> str | None:
    """Return why a body with a picture was refused, or None where another way of asking may do.

    Args:
        said: the server's words, in small letters.
    """
    if not_taken(said):
        return "no_pictures"
    if _THIS_ONE.search(said):
        return "bad_picture"
    return "no_pictures" if _AT_ALL.search(said) and not _THE_WAY.search(said) else None
