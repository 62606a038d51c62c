"""Send and receive pictures over a zenoh session: bytes as they are, with their header attached."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import zenoh

from wire.codec import Image, encode, image

if TYPE_CHECKING:
    from wire.errors import DecodeFailure
    from wire.keys import Key
    from wire.sensors import ImageHeader


class ImagePublisher:
    """Send pictures: their bytes, with the header attached. Never blocks."""

    def __init__(self, session: zenoh.Session, key: Key[ImageHeader], robot_id: str) -> None:
        self._publisher = session.declare_publisher(
            key.expression(robot_id),
            congestion_control=zenoh.CongestionControl.DROP,
        )

    @property
    def has_listener(self) -> bool:
        """Return whether a subscriber matches."""
        status: Any = self._publisher.matching_status  # its stub says bool; it is a record
        return bool(status.matching)

    def put(self, header: ImageHeader, data: bytes) -> None:
        """Send and forget."""
        self._publisher.put(data, attachment=encode(header))


class ImageSubscriber:
    """Hold the newest picture of one key until it is taken."""

    def __init__(self, session: zenoh.Session, key: Key[ImageHeader], robot_id: str) -> None:
        self._key = key
        self._subscriber = session.declare_subscriber(
            key.expression(robot_id), zenoh.handlers.RingChannel(key.ring)
        )

    def newest(self) -> Image | DecodeFailure | None:
        """Return the newest picture or its refusal; None where none came."""
        try:
            sample = self._subscriber.try_recv()
        except zenoh.ZError:
            return None  # the session is closed
        if sample is None:
            return None
        attached = sample.attachment.to_bytes() if sample.attachment is not None else b""
        return image(self._key, attached, sample.payload.to_bytes())

    def close(self) -> None:
        """Undeclare the subscriber, so that the publisher stops sending."""
        self._subscriber.undeclare()  # type: ignore[no-untyped-call]  # its stub has no annotation
