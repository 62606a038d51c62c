"""Examine a model in a minute: ``pons doctor --model``. Asks it alone; nothing moves."""

from pons.evals.quick.command import run

__all__ = ["run"]
