"""Check that a PNG's chunks lie within its bytes. Unpacks nothing.

A chunk says its own length first, up to 2 GB, and decoders allot that much before they find that
the bytes never came: 102 bytes cost OpenCV 4 GB. Source: PNG specification, "Chunk layout".
"""

from __future__ import annotations

SIGNATURE = b"\x89PNG\r\n\x1a\n"
_END = b"IEND"
_LENGTH, _KIND, _CHECK = 4, 4, 4


def chunks_fit(data: bytes) -> bool:
    """Return whether every chunk to the last one, IEND, is as long as it says."""
    if not data.startswith(SIGNATURE):
        return False
    at = len(SIGNATURE)
    while at + _LENGTH + _KIND + _CHECK <= len(data):
        length = int.from_bytes(data[at : at + _LENGTH], "big")
        kind = data[at + _LENGTH : at + _LENGTH + _KIND]
        at += _LENGTH + _KIND + length + _CHECK
        if kind == _END:
            return at <= len(data)
    return False
