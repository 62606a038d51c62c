"""Own a brain's report to the budget: each call before it is made, and its end.

A call goes out inside a goal's thinking or not at all: ``THINKING_ABOUT`` says whose. Knows no
limit, no price and no network.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Protocol

THINKING_ABOUT: ContextVar[str | None] = ContextVar("THINKING_ABOUT", default=None)
"""The goal whose thinking this task does; None: nobody asked, so no call may go out."""


class Bill(Protocol):
    """Be one open call. Closed once, with any result."""

    @property
    def max_reply_tokens(self) -> int:
        """Return the tokens that the reply may have at most."""
        ...

    def close(self, prompt_tokens: int, reply_tokens: int) -> None:
        """Report the tokens billed by the server, or an upper bound where it does not say."""
        ...


class Meter(Protocol):
    """Count the usage of models, and refuse calls beyond the budget."""

    async def open(self, prompt_tokens: int) -> Bill:
        """Count a call that is about to go out.

        Args:
            prompt_tokens: an estimate of what is sent.

        Raises:
            OutOfBudget: it may not go out.
        """
        ...


@contextmanager
def thinking_about(goal: str) -> Iterator[None]:
    """Attribute model calls inside the block to a goal."""
    token = THINKING_ABOUT.set(goal)
    try:
        yield
    finally:
        THINKING_ABOUT.reset(token)
