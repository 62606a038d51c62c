"""Examine a model in a minute: ``pons eval --quick``, also ``pons doctor --model``."""

from pons.evals.quick.command import run

__all__ = ["run"]
