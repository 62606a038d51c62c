"""Say sentences aloud on the robot, one after the other, and break off at once when told to.

Nothing here can hold a goal or a stop up: sentences are handed over and forgotten. What waits too
long is left out, for a sentence that comes late misleads; so is what falls into quiet hours.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Protocol

from planner.plan import Language, QuietHours

log = logging.getLogger(__name__)

MAX_WAITING = 8
MAX_AGE_S = 20.0
"""From being handed over to its first sound."""
MAX_TEXT = 500
"""Characters of one sentence; as many as a step may say."""
LONGEST_S = 60.0
"""For the sound of one: 500 characters take half of that."""


class SpeechFailure(Exception):
    """No sound could be made or played; ``code`` is stable. The words stay on the page."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


class SpeechEngine(Protocol):
    """Make the sound of a sentence."""

    async def make(self, text: str, language: Language) -> bytes:
        """Return a WAV.

        Raises:
            SpeechFailure: there is none.
        """
        ...

    async def close(self) -> None:
        """Give back what was held."""
        ...


class SoundPlayer(Protocol):
    """Play a WAV; a cancelled call is silent at once."""

    async def play(self, sound: bytes) -> None:
        """Return when it has been heard.

        Raises:
            SpeechFailure: it can't be.
        """
        ...


class SpeechSink(Protocol):
    """Say sentences aloud."""

    def say(self, text: str, language: Language) -> None:
        """Take a sentence; returns at once."""
        ...

    def hush(self) -> None:
        """Break off what sounds and forget what waits."""
        ...


@dataclass(frozen=True, slots=True)
class PendingSentence:
    """Hold a sentence that waits for its turn."""

    text: str
    language: Language
    since_s: float


def minute_of_day() -> int:
    """Return the minute of the day by the machine's own clock and time zone."""
    now = datetime.now().astimezone()
    return 60 * now.hour + now.minute


class SpeechOutput:
    """Say what is handed over. Without an engine it is mute, and says nothing anywhere."""

    def __init__(
        self,
        engine: SpeechEngine | None,
        player: SoundPlayer | None,
        quiet: QuietHours | None = None,
        *,
        clock: Callable[[], float] = time.monotonic,
        minute: Callable[[], int] = minute_of_day,
    ) -> None:
        self._engine, self._player, self._quiet = engine, player, quiet
        self._clock, self._minute = clock, minute
        self._waiting: deque[PendingSentence] = deque()
        self._news = asyncio.Event()
        self._task: asyncio.Task[None] | None = None
        self._sounding: asyncio.Task[None] | None = None
        self.trouble: SpeechFailure | None = None
        """Of the newest sentence; None once one was heard again."""
        self.left_out = 0
        """Sentences that came too late, were too many, or fell into quiet hours."""

    @property
    def is_quiet(self) -> bool:
        """Return whether nothing is said aloud at this hour."""
        return self._quiet is not None and self._quiet.holds(self._minute())

    def start(self) -> None:
        """Begin to speak; without an engine there is nothing to begin."""
        if self._engine is not None and self._task is None:
            self._task = asyncio.create_task(self._run(), name="speaker")

    def say(self, text: str, language: Language) -> None:
        """Take a sentence; returns at once."""
        text = " ".join(text.split())[:MAX_TEXT]
        if self._task is None or not text:
            return
        if self.is_quiet or len(self._waiting) >= MAX_WAITING:
            self.left_out += 1
            return
        self._waiting.append(PendingSentence(text, language, self._clock()))
        self._news.set()

    def hush(self) -> None:
        """Break off the sentence that sounds and forget those that wait."""
        self._waiting.clear()
        if self._sounding is not None:
            self._sounding.cancel()

    async def close(self) -> None:
        """Fall silent for good."""
        self.hush()
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
            self._task = None
        if self._engine is not None:
            await self._engine.close()

    async def _run(self) -> None:
        while True:
            await self._news.wait()
            self._news.clear()
            while self._waiting:
                sentence = self._waiting.popleft()
                if self._clock() - sentence.since_s <= MAX_AGE_S and not self.is_quiet:
                    await self._sound(sentence)
                else:
                    self.left_out += 1

    async def _sound(self, sentence: PendingSentence) -> None:
        """Say one sentence; whatever becomes of it, the next has its turn."""
        self._sounding = asyncio.create_task(self._make_and_play(sentence))
        try:
            await asyncio.wait({self._sounding})
        finally:
            if not self._sounding.done():  # the speaker itself is closed
                self._sounding.cancel()
                with contextlib.suppress(asyncio.CancelledError):
                    await self._sounding
            elif not self._sounding.cancelled():
                self._note(self._sounding.exception())
            self._sounding = None

    async def _make_and_play(self, sentence: PendingSentence) -> None:
        if self._engine is None or self._player is None:
            return
        try:
            async with asyncio.timeout(LONGEST_S):
                sound = await self._engine.make(sentence.text, sentence.language)
                await self._player.play(sound)
        except TimeoutError:
            raise SpeechFailure("speech_timeout", f"no end within {LONGEST_S:g} s") from None

    def _note(self, error: BaseException | None) -> None:
        """Remember why nothing was heard, and log it where it is news."""
        if error is None:
            self.trouble = None
        elif isinstance(error, SpeechFailure):
            if self.trouble is None or self.trouble.code != error.code:
                log.warning("not said aloud: %s", error)
            self.trouble = error
        else:
            raise error
