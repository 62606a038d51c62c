"""Localize the robot. For now a STAND-IN fed by the simulator's truth. Imports wire only."""

from localization.noise import NoiseParams, PoseNoise
from localization.standin import StandIn

__all__ = ["NoiseParams", "PoseNoise", "StandIn"]
