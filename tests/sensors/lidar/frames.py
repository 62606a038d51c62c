"""Make the bytes that lidars send, written a second time from their manuals, for tests."""

from __future__ import annotations

import struct
from math import atan, degrees

from sensors.lidar.ldrobot import crc8


def ld_frame(start_deg: float, step_deg: float, distances_m: list[float], time_ms: int) -> bytes:
    """Return a frame of 12 beams of an LD19 that turns at ten turns a second."""
    end_deg = (start_deg + 11 * step_deg) % 360.0
    body = struct.pack("<2sHH", b"\x54\x2c", 3600, round(start_deg * 100) % 36_000)
    for distance in distances_m:
        body += struct.pack("<HB", round(distance * 1000), 200)
    body += struct.pack("<HH", round(end_deg * 100) % 36_000, time_ms % 30_000)
    return body + bytes((crc8(body),))


RP_STANDARD_HEAD = bytes.fromhex("a55a0500004081")
RP_EXPRESS_HEAD = bytes.fromhex("a55a5400004082")
RP_DENSE_HEAD = bytes.fromhex("a55a5400004085")


def rp_beam(angle_deg: float, distance_m: float, *, first: bool = False) -> bytes:
    """Return one beam of the standard answer."""
    angle = round(angle_deg * 64) % (360 * 64)
    head = 47 << 2 | (0b01 if first else 0b10)
    return struct.pack("<BHH", head, angle << 1 | 1, round(distance_m * 4000))


def rp_frame(start_deg: float, body: bytes, *, anew: bool = False) -> bytes:
    """Return an express or dense frame around its cabins."""
    start = round(start_deg * 64) % (360 * 64) | (0x8000 if anew else 0)
    checked = struct.pack("<H", start) + body
    check = 0
    for byte in checked:
        check ^= byte
    return bytes((0xA0 | check & 0x0F, 0x50 | check >> 4)) + checked


def rp_cabins(distances_m: list[float], offsets_deg: list[float]) -> bytes:
    """Return 16 cabins of 32 beams."""
    body = b""
    for k in range(0, 32, 2):
        first, second = (round(offset * 8) for offset in offsets_deg[k : k + 2])
        near, far = (round(distance * 1000) << 2 for distance in distances_m[k : k + 2])
        fine = first & 0x0F | (second & 0x0F) << 4
        body += struct.pack("<HHB", near | first >> 4, far | second >> 4, fine)
    return body


def yd_packet(
    start_deg: float,
    step_deg: float,
    distances_m: list[float],
    *,
    begins: bool,
    sample_bytes: int = 2,
) -> bytes:
    """Return a packet of a YDLidar that triangulates; angles are those of its head."""
    first = round(start_deg * 64) % (360 * 64) << 1 | 1
    last = round((start_deg + (len(distances_m) - 1) * step_deg) * 64) % (360 * 64) << 1 | 1
    kind = int(begins) | len(distances_m) << 8
    words = [0x55AA, kind, first, last]
    samples = b""
    for distance in distances_m:
        raw = round(distance * 4000) & (0xFFFC if sample_bytes == 3 else 0xFFFF)
        if sample_bytes == 3:
            samples += b"\x2a"
            words.append(0x2A)
        samples += struct.pack("<H", raw)
        words.append(raw)
    check = 0
    for word in words:
        check ^= word
    return struct.pack("<HHHHH", 0x55AA, kind, first, last, check) + samples


def yd_shift_deg(distance_m: float) -> float:
    """Return by how much a triangulated beam looks elsewhere than its head stands."""
    if distance_m == 0.0:
        return 0.0
    mm = distance_m * 1000.0
    return degrees(atan(21.8 * (155.3 - mm) / (155.3 * mm)))
