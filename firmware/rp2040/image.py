"""Make what a Pico takes by USB: ``python image.py pons_mcu.bin pons_mcu.uf2``.

Puts the checksum behind boot2, without which the chip's ROM does not start flash, and cuts the
image into UF2's blocks of 256 bytes. Standard library alone: it runs where the compiler does.
"""

from __future__ import annotations

import struct
import sys
from pathlib import Path

FLASH = 0x1000_0000
BOOT2_BYTES, BLOCK_BYTES = 256, 256
FAMILY_RP2040 = 0xE48B_FF56
_START, _SECOND, _END = 0x0A32_4655, 0x9E5D_5157, 0x0AB1_6F30
_HAS_FAMILY = 0x2000


def crc32_mpeg2(data: bytes) -> int:
    """Return the CRC that the ROM holds against boot2: 04C11DB7, from ones, not reflected."""
    crc = 0xFFFF_FFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ 0x04C1_1DB7 if crc & 0x8000_0000 else crc << 1) & 0xFFFF_FFFF
    return crc


def with_checksum(image: bytes) -> bytes:
    """Return the image with boot2's checksum in the last four of its 256 bytes."""
    boot2 = image[: BOOT2_BYTES - 4]
    return boot2 + struct.pack("<I", crc32_mpeg2(boot2)) + image[BOOT2_BYTES:]


def uf2(image: bytes) -> bytes:
    """Return the image as UF2, to be written from the start of flash on."""
    image += bytes(-len(image) % BLOCK_BYTES)
    count = len(image) // BLOCK_BYTES
    blocks = []
    for number in range(count):
        at = number * BLOCK_BYTES
        head = struct.pack(
            "<8I", _START, _SECOND, _HAS_FAMILY, FLASH + at, BLOCK_BYTES, number, count,
            FAMILY_RP2040,
        )  # fmt: skip
        payload = image[at : at + BLOCK_BYTES].ljust(476, b"\0")
        blocks.append(head + payload + struct.pack("<I", _END))
    return b"".join(blocks)


def main(words: list[str]) -> int:
    """Read one file and write the other."""
    source, target = map(Path, words)
    target.write_bytes(uf2(with_checksum(source.read_bytes())))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
