"""Play the firmware of a base, and of its lidar, each at the far end of a serial line or socket.

The simulated robot is their body.
"""

from sim.twin.lidar import LidarTwin
from sim.twin.ros2 import Ros2Twin
from sim.twin.twin import FIRMWARES, DriveTwin

__all__ = ["FIRMWARES", "DriveTwin", "LidarTwin", "Ros2Twin"]
