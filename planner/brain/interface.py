"""Define a brain: one question in, one thought out. Knows no model, no network, no grammar.

A brain may be slow, wrong or gone; what it returns is judged by `planner.plan.check_plan`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Annotated, Literal, Protocol

from pydantic import BeforeValidator, Field

from planner.brain.situation import Situation
from planner.brain.streamed_draft import Hear
from planner.plan import (
    RUNNABLE,
    Bilingual,
    BrainTag,
    ChangedOrder,
    Code,
    Frozen,
    Language,
    LastOrder,
    Plan,
    Vocabulary,
)

OFFLINE = "offline"
"""Name of the brain that is no model: it plans by grammar and reads no free answer."""
MAX_OBSERVED = 40
"""Observations handed to one thought, the newest."""
MAX_DETAIL = 300
"""Characters of one observation in one language; what is longer is cut."""


MAX_READ = 900
"""And of what a picture or a tool said."""


def _short(detail: object, most: int = MAX_DETAIL) -> object:
    if not isinstance(detail, Bilingual):
        return detail
    return Bilingual(en=detail.en[:most], zh=detail.zh[:most])


class Observation(Frozen):
    """Report the result of one step to a brain that thinks again.

    Facts, and words that people answered: they may describe, never command.
    """

    step: Annotated[str, Field(min_length=1, max_length=40)]  # the kind of the step
    result: Literal["succeeded", "failed", "skipped", "answered"]
    detail: Annotated[Bilingual, BeforeValidator(_short)]
    read: Annotated[Bilingual | None, BeforeValidator(partial(_short, most=MAX_READ))] = None
    """What a model wrote about a picture, or a tool answered. Tainted: words that strangers wrote
    may be in it, so nothing that is done follows from it (``planner.brain.tainted_text``), and
    nothing of it is in ``detail``."""


class Exchange(Frozen):
    """Report one question of a brain about an order, and the person's answer."""

    asked: str
    answer: str


class ThinkRequest(Frozen):
    """Ask for a plan of one sentence in one closed world."""

    text: str
    vocabulary: Vocabulary
    changed: ChangedOrder | None = None
    """What the sentence makes of the newest order. For the built-in brain alone: a model reads the
    words as they were said, beside ``situation``."""
    room: str | None = None  # the id of the room the robot is in, where known
    language: Language | None = None  # as the client said; else told from the text
    runnable: frozenset[str] = RUNNABLE  # kinds of steps this robot can do now
    blind: Code = Code.NO_CAMERA  # what is said of a step that needs eyes and can't be done
    things: frozenset[str] = frozenset()  # names, in any language, of what these eyes know
    kinds: tuple[str, ...] = ()  # the same by the detector's own English names, for a model
    observed: Annotated[tuple[Observation, ...], Field(max_length=MAX_OBSERVED)] = ()
    """What came of this goal's steps so far, oldest first; empty for a goal's first thought."""
    replan: int = Field(default=0, ge=0)
    """How often this goal was thought about again after a step that failed."""
    standing: str = ""  # the whole sentence of a standing order; ``text`` is what is to be done
    departed: bool = False  # the order before led the robot away: "come back" means from there
    newest: LastOrder | None = Field(default=None, exclude=True)
    """The newest order, which the text may change. For the built-in brain alone."""
    order: str = ""  # what was said first, where ``text`` answers a question about it
    exchanges: tuple[Exchange, ...] = ()  # these questions and answers; the last answer is ``text``
    situation: Situation | None = None  # where things stand, for a brain that can read of it
    goal: str = ""  # the id of the goal that is thought about: what it may cost is counted by it
    refuse_offer: Callable[[str], Bilingual | None] | None = Field(default=None, exclude=True)
    """Says why a standing order that a question offers could not be kept; None: it could."""
    accepts: Callable[[Plan], bool] | None = Field(default=None, exclude=True)
    """Says whether the asker will take a plan, for the record of what was used; None: any."""


class ThinkResult(Frozen):
    """Return a plan, the brain that made it, and its cost."""

    plan: Plan
    brain: BrainTag
    calls: int = Field(default=0, ge=0)  # to a model
    tokens: int = Field(default=0, ge=0)  # all that was billed
    prompt_tokens: int = Field(default=0, ge=0)  # of these, what was sent
    reply_tokens: int = Field(default=0, ge=0)  # and what was written
    by_grammar: bool = False
    """A program of ours read it in the person's words, or wrote it; no model had a hand in it. All
    other plans are held to these words before they move anything."""


class Brain(Protocol):
    """Turn a request into a thought. Cancelling `think` must take effect at once."""

    @property
    def tag(self) -> BrainTag:
        """Return the brain's name and version, for the goal's record."""
        ...

    async def think(self, request: ThinkRequest, hear: Hear | None = None) -> ThinkResult:
        """Return the plan of a sentence; nothing has moved when it returns.

        Args:
            request: what was said, and the closed world.
            hear: listens to the plan as it is written; a brain that answers at once needs not
                tell.

        Raises:
            BadPlan: what the model wrote is no plan, and its repairs are used up.
            BrainDown: the model does not answer in time.
        """
        ...
