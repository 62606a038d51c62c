"""Find out what a robot is made of: ``pons robot find``."""

from pons.robot.command import run

__all__ = ["run"]
