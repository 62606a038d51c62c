"""Choose a preset, find out what a robot is made of, try it: ``pons robot``."""

from pons.robot.command import parser, run

__all__ = ["parser", "run"]
