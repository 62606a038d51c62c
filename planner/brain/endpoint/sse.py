"""Cut a stream of bytes into server-sent events. Bytes in, JSON out; knows no plan and no model.

Of the format only what chat servers send: ``data:`` lines, comments that keep a connection awake,
and ``event: error``. Lines end by LF, CRLF or CR.
Source: html.spec.whatwg.org, "Server-sent events", parsing an event stream.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic_core import from_json

DONE = b"[DONE]"


class Events:
    """Take bytes as they come and give whole events."""

    def __init__(self) -> None:
        self._line = bytearray()
        self._data: list[bytes] = []
        self._after_cr = False
        self.done = False
        """The server said that it is through."""

    def feed(self, raw: bytes) -> Iterator[Any]:
        """Yield the JSON of each event that these bytes complete; None for one that is no JSON."""
        if self._after_cr and raw.startswith(b"\n"):
            raw = raw[1:]
        self._after_cr = raw.endswith(b"\r")
        *lines, rest = raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n").split(b"\n")
        for line in lines:
            self._line += line
            whole, self._line = bytes(self._line), bytearray()
            yield from self._take(whole)
        self._line += rest

    def end(self) -> Iterator[Any]:
        """Yield what the last bytes held: some servers end without an empty line."""
        whole, self._line = bytes(self._line), bytearray()
        yield from self._take(whole)
        yield from self._take(b"")

    def _take(self, line: bytes) -> Iterator[Any]:
        if line.startswith(b"data:"):
            self._data.append(line[5:].strip())
            if len(self._data) == 1:  # nearly always the whole event, whatever line follows
                yield from self._event(whole=False)
        elif not line and self._data:
            yield from self._event(whole=True)

    def _event(self, *, whole: bool) -> Iterator[Any]:
        """Yield what stands in the event's lines; one that goes on is no JSON yet."""
        data = b"\n".join(self._data)
        value = None if data == DONE else _json(data)
        if data == DONE:
            self.done = True
        elif value is not None or (whole and data):
            yield value
        elif not whole:
            return
        self._data = []


def _json(raw: bytes) -> Any:
    try:
        return from_json(raw, allow_inf_nan=False)
    except ValueError:
        return None
