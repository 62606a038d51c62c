"""Drive a ROS 2 base through its own process, over the keys that the simulator has (docs/ros2.md).

What happens between here and the wheels (a network, a server, a relay) is that process's affair;
the bridge believes the echo and the dead-man that come back, or stands.
"""

from __future__ import annotations

from bridge.drive.sim import SimDrive


class Ros2Drive(SimDrive):
    """Speak to the process that speaks to ROS 2. What it moves is metal."""

    kind = "ros2"
    virtual = False
