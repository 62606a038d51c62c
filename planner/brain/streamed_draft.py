"""Own how a listener hears a plan while it is written: bounded words, and the steps read so far.

For showing, and for routing ahead. Nothing in it may lead to motion: the plan that counts is the
one which `think` returns, judged as a whole.
"""

from __future__ import annotations

from typing import Protocol

from pydantic import Field

from planner.plan import Frozen, Step

MAX_DRAFT = 2000
"""Characters of a draft that are told; of more, the newest."""


class Draft(Frozen):
    """Hold a brain's text so far."""

    text: str = Field(max_length=MAX_DRAFT)
    """As the model writes it, without thoughts, keys and characters that nobody sees."""
    steps: tuple[Step, ...] = ()
    """The leading steps that are written to their end and valid in the closed world."""
    loads: bool = False
    """No word came yet: the text is the robot's own, the model's server may be loading."""


class Hear(Protocol):
    """Listen to a plan as it is written. Called on the event loop: returns at once."""

    def __call__(self, draft: Draft, /) -> None:
        """Take what is written so far; it may be told again, and may begin anew."""
