"""Simulate a robot in a home. Imports wire only."""

from sim.domain import Domain, draw_domain, load_domain
from sim.faults import Faults
from sim.hardware import PERIODS, Hardware
from sim.messages import Report
from sim.mjcf import OBSTACLES
from sim.robot import SimRobot

__all__ = [
    "OBSTACLES",
    "PERIODS",
    "Domain",
    "Faults",
    "Hardware",
    "Report",
    "SimRobot",
    "draw_domain",
    "load_domain",
]
