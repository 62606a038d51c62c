"""Open the transport that robot.toml names; each brings its own library, loaded only then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2.transport import MOST_BYTES

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.transport import GraphListener, LinkMessages, Transport
    from wire.ros2_config import Ros2Config


def open_transport(
    ros2: Ros2Config,
    listener: GraphListener,
    publish: Callable[[LinkMessages], None],
    most_bytes: int = MOST_BYTES,
) -> Transport:
    """Return the transport that ``ros2.transport`` names; it dials when it is served."""
    if ros2.transport == "dds":
        from ros2.dds import DdsTransport

        return DdsTransport(ros2, listener, publish)
    if ros2.transport == "zenoh":
        from ros2.rmw_zenoh import ZenohTransport

        return ZenohTransport(ros2, listener, publish)
    from ros2.connection import RosbridgeConnection

    return RosbridgeConnection(ros2.peer, listener, publish, most_bytes)
