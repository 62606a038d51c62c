"""Localize the robot. For now a STAND-IN fed by the simulator's truth. Imports wire only."""

from localization.noise import NoiseParams, PoseNoise
from localization.site_map import read_map_id
from localization.standin import StandIn

__all__ = ["NoiseParams", "PoseNoise", "StandIn", "read_map_id"]
