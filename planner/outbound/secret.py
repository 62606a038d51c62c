"""Keep a key out of all that a server says. Knows texts; not HTTP."""

from __future__ import annotations

import re

_STRUCK = "***"
MIN_STRUCK = 6
"""Characters; a shorter key protects nothing, and striking it out would break every reply."""
_ESCAPED = re.compile(r"\\u00([2-7][0-9a-fA-F])")
_HALF_ESCAPED = re.compile(r"\\(?:u[0-9a-fA-F]{0,3})?$")


class Secret:
    """Strike a key, which may be empty, out of all that a server says.

    An echo of it must reach neither a log nor a goal.
    """

    def __init__(self, key: str) -> None:
        self._key = key if len(key) >= MIN_STRUCK else ""
        self.header = {"Authorization": f"Bearer {key}"} if key else {}

    def redact(self, text: str) -> str:
        """Return a text without the key."""
        return text.replace(self._key, _STRUCK) if self._key else text

    def redact_quoted(self, text: str) -> str:
        """Return a text without the key, which may stand in it as Python quotes bytes."""
        return self.redact(self.redact(text).replace("\\\\", "\\").replace("\\'", "'"))

    def struck_bytes(self, raw: bytes) -> bytes:
        """Return bytes without the key."""
        return raw.replace(self._key.encode("ascii"), _STRUCK.encode()) if self._key else raw

    def struck_growing(self, text: str) -> str:
        """Return a text that goes on, without the key, its beginning, its spelling in escapes."""
        if not self._key:
            return text
        whole = _ESCAPED.sub(lambda found: chr(int(found[1], 16)), _HALF_ESCAPED.sub("", text))
        plain = self.redact(whole)
        for size in range(min(len(self._key) - 1, len(plain)), 0, -1):
            if plain.endswith(self._key[:size]):
                return plain[:-size]
        return plain
