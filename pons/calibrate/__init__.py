"""Measure the robot and write robot.toml: ``pons calibrate``."""

from pons.calibrate.command import run

__all__ = ["run"]
