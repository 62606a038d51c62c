"""The home that the tests of sentences use, for the laws."""

from tests.planner.language.grammar.conftest import home, understood, understood_bare

__all__ = ["home", "understood", "understood_bare"]
