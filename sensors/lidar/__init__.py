"""Read planar lidars: bytes to beams (one file a family), beams to turns, turns to scans."""

from sensors.lidar.ldrobot import LdRobotDecoder
from sensors.lidar.rplidar import RplidarDecoder
from sensors.lidar.turn import Beams, LidarTurn, ScanShape, TurnCollector
from sensors.lidar.ydlidar import YdlidarDecoder

__all__ = [
    "Beams",
    "LdRobotDecoder",
    "LidarTurn",
    "RplidarDecoder",
    "ScanShape",
    "TurnCollector",
    "YdlidarDecoder",
]
