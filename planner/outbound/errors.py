"""Class what can go wrong with a call to a server that the owner named. Standard library alone."""

from __future__ import annotations


class CallFailure(Exception):
    """No usable answer came; ``why`` is stable, the words hold no key."""

    def __init__(self, detail: str, *, why: str) -> None:
        super().__init__(detail)
        self.why = why
