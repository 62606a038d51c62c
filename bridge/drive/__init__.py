"""Turn wheel commands into motion and wheels into readings. One file per kind of drive."""

from bridge.drive.base import Braking, Drive, require_brakes
from bridge.drive.ros2 import Ros2Drive
from bridge.drive.serial_drive import SerialDrive, open_serial_drive
from bridge.drive.sim import SimDrive

__all__ = [
    "Braking",
    "Drive",
    "Ros2Drive",
    "SerialDrive",
    "SimDrive",
    "open_serial_drive",
    "require_brakes",
]
