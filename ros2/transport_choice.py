"""Open the transport that robot.toml names; each brings its own library, loaded only then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2.transport import MOST_BYTES, PERIOD_S

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.transport import GraphListener, LinkMessages, Transport
    from wire.ros2_config import Ros2Config


def open_transport(
    ros2: Ros2Config,
    listener: GraphListener,
    publish: Callable[[LinkMessages], None],
    most_bytes: int = MOST_BYTES,
    period_s: float = PERIOD_S,
) -> Transport:
    """Return the transport that ``ros2.transport`` names; it dials when it is served.

    Args:
        ros2: the part of robot.toml.
        listener: hears what the graph says.
        publish: takes what the listener makes of each answer.
        most_bytes: of one message; longer ones are refused.
        period_s: so often are readers asked, where a transport asks them.
    """
    if ros2.transport == "dds":
        from ros2.dds import DdsTransport

        return DdsTransport(ros2, listener, publish, most_bytes, period_s)
    if ros2.transport == "zenoh":
        from ros2.rmw_zenoh import ZenohTransport

        return ZenohTransport(ros2, listener, publish, most_bytes, period_s)
    from ros2.connection import RosbridgeConnection

    return RosbridgeConnection(ros2.peer, listener, publish, most_bytes)
