"""Think recorded goals again with another model: ``pons replay FILE --with-model NAME@URL``."""

from pons.evals.journal.command import run

__all__ = ["run"]
