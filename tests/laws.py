"""Say how many examples a law needs at least, whatever the profile says."""

from __future__ import annotations

from hypothesis import settings


def at_least(examples: int) -> settings:
    """Return settings that try so many examples, and more where the profile (`make laws`) does."""
    return settings(max_examples=max(examples, settings().max_examples))
