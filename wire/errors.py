"""Define the errors of a set-up and of a message, by stable code."""

from __future__ import annotations

from dataclasses import dataclass


class Misconfigured(Exception):
    """Refuse to start: ours or the owner's fault, never a silent default."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


@dataclass(frozen=True, slots=True)
class Rejected:
    """Hold why bytes did not become a message. A value, so that no traceback outlives a tick."""

    code: str
    detail: str
