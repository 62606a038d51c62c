"""Offer the command line: up, say, stop, status and the rest. ``from pons import Robot`` drives it.

What a program imports is loaded when it is asked for: ``pons stop`` passes by here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pons.client import GoalReport, PlaceReport, RobotError, RobotStatus, RobotUnreachable
    from pons.client import RobotClient as Robot

__all__ = ["GoalReport", "PlaceReport", "Robot", "RobotError", "RobotStatus", "RobotUnreachable"]


def __getattr__(name: str) -> object:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module("pons.client"), "RobotClient" if name == "Robot" else name)
