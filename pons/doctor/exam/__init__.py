"""Examine a model in a minute: ``pons doctor --model``. Asks it alone; nothing moves."""

from pons.doctor.exam.command import run

__all__ = ["run"]
