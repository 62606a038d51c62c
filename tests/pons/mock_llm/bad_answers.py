"""Answer as a server does that gives no completion at all: a status, a refusal, silence."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from starlette.responses import Response

from pons.mock_llm.server import error
from tests.pons.mock_llm.bad_pictures import holds_picture

METADATA = "http://169.254.169.254/latest/meta-data/"
_OURS = frozenset(
    {
        *("model", "messages", "stream", "stream_options", "response_format", "tools"),
        *("tool_choice", "temperature", "max_tokens", "max_completion_tokens"),
    }
)

Body = dict[str, Any]


def _format(body: Body) -> str:
    wanted = body.get("response_format")
    return str(wanted.get("type", "")) if isinstance(wanted, dict) else ""


def _system(body: Body) -> bool:
    messages = body.get("messages")
    listed = messages if isinstance(messages, list) else []
    return any(isinstance(each, dict) and each.get("role") == "system" for each in listed)


_REFUSED: dict[str, tuple[Callable[[Body], bool], str]] = {
    "no_json_schema": (
        lambda body: _format(body) == "json_schema",
        "This response_format type is unavailable now",
    ),
    "only_tool": (lambda body: bool(_format(body)), "response_format is not supported"),
    "only_json_object": (
        lambda body: _format(body) == "json_schema" or "tools" in body,
        "'response_format.type' must be 'json_object'; tools are not supported",
    ),
    "no_schema": (
        lambda body: bool(_format(body)) or "tools" in body,
        "response_format and tools are not supported by this model",
    ),
    "no_system": (
        _system,
        "Unsupported value: 'messages[0].role' does not support 'system' with this model.",
    ),
    "no_temperature": (
        lambda body: "temperature" in body,
        "Unsupported parameter: 'temperature' is not supported with this model.",
    ),
    "new_tokens": (
        lambda body: "max_tokens" in body,
        "Unsupported parameter: 'max_tokens'. Use 'max_completion_tokens' instead.",
    ),
    "no_stream": (lambda body: body.get("stream") is True, "stream is not supported"),
    "tool_never": (lambda body: bool(_format(body)), "response_format is not supported"),
    "refuses_pictures": (
        holds_picture,
        "Invalid content type. image_url is only supported by certain models.",
    ),
}


BARREN: dict[str | None, Callable[[Body], bool]] = {
    "schema_barren": lambda body: _format(body) == "json_schema",
    "strict_barren": lambda body: bool(_format(body)) or "tools" in body,
    "tool_never": lambda body: "tools" in body,
}
"""Ways of asking that are taken and bring nothing."""


def refusal_of(fault: str | None, body: Body, retry_after: str | None) -> Response | None:
    """Return an answer that is no completion, or None where one is due."""
    if fault in _REFUSED:
        refuses, words = _REFUSED[fault]
        return error(400, words) if refuses(body) else None
    later = {"Retry-After": retry_after} if retry_after is not None else {}
    match fault:
        case "loading":
            return error(503, "Loading model", later)
        case "small_context":
            words = "the request exceeds the available context size (n_ctx 1024), try increasing it"
            return error(400, words)
        case "rate_limited":
            return error(429, "too many requests", later)
        case "not_found":
            return error(404, "The model does not exist or you do not have access to it.")
        case "filtered":
            return error(400, "the order was filtered", code="content_filter")
        case "no_extras":
            strange = sorted(body.keys() - _OURS)
            return error(400, f"Unrecognized argument: {strange[0]}") if strange else None
        case "redirect":
            return Response(status_code=307, headers={"Location": METADATA})
    return None
