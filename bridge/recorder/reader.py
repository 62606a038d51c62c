"""Read a recording, however its writer ended. Knows the format; runs nothing."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING

from pydantic import ValidationError

from bridge.recorder.format import FRAMES, Frame, Header
from bridge.recorder.upgrade import STATE, state_of_version_1
from bridge.recorder.writer import HEADER

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

_GZIP = 31
_CHUNK = 1 << 16
MAX_LINE_BYTES = 4 << 20
"""A state with everything in it is 40 kB; a line beyond this is no recording of ours."""


class BadRecording(Exception):
    """Say why a file is no recording that can be read, by stable code."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


def read_recording(path: Path) -> Iterator[Frame]:
    """Yield the frames in order. A file cut short ends with its last whole line.

    Raises:
        BadRecording: no such file, not gzip, not our frames, or another version of them.
    """
    header: Header | None = None
    for number, line in enumerate(_lines(path), start=1):
        frame = _frame(path, number, line, header)
        if isinstance(frame, Header):
            header = frame
        if number == 1 and not isinstance(frame, Header):
            raise BadRecording("recording_headless", f"{path} begins with {frame.kind}")
        yield frame


def read_segments(path: Path) -> Iterator[list[bytes]]:
    """Yield the lines of each segment, unparsed: a search over an hour parses what it finds only.

    Raises:
        BadRecording: no such file, or not gzip.
    """
    lines: list[bytes] = []
    for line in _lines(path):
        if line.startswith(HEADER) and lines:
            yield lines
            lines = []
        lines.append(line)
    if lines:
        yield lines


def parsed(path: Path, lines: Iterable[bytes]) -> Iterator[Frame]:
    """Yield the frames of lines that begin with a header.

    Raises:
        BadRecording: they are no frames of ours.
    """
    header: Header | None = None
    for number, line in enumerate(lines, start=1):
        frame = _frame(path, number, line, header)
        header = frame if isinstance(frame, Header) else header
        yield frame


def _frame(path: Path, number: int, line: bytes, header: Header | None) -> Frame:
    try:
        if header is not None and header.version == 1 and line.startswith(STATE):
            return state_of_version_1(line, header.robot)
        return FRAMES.validate_json(line)
    except ValidationError as error:
        item = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(map(str, item["loc"])) or "line"
        text = f"{path}, line {number}: {where}: {item['msg']}"
        raise BadRecording("recording_invalid", text) from None
    except (KeyError, TypeError, ValueError) as error:
        text = f"{path}, line {number}: no state of version 1: {error}"
        raise BadRecording("recording_invalid", text) from None


def _lines(path: Path) -> Iterator[bytes]:
    part = b""
    for data in _inflated(path):
        *lines, part = (part + data).split(b"\n")
        yield from lines
        if len(part) > MAX_LINE_BYTES:
            raise BadRecording(
                "recording_invalid", f"{path}: a line exceeds {MAX_LINE_BYTES} bytes"
            )


def _inflated(path: Path) -> Iterator[bytes]:
    """Yield what can be inflated; where the file simply ends, so does this."""
    inflate = zlib.decompressobj(_GZIP)
    try:
        with path.open("rb") as file:
            while data := file.read(_CHUNK):
                while data:
                    yield inflate.decompress(data, _CHUNK)
                    data = inflate.unconsumed_tail
    except OSError as error:
        raise BadRecording("recording_missing", f"{path}: {error.strerror}") from None
    except zlib.error as error:
        raise BadRecording("recording_not_gzip", f"{path}: {error}") from None
