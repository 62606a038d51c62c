"""Make bytes for the wire of ROS pictures: packed ones as they came, raw ones row by row.

The head says what they are; they are unpacked where pictures are shown, never here.
"""

from __future__ import annotations

from typing import Any

from .readings import UnusableMessage, stamp_of

COMPRESSED, RAW = "sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image"
MOST_BYTES = 16 << 20
CHANNELS = {
    "rgb8": 3,
    "bgr8": 3,
    "rgba8": 4,
    "bgra8": 4,
    "mono8": 1,
    "16UC1": 2,
    "mono16": 2,
    "32FC1": 4,
}
"""Bytes a pixel, by sensor_msgs/Image.encoding."""
COLORS, DEPTHS = ("rgb8", "bgr8", "rgba8", "bgra8", "mono8"), ("16UC1", "mono16", "32FC1")
DEPTH_HEAD_BYTES = 12
"""What compressed_depth_image_transport puts before its PNG."""
Picture = tuple[dict[str, Any], bytes]
"""A head and the bytes that it is of."""


def read_picture(message: Any, *, depth: bool) -> Picture:
    """Read sensor_msgs/CompressedImage or Image.

    Raises:
        UnusableMessage: it is neither, of a kind that isn't heard here, or too large.
    """
    if len(message.data) > MOST_BYTES:
        raise UnusableMessage(
            f"a picture of {len(message.data)} bytes, expected at most {MOST_BYTES}"
        )
    if not len(message.data):
        raise UnusableMessage("data is empty, expected a picture")
    made = _read_packed(message, depth) if hasattr(message, "format") else _read_raw(message, depth)
    made[0]["stamp_s"] = stamp_of(message)
    return made


def _read_packed(message: Any, depth: bool) -> Picture:
    form = str(message.format)[:80]
    is_depth = "compresseddepth" in form.lower()
    if is_depth != depth:
        expected = "compressedDepth" if depth else "JPEG or PNG in colours"
        raise UnusableMessage(f"its format is {form!r}, expected {expected}")
    if is_depth and not form.lower().lstrip().startswith(("16uc1", "mono16")):
        raise UnusableMessage(f"depth of format {form!r}, expected 16UC1 (millimetres)")
    data = bytes(message.data)
    return {"kind": "packed", "format": form}, data[DEPTH_HEAD_BYTES:] if is_depth else data


def _read_raw(message: Any, depth: bool) -> Picture:
    encoding, wide, high = str(message.encoding), message.width, message.height
    known = DEPTHS if depth else COLORS
    if encoding not in known:
        raise UnusableMessage(f"its encoding is {encoding!r}, expected {', '.join(known)}")
    row, step = wide * CHANNELS[encoding], message.step
    if not (wide and high and step >= row and len(message.data) == step * high):
        raise UnusableMessage(
            f"{wide} x {high} in rows of {step} bytes, and data holds {len(message.data)}"
        )
    if message.is_bigendian and CHANNELS[encoding] in (2, 4) and depth:
        raise UnusableMessage("its bytes are big-endian, which no camera's are")
    data = bytes(message.data)
    if step > row:
        data = b"".join(data[at : at + row] for at in range(0, len(data), step))
    return {"kind": "raw", "format": encoding, "width": wide, "height": high}, data
