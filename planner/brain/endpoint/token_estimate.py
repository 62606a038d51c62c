"""Weigh a stream that does not say what it cost: how much of it is the model's own. Bytes alone.

Servers wrap each token in some 300 bytes, so a stream's size tells little. Of each event the size
of the least one is taken off, which holds next to nothing but the wrapping; an event counts as one
token at least.
"""

from __future__ import annotations

MAX_WRAPPING = 400
"""Bytes of an event that are not the model's, at most."""
_KEPT = 16
"""Of a line's beginning: it tells an event from a comment and from the stream's end."""


class Weight:
    """Take a stream's bytes as they come, and keep none of them."""

    def __init__(self) -> None:
        self._head, self._length = b"", 0
        self._events, self._size, self._least = 0, 0, MAX_WRAPPING

    def add(self, chunk: bytes) -> None:
        """Take the next bytes, cut wherever they are."""
        *whole, rest = chunk.replace(b"\r", b"\n").split(b"\n")
        for piece in whole:
            self._grow(piece)
            self._end()
        self._grow(rest)

    def tokens(self, per_token: int) -> int:
        """Return the tokens of what came, of so many bytes each."""
        self._end()
        own = self._size - self._events * self._least
        return max(self._events, own // per_token)

    def _grow(self, piece: bytes) -> None:
        self._head = (self._head + piece[:_KEPT])[:_KEPT]
        self._length += len(piece)

    def _end(self) -> None:
        if self._head.startswith(b"data:") and not self._head[5:].lstrip().startswith(b"[DONE]"):
            self._events += 1
            self._size += self._length
            self._least = min(self._least, self._length)
        self._head, self._length = b"", 0
