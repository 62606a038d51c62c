"""Define the errors of a set-up and of a message, by stable code."""

from __future__ import annotations

from dataclasses import dataclass


class ConfigError(Exception):
    """Refuse to start: ours or the owner's fault, never a silent default."""

    exit_status = 2
    """A process ends with it, and no service starts it again: that would meet the same setting."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


class Unwritable(ConfigError):
    """Refuse to start on a disk that is full, locked or read-only: it may be mended by itself."""

    exit_status = 1
    """A process that ends with it is started again, by ``pons up`` and by systemd."""


@dataclass(frozen=True, slots=True)
class DecodeFailure:
    """Hold why bytes did not become a message. A value, so that no traceback outlives a tick."""

    code: str
    detail: str
