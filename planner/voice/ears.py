"""Hear with the recogniser that the owner set, and listen for a stop without it.

The built-in grammar hears each recording too, on this machine: its stop is handed on at once,
however long the other recogniser thinks or hangs, and its order counts where the other fails.
"""

from __future__ import annotations

import asyncio
import contextlib
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.stop import is_stop
from planner.voice.recogniser import Recogniser, Recognition, StopListener, VoiceFailure

if TYPE_CHECKING:
    from planner.voice.wav import Sound

STOP_DOUBT = 0.2
"""A stop heard with at least this confidence stops what moves, though no order would be believed.
Of other sentences the built-in recogniser makes stops of up to 0.17 (docs/adr/0013)."""

GRAMMAR_S = 2.0
"""How long an order of the other recogniser waits for the grammar, which may hear a stop in it [s].
It takes 0.3 s on a desktop; one that takes longer than this is not at work."""


def is_spoken_stop(heard: Recognition) -> bool:
    """Return whether a recognition is a stop that the robot should rather obey."""
    believed = heard.understood or heard.confidence >= STOP_DOUBT
    return believed and is_stop(heard.transcript)


class Ears:
    """Ask two recognisers at once: the built-in grammar and another one."""

    def __init__(self, grammar: Recogniser, other: Recogniser, name: str, timeout_s: float) -> None:
        """Join them.

        Args:
            grammar: the built-in one, which hears stops.
            other: whose word counts for everything else.
            name: of the other one, for people and records.
            timeout_s: how long the other may take.
        """
        self._grammar, self._other = grammar, other
        self._name, self._timeout_s = name, timeout_s

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        """Return the recognition; ``awaits_answer``: a question waits for a yes or no.

        Raises:
            VoiceFailure: of the other recogniser, where neither heard.
        """
        near = asyncio.create_task(self._grammar.hear(sound, awaits_answer=awaits_answer))
        far = asyncio.create_task(self._hear_in_time(sound, awaits_answer=awaits_answer))
        try:
            stop = await _stop_among(near, far)
            if stop is not None:
                return stop
            return await self._choose(near, far)
        finally:
            for task in (near, far):
                task.cancel()
            await asyncio.gather(near, far, return_exceptions=True)

    def warm(self) -> None:
        """Have both get ready."""
        self._grammar.warm()
        self._other.warm()

    def listen(self) -> tuple[StopListener, ...]:
        """Return what hears a recording while it is spoken, of both."""
        return self._grammar.listen() + self._other.listen()

    async def _hear_in_time(self, sound: Sound, *, awaits_answer: bool) -> Recognition:
        try:
            async with asyncio.timeout(self._timeout_s):
                return await self._other.hear(sound, awaits_answer=awaits_answer)
        except TimeoutError:
            told = f"{self._name} did not answer within {self._timeout_s:g} s"
            raise VoiceFailure("transcription_timeout", told) from None

    async def _choose(
        self, near: asyncio.Task[Recognition], far: asyncio.Task[Recognition]
    ) -> Recognition:
        """Return the other recogniser's word, or the grammar's where the other failed."""
        try:
            return await far
        except VoiceFailure as failure:
            with contextlib.suppress(VoiceFailure):
                heard = await near
                return replace(heard, instead_of=self._name, trouble=failure.code)
            raise


async def _stop_among(
    near: asyncio.Task[Recognition], far: asyncio.Task[Recognition]
) -> Recognition | None:
    """Return the first stop that either hears, as soon as it does; None where none of both does."""
    waiting = {near, far}
    while waiting:
        patience_s = GRAMMAR_S if far not in waiting else None
        done, waiting = await asyncio.wait(
            waiting, timeout=patience_s, return_when=asyncio.FIRST_COMPLETED
        )
        if not done:
            return None
        for task in done:
            if task.exception() is None and is_spoken_stop(task.result()):
                return task.result()
    return None
