"""Read sensor_msgs/CompressedImage as far as its envelope: format, packed bytes, stamp. Pure.

The bytes themselves are unpacked where pictures are shown (sensors/camera), never here. A message
of a stranger is bounded before it is copied.
"""

from __future__ import annotations

import binascii
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2.messages import stamp_of
from ros2.robot_words import Unreadable
from ros2.trouble import Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from ros2.operations import Message

COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
RAW_IMAGE = "sensor_msgs/msg/Image"
MOST_PACKED_BYTES = 8 << 20
"""Twice what the wire carries: pictures are packed anew for it."""
MOST_MESSAGE_BYTES = 2 * MOST_PACKED_BYTES
"""Of a whole message, as base64 in JSON too."""
_LONGEST_FORMAT = 80
DEPTH = "compresseddepth"
"""What compressed_depth_image_transport writes into ``format``: a head of its own, then a PNG."""


@dataclass(frozen=True, slots=True)
class CompressedPicture:
    """Hold one packed picture."""

    format: str
    """As image_transport says it, "rgb8; jpeg compressed bgr8", or a driver: "jpeg"."""
    data: bytes
    stamp_s: float | None
    """On the robot's ROS clock; None where the driver writes none."""


def read_compressed_image(message: Message, topic: str) -> CompressedPicture:
    """Read one message.

    Raises:
        TopicFailure: ``ros2_unreadable``, ``ros2_image_depth`` or ``ros2_message_too_large``.
    """
    kind = message.get("format")
    if not isinstance(kind, str):
        raise _unreadable(topic, f"format holds {repr(kind)[:40]}, expected words such as 'jpeg'")
    kind = kind[:_LONGEST_FORMAT]
    if DEPTH in kind.lower():
        found = f"{topic} holds depth: its format is {kind!r}"
        raise TopicFailure(Ros2Trouble("ros2_image_depth", found))
    data = _bytes_of(message.get("data"), topic)
    if not data:
        raise _unreadable(topic, "data is empty, expected a JPEG or PNG")
    try:
        stamp_s: float | None = stamp_of(message)
    except Unreadable:
        stamp_s = None
    return CompressedPicture(kind, data, stamp_s or None)


def _bytes_of(raw: object, topic: str) -> bytes:
    """Return a list of uint8: bytes by CDR; base64 by rosbridge, or numbers by other servers."""
    if not isinstance(raw, bytes | str | list):
        raise _unreadable(topic, f"data holds {repr(raw)[:40]}, expected bytes")
    length = len(raw) * 3 // 4 if isinstance(raw, str) else len(raw)
    if not length <= MOST_PACKED_BYTES:
        found = f"a picture on {topic} has {length} bytes, expected at most {MOST_PACKED_BYTES}"
        raise TopicFailure(Ros2Trouble("ros2_message_too_large", found))
    try:
        return binascii.a2b_base64(raw, strict_mode=True) if isinstance(raw, str) else bytes(raw)
    except (ValueError, TypeError) as error:
        raise _unreadable(topic, f"data is none: {str(error)[:80]}") from None


def _unreadable(topic: str, why: str) -> TopicFailure:
    return TopicFailure(Ros2Trouble("ros2_unreadable", f"{topic}: {why}"))
