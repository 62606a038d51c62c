"""Say how many examples a law needs, beside what the profile says."""

from __future__ import annotations

from hypothesis import settings


def at_least(examples: int) -> settings:
    """Return settings that try so many examples, and more where the profile (`make laws`) does."""
    return settings(max_examples=max(examples, settings().max_examples))


def fewer(times: int) -> settings:
    """Return settings that try a share of the profile's examples, where each one is dear."""
    return settings(max_examples=max(4, settings().max_examples // times))
