"""Frame what a host and a DYNAMIXEL device say to each other (protocol 2.0).

Little-endian. A frame is::

    FF FF FD 00 | id u8 | length u16 | instruction u8 | parameters | CRC-16

Length counts all behind itself. Where ``FF FF FD`` occurs behind the length, another FD follows it,
so that no frame seems to begin within another. CRC: polynomial 8005, beginning at 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import Final

HEAD: Final = b"\xff\xff\xfd\x00"
PING: Final = 0x01
READ: Final = 0x02
WRITE: Final = 0x03
STATUS: Final = 0x55

LONGEST: Final = 320
"""Bytes behind the length; a table of 182 bytes, stuffed, has fewer."""
_START: Final = Struct("<4sBH")
_CRC: Final = Struct("<H")
_MARK: Final = b"\xff\xff\xfd"
_STUFFED: Final = b"\xff\xff\xfd\xfd"
_LEAST: Final = 3
"""An instruction and the CRC."""


def _make_table() -> tuple[int, ...]:
    table = []
    for byte in range(256):
        crc = byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x8005 if crc & 0x8000 else crc << 1) & 0xFFFF
        table.append(crc)
    return tuple(table)


_TABLE: Final = _make_table()


@dataclass(frozen=True, slots=True)
class DynamixelFrame:
    """Hold one frame that checked."""

    id: int
    instruction: int
    parameters: bytes


def crc_of(data: bytes) -> int:
    """Return the check sum of all bytes of a frame before it."""
    crc = 0
    for byte in data:
        crc = (crc << 8 & 0xFFFF) ^ _TABLE[crc >> 8 ^ byte]
    return crc


def encode_frame(device: int, instruction: int, parameters: bytes = b"") -> bytes:
    """Return the bytes of a frame."""
    body = (bytes([instruction]) + parameters).replace(_MARK, _STUFFED)
    frame = _START.pack(HEAD, device, len(body) + _CRC.size) + body
    return frame + _CRC.pack(crc_of(frame))


class DynamixelReader:
    """Find the frames in a stream of bytes. Keeps at most one unfinished frame between calls."""

    def __init__(self) -> None:
        self._rest = b""
        self.spoilt_bytes = 0

    def reset(self) -> None:
        """Forget the unfinished frame: what comes next is of another time."""
        self._rest = b""

    def read(self, data: bytes) -> list[DynamixelFrame]:
        """Return the whole frames in what came before and now, oldest first."""
        data = self._rest + data
        found: list[DynamixelFrame] = []
        at = 0
        while True:
            head = data.find(HEAD, at)
            if head < 0:
                keep = _count_begun(data[at:])
                self.spoilt_bytes += len(data) - at - keep
                self._rest = data[len(data) - keep :]
                return found
            self.spoilt_bytes += head - at
            end = _end_of(data, head)
            if end is None:
                self._rest = data[head:]
                return found
            frame = _decode(data[head:end]) if end else None
            if frame is None:
                at = head + 1  # a true frame may begin within what only looked like one
                self.spoilt_bytes += 1
                continue
            found.append(frame)
            at = end


def _count_begun(tail: bytes) -> int:
    """Return how many of the last bytes may be the beginning of a head."""
    return next((n for n in (3, 2, 1) if tail.endswith(HEAD[:n])), 0)


def _end_of(data: bytes, head: int) -> int | None:
    """Return where the frame ends; 0 where none begins there, None where more must come."""
    if len(data) < head + _START.size:
        return None
    length = int(_START.unpack_from(data, head)[2])
    if not _LEAST <= length <= LONGEST:
        return 0
    end = head + _START.size + length
    return end if len(data) >= end else None


def _decode(frame: bytes) -> DynamixelFrame | None:
    (crc,) = _CRC.unpack_from(frame, len(frame) - _CRC.size)
    if crc != crc_of(frame[: -_CRC.size]):
        return None
    body = frame[_START.size : -_CRC.size].replace(_STUFFED, _MARK)
    return DynamixelFrame(frame[len(HEAD)], body[0], body[1:])
