"""Own the exception by which a reader is found to lie."""

from __future__ import annotations


class Unsound(Exception):
    """A decoder took what it should not, or does not say again what it took."""
