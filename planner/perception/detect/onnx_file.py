"""Look at the outermost fields of a model file before a library is let loose on it.

A field is a key (number and wire type) and a value that says its own length, so a file that was cut
off tells it by arithmetic. Sources: "Encoding" in the documentation of Protocol Buffers, and
ModelProto in onnx.proto. Knows no onnxruntime.
"""

from __future__ import annotations

import mmap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from planner.perception.failure import VisionFailure

VARINT, FIXED64, BYTES, FIXED32 = 0, 1, 2, 5
IR_VERSION, GRAPH, OPSET, METADATA = 1, 7, 8, 14
KNOWN = frozenset({1, 2, 3, 4, 5, 6, GRAPH, OPSET, METADATA, 20, 25, 26})
"""Fields of ModelProto."""
MAX_FILE_BYTES = 1_000_000_000
MAX_VARINT_BYTES = 10


@dataclass(frozen=True, slots=True)
class OnnxFile:
    """Hold the values of the outermost fields."""

    ir_version: int
    opset: int
    """Of the default operators."""


class _Cut(Exception):
    """The bytes end in the middle of a field."""


class _Foreign(Exception):
    """No ModelProto has such a field."""


def examine(path: Path) -> OnnxFile:
    """Return a model file's statements about itself.

    Raises:
        VisionFailure: ``model_missing``, ``model_unreadable``, ``model_not_onnx`` or
            ``model_truncated``.
    """
    try:
        if not path.exists():
            raise VisionFailure("model_missing", str(path))
        if not path.is_file():
            raise VisionFailure("model_unreadable", f"{path} is not a file")
        size = path.stat().st_size
        if size == 0:
            raise VisionFailure("model_truncated", f"{path} is empty")
        if size > MAX_FILE_BYTES:
            raise VisionFailure("model_unreadable", f"{path} has {size} bytes")
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            return _examine(data, path)
    except OSError as error:
        raise VisionFailure("model_unreadable", f"{path}: {error.strerror}") from None


def _examine(data: mmap.mmap, path: Path) -> OnnxFile:
    ir_version, opset, graph = 0, 0, False
    try:
        for number, value in _fields(data, 0, len(data)):
            if number == IR_VERSION and isinstance(value, int):
                ir_version = value
            elif number == GRAPH:
                graph = True
            elif number == OPSET and isinstance(value, tuple):
                opset = max(opset, _opset(data, *value))
    except _Foreign:
        raise VisionFailure("model_not_onnx", path.name) from None
    except _Cut:
        text = f"{path.name}: {len(data)} bytes, and its fields go on"
        raise VisionFailure("model_truncated" if ir_version else "model_not_onnx", text) from None
    if not ir_version:
        raise VisionFailure("model_not_onnx", path.name)
    if not (graph and opset):
        raise VisionFailure("model_truncated", f"{path.name}: its end is missing")
    return OnnxFile(ir_version, opset)


def _opset(data: mmap.mmap, start: int, end: int) -> int:
    """Return the version in an OperatorSetIdProto, 0 where it is of another domain."""
    version = 0
    for number, value in _fields(data, start, end):
        if number == 1 and isinstance(value, tuple) and value[1] > value[0]:
            named = data[value[0] : value[1]]
            if named != b"ai.onnx":
                return 0
        if number == 2 and isinstance(value, int):
            version = value
    return version


def _fields(
    data: mmap.mmap, start: int, end: int
) -> Iterator[tuple[int, int | tuple[int, int] | None]]:
    """Yield each field's number and its value: a number, or from where to where its bytes are."""
    at = start
    while at < end:
        key, at = _varint(data, at, end)
        number, kind = key >> 3, key & 7
        if number not in KNOWN:
            raise _Foreign
        if kind == VARINT:
            value, at = _varint(data, at, end)
            yield number, value
        elif kind == BYTES:
            length, at = _varint(data, at, end)
            if at + length > end:
                raise _Cut
            yield number, (at, at + length)
            at += length
        elif kind in (FIXED32, FIXED64):
            at += 4 if kind == FIXED32 else 8
            if at > end:
                raise _Cut
            yield number, None
        else:
            raise _Foreign


def _varint(data: mmap.mmap, at: int, end: int) -> tuple[int, int]:
    """Return a number of seven bits a byte, lowest first, and where it ends."""
    value = 0
    for place in range(MAX_VARINT_BYTES):
        if at + place >= end:
            raise _Cut
        byte = data[at + place]
        value |= (byte & 0x7F) << (7 * place)
        if byte < 0x80:
            return value, at + place + 1
    raise _Foreign
