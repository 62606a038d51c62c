"""The home that the tests of sentences use, for the tests of brains."""

from tests.planner.language.grammar.conftest import (
    HOME,
    NOON,
    home,
    in_short,
    understood,
    understood_bare,
)

__all__ = ["HOME", "NOON", "home", "in_short", "understood", "understood_bare"]
