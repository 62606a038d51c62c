"""Write foxglove.LaserScan in protobuf, with the descriptor set that a reader needs.

JSON knows no infinity, which stands for a beam without return (REP-117), so this one topic is not
JSON. By hand, because Google's library takes 30 MB and this whole process 18 (ADR 0032). Wire
format: https://protobuf.dev/programming-guides/encoding; fields: foxglove.LaserScan of
https://github.com/foxglove/foxglove-sdk/tree/main/schemas/proto/foxglove, their numbers too.
"""

from __future__ import annotations

import struct

_VARINT, _FIXED64, _BYTES = 0, 1, 2
_DOUBLE, _INT64, _INT32, _MESSAGE, _STRING = 1, 3, 5, 11, 9
_OPTIONAL, _REPEATED = 1, 3


def _number(value: int) -> bytes:
    """Return a varint."""
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def _int(field: int, value: int) -> bytes:
    return _number(field << 3 | _VARINT) + _number(value)


def _double(field: int, value: float) -> bytes:
    return _number(field << 3 | _FIXED64) + struct.pack("<d", value)


def _length_delimited(field: int, value: bytes | str) -> bytes:
    data = value.encode() if isinstance(value, str) else value
    return _number(field << 3 | _BYTES) + _number(len(data)) + data


def laser_scan(
    at_ns: int,
    frame_id: str,
    placed: tuple[float, float, tuple[float, float]],
    angles_rad: tuple[float, float],
    ranges: bytes,
) -> bytes:
    """Return one scan.

    Args:
        at_ns: when it was taken, UNIX time.
        frame_id: the frame that ``placed`` is given in.
        placed: x, y of the lidar [m], and z, w of its quaternion.
        angles_rad: of the first and the last beam, in the lidar's frame.
        ranges: one little-endian double a beam [m].
    """
    x_m, y_m, (z, w) = placed
    seconds, nanos = divmod(at_ns, 1_000_000_000)
    position = _double(1, x_m) + _double(2, y_m)
    orientation = _double(3, z) + _double(4, w)
    return b"".join(
        (
            _length_delimited(1, _int(1, seconds) + _int(2, nanos)),
            _length_delimited(2, frame_id),
            _length_delimited(
                3, _length_delimited(1, position) + _length_delimited(2, orientation)
            ),
            _double(4, angles_rad[0]),
            _double(5, angles_rad[1]),
            _length_delimited(6, ranges),
        )
    )


def ranges_of(message: bytes) -> bytes:
    """Return the ranges of one scan that ``laser_scan`` wrote.

    Raises:
        ValueError: it is none.
    """
    at = 0
    while at < len(message):
        key, at = _read(message, at)
        if key & 7 == _FIXED64:
            at += 8
            continue
        if key & 7 != _BYTES:
            break
        length, at = _read(message, at)
        if key >> 3 == 6:
            if at + length > len(message) or length % 8:
                break
            return message[at : at + length]
        at += length
    raise ValueError("no scan with ranges")


def _read(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while at < len(data):
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, at
        shift += 7
    raise ValueError("a number without an end")


def _field(name: str, number: int, kind: int, of: str = "", label: int = _OPTIONAL) -> bytes:
    """Return a FieldDescriptorProto."""
    made = _length_delimited(1, name) + _int(3, number) + _int(4, label) + _int(5, kind)
    return _length_delimited(2, made + (_length_delimited(6, of) if of else b""))


def _message(name: str, *fields: bytes) -> bytes:
    return _length_delimited(4, _length_delimited(1, name) + b"".join(fields))


def _file(name: str, package: str, needs: tuple[str, ...], *messages: bytes) -> bytes:
    """Return a FileDescriptorProto as an item of a FileDescriptorSet."""
    imports = b"".join(_length_delimited(3, need) for need in needs)
    head = _length_delimited(1, name) + _length_delimited(2, package) + imports
    return _length_delimited(1, head + b"".join(messages) + _length_delimited(12, "proto3"))


def _doubles(names: str) -> tuple[bytes, ...]:
    return tuple(_field(name, at, _DOUBLE) for at, name in enumerate(names, start=1))


_TIME_FILE = "google/protobuf/timestamp.proto"
_FOLDER = "foxglove/"
SCAN_SCHEMA = b"".join(
    (
        _file(_TIME_FILE, "google.protobuf", (), _message(
            "Timestamp", _field("seconds", 1, _INT64), _field("nanos", 2, _INT32))),
        _file(_FOLDER + "Vector3.proto", "foxglove", (), _message("Vector3", *_doubles("xyz"))),
        _file(_FOLDER + "Quaternion.proto", "foxglove", (),
              _message("Quaternion", *_doubles("xyzw"))),
        _file(_FOLDER + "Pose.proto", "foxglove",
              (_FOLDER + "Quaternion.proto", _FOLDER + "Vector3.proto"), _message(
            "Pose", _field("position", 1, _MESSAGE, ".foxglove.Vector3"),
            _field("orientation", 2, _MESSAGE, ".foxglove.Quaternion"))),
        _file(_FOLDER + "LaserScan.proto", "foxglove", (_FOLDER + "Pose.proto", _TIME_FILE),
              _message(
            "LaserScan",
            _field("timestamp", 1, _MESSAGE, ".google.protobuf.Timestamp"),
            _field("frame_id", 2, _STRING),
            _field("pose", 3, _MESSAGE, ".foxglove.Pose"),
            _field("start_angle", 4, _DOUBLE),
            _field("end_angle", 5, _DOUBLE),
            _field("ranges", 6, _DOUBLE, label=_REPEATED),
            _field("intensities", 7, _DOUBLE, label=_REPEATED))),
    )
)  # fmt: skip
"""A FileDescriptorSet: what MCAP asks for beside messages in protobuf."""
