"""Speak to a ROS 2 base and its sensors by rosbridge, DDS or zenoh, and to Pons over the wire.

A process of its own (``python -m ros2``), so that neither a slow network nor a broken message costs
the bridge a tick. No ROS is needed on this side (docs/ros2.md).
"""

from ros2.base_link import BaseLink
from ros2.transport import LinkMessages

__all__ = ["BaseLink", "LinkMessages"]
