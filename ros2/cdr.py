"""Write and read ROS messages as CDR (OMG DDS-XTypes 1.3, 7.4.3.5.3: plain CDR, version 1). Pure.

Four bytes of head, then each number at a multiple of its own size behind the head. Bytes of a
stranger: what is cut, too long or no text is refused, and nothing is reserved before it has come.
"""

from __future__ import annotations

import struct
import sys
from array import array
from typing import TYPE_CHECKING, Any

from ros2.layouts import LAYOUTS
from ros2.robot_words import Unreadable

if TYPE_CHECKING:
    from ros2.layouts import MessageField
    from ros2.operations import Message

HEAD = 4
_LITTLE, _BIG = b"\x00\x01", b"\x00\x00"
_CODES = {"int8": "b", "uint8": "B", "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}
_SIZES = {kind: struct.calcsize(code) for kind, code in _CODES.items()}
_TEXT = "string"


def decode(kind: str, payload: bytes) -> Message:
    """Return a message of a type of ``LAYOUTS``; lists of int8 are arrays, of uint8 bytes.

    Raises:
        Unreadable: the bytes are none.
    """
    head = payload[:2]
    if len(payload) < HEAD or head not in (_LITTLE, _BIG):
        raise Unreadable(f"begins with {payload[:HEAD].hex() or 'nothing'}, expected plain CDR")
    reader = _CdrReader(memoryview(payload)[HEAD:], "<" if head == _LITTLE else ">")
    try:
        return reader.message(kind)
    except struct.error:
        raise Unreadable(f"{len(payload)} bytes end within a {kind}") from None


def encode(kind: str, message: Message) -> bytes:
    """Return the bytes of a message; a field that it lacks is zero or empty.

    Raises:
        ValueError: a value does not fit its field.
    """
    writer = _CdrWriter()
    try:
        writer.message(kind, message)
    except (struct.error, TypeError, OverflowError, AttributeError) as error:
        raise ValueError(f"no {kind}: {error}") from None
    return _LITTLE + b"\x00\x00" + bytes(writer.payload)


class _CdrReader:
    """Walk through one message's bytes."""

    def __init__(self, payload: memoryview, order: str) -> None:
        self._payload, self._order = payload, order
        self._at = 0

    def message(self, kind: str) -> Message:
        return {field.name: self._field(field) for field in LAYOUTS[kind]}

    def _field(self, field: MessageField) -> Any:
        if field.count:
            return self._numbers(field.kind, field.count).tolist()
        if not field.is_list:
            return self._one(field.kind)
        (count,) = self._unpack("uint32", 1)
        left = len(self._payload) - self._at
        if not count <= left:  # each takes a byte at least
            raise Unreadable(f"{field.name} says {count} of it, where {left} bytes are left")
        if field.kind not in _CODES:
            return [self._one(field.kind) for _ in range(count)]
        if field.kind == "uint8":
            return bytes(self._take(count, 1))
        numbers = self._numbers(field.kind, count)
        return numbers if field.kind == "int8" else numbers.tolist()

    def _one(self, kind: str) -> Any:
        if kind == _TEXT:
            return self._text()
        return self._unpack(kind, 1)[0] if kind in _CODES else self.message(kind)

    def _text(self) -> str:
        (count,) = self._unpack("uint32", 1)
        raw = self._take(count, 1)
        return bytes(raw).rstrip(b"\x00").decode("utf-8", "replace")

    def _unpack(self, kind: str, count: int) -> tuple[Any, ...]:
        raw = self._take(count, _SIZES[kind])
        return struct.unpack(f"{self._order}{count}{_CODES[kind]}", raw)

    def _numbers(self, kind: str, count: int) -> array[Any]:
        numbers: array[Any] = array(_CODES[kind])
        numbers.frombytes(self._take(count, _SIZES[kind]))
        if (self._order == "<") != (sys.byteorder == "little"):
            numbers.byteswap()
        return numbers

    def _take(self, count: int, size: int) -> memoryview:
        """Return the bytes of so many values of one size, aligned."""
        begin = -(-self._at // size) * size if count else self._at
        end = begin + count * size
        if end > len(self._payload):
            raise struct.error
        self._at = end
        return self._payload[begin:end]


class _CdrWriter:
    """Write one message, little end first."""

    def __init__(self) -> None:
        self.payload = bytearray()

    def message(self, kind: str, message: Message) -> None:
        for field in LAYOUTS[kind]:
            self._field(field, message.get(field.name))

    def _field(self, field: MessageField, value: Any) -> None:
        if field.count:
            values = [0] * field.count if value is None else value
            if len(values) != field.count:
                raise TypeError(f"{field.name} has {len(values)} values, expected {field.count}")
            self._pack(field.kind, values)
        elif field.is_list:
            values = () if value is None else value
            self._pack("uint32", (len(values),))
            if field.kind in _CODES:
                self._pack(field.kind, values)
            else:
                for one in values:
                    self._one(field.kind, one)
        else:
            self._one(field.kind, value)

    def _one(self, kind: str, value: Any) -> None:
        if kind == _TEXT:
            raw = (value or "").encode() + b"\x00"
            self._pack("uint32", (len(raw),))
            self.payload += raw
        elif kind in _CODES:
            self._pack(kind, (0 if value is None else value,))
        else:
            self.message(kind, {} if value is None else value)

    def _pack(self, kind: str, values: Any) -> None:
        if isinstance(values, bytes) and kind == "uint8":
            self.payload += values
        elif values:
            self.payload += bytes(-len(self.payload) % _SIZES[kind])
            self.payload += struct.pack(f"<{len(values)}{_CODES[kind]}", *values)
