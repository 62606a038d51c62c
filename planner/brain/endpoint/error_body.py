"""Read what a server says about an error: its words, and whether the model itself had answered."""

from __future__ import annotations

from typing import Any

_FILTERED = frozenset({"content_filter", "data_inspection_failed"})
"""What Azure and DashScope answer with 400 where a filter of theirs refuses an order."""


def complaint_of(content: object) -> str:
    """Return a server's words about an error, in one short line."""
    words = content
    for _ in range(3):
        if not isinstance(words, dict):
            break
        words = words.get("error") or words.get("message") or words.get("detail") or ""
    return " ".join(str(words)[:400].split())


def generated_by(content: object) -> str | None:
    """Return what the model wrote where a server refuses it as an error of its own, or None."""
    written = _error(content).get("failed_generation")
    return written if isinstance(written, str) else None


def declined_by(content: object) -> bool:
    """Tell whether a filter of the server's refused the order itself."""
    code = _error(content).get("code")
    return isinstance(code, str) and code in _FILTERED


def _error(content: object) -> dict[str, Any]:
    error = content.get("error") if isinstance(content, dict) else None
    return error if isinstance(error, dict) else {}
