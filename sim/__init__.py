"""Stand in for a robot and a home that are not there. Imports wire only."""

from sim.hardware import PERIODS, Hardware
from sim.mjcf import OBSTACLES
from sim.robot import Report, SimRobot

__all__ = ["OBSTACLES", "PERIODS", "Hardware", "Report", "SimRobot"]
