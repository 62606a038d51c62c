"""Read a reply that is still being written: the words to show and the steps that are complete.

For showing and for routing ahead: a draft may be wrong, and nothing in it can start a motion.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable
from typing import Any

from pydantic import TypeAdapter, ValidationError

from planner.brain.endpoint.plan_reply import clean, trim_step
from planner.brain.endpoint.reply_object import MAX_CHARACTERS, without_thoughts
from planner.brain.streamed_draft import MAX_DRAFT, Draft, Hear
from planner.plan import MAX_STEPS, Step, Vocabulary, list_nodes, places_of

TELL_S = 0.05
"""Between two drafts: twenty a second read as a flow."""
SHARE = 20.0
_STEP: TypeAdapter[Step] = TypeAdapter(Step)
_STEPS = re.compile(r'"steps"\s*:\s*\[')
_KIND = re.compile(r'"kind"\s*:\s*"([a-z_]*)"')
_NEXT = re.compile(r"[\s,]*")
_DRAFT_DECODER = json.JSONDecoder()
"""Lax: a draft is only shown, and the whole reply is judged by the strict one."""


class Drafting:
    """Tell one listener of one reply, now and then."""

    def __init__(
        self,
        vocabulary: Vocabulary,
        runnable: frozenset[str],
        hear: Hear,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._vocabulary, self._runnable = vocabulary, runnable
        self._hear, self._clock = hear, clock
        self._read_s, self._pause_s = float("-inf"), TELL_S
        self._told: Draft | None = None

    def __call__(self, written: Callable[[], str]) -> None:
        """Read what is written so far and tell of it, if the last reading is long enough ago."""
        now_s = self._clock()
        if now_s - self._read_s < self._pause_s:
            return
        text = written()
        draft = self.draft_of(text) if len(text) <= MAX_CHARACTERS else self._told
        # What is slow to read is read less often: a twentieth of the loop's time at most.
        self._read_s = self._clock()
        self._pause_s = max(TELL_S, SHARE * (self._read_s - now_s))
        if draft is not None and draft.text and draft != self._told:
            self._told = draft
            self._hear(draft)

    def draft_of(self, text: str) -> Draft:
        """Return the part of an unfinished text that can be shown."""
        spoken = without_thoughts(text)
        shown = clean(spoken[-MAX_DRAFT:])
        return Draft(text=shown, steps=tuple(self._steps(spoken)))

    def _steps(self, spoken: str) -> list[Step]:
        """Return the leading steps that are whole; none of a reply that is no plan."""
        begins, found = _STEPS.search(spoken), list[Step]()
        if begins is None:
            return found
        kind = _KIND.search(spoken, 0, begins.start())
        if kind is not None and kind[1] != "plan":
            return found
        at = begins.end()
        while len(found) < MAX_STEPS:
            at = _after(_NEXT, spoken, at)
            try:
                value, at = _DRAFT_DECODER.raw_decode(spoken, at)
            except (ValueError, RecursionError):
                break
            step = self._valid(value)
            if step is None:
                break
            found.append(step)
        return found

    def _valid(self, value: Any) -> Step | None:
        if not isinstance(value, dict):
            return None
        try:
            step = _STEP.validate_python(trim_step(value))
        except ValidationError:
            return None
        nodes = list_nodes((step,))
        known = all(place in self._vocabulary for n in nodes for place in places_of(n.step))
        return step if known and step.kind in self._runnable else None


def _after(pattern: re.Pattern[str], text: str, at: int) -> int:
    found = pattern.match(text, at)
    return found.end() if found is not None else at
