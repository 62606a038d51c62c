"""Define a recogniser: one recording in, a text with a confidence out. Knows no engine.

Another recogniser takes the place of the built-in one, or stands beside it, by this Protocol alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from planner.plan import Language

if TYPE_CHECKING:
    from planner.voice.wav import Sound

SURE = 0.75
"""Of 200 synthetic sentences none was wrong above it, of 280 harder ones that no limit was set on
three (docs/adr/0013)."""


@dataclass(frozen=True, slots=True)
class Recognition:
    """Hold a transcript. Only an ``understood`` one may become a goal."""

    transcript: str
    """What was said, as far as it was heard; empty for silence."""
    confidence: float
    """0 to 1; from one half on, the recogniser believes itself."""
    understood: bool
    """Whether the transcript is a whole order, heard with enough confidence."""
    language: Language = Language.EN
    by: str = "grammar"
    """The recogniser that heard it: ``grammar``, ``server`` or ``sherpa``."""
    instead_of: str | None = None
    """The recogniser that should have heard it and did not."""
    trouble: str | None = None
    """Stable code of why it did not."""

    @property
    def sure(self) -> bool:
        """Tell whether to act on it at once; else a person sees the plan first and says yes."""
        return self.understood and self.confidence >= SURE


class VoiceFailure(Exception):
    """No recogniser can answer now; ``code`` is stable. Nothing was understood, nothing moves."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


class StopListener(Protocol):
    """Hear one recording while it is being spoken, for a stop alone."""

    async def take(self, sound: Sound) -> Recognition | None:
        """Hear the next samples; return a stop as soon as one is heard.

        Raises:
            VoiceFailure: as ``Recogniser.hear``.
        """
        ...


class Recogniser(Protocol):
    """Hear recordings, one at a time, without holding the event loop."""

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        """Return the recognition; ``awaits_answer``: a question waits for a yes or no.

        Raises:
            VoiceFailure: ``recogniser_unavailable``, ``voice_busy`` or ``voice_timed_out``.
        """
        ...

    def warm(self) -> None:
        """Get ready beside everything else: somebody may speak soon."""
        ...

    def listen(self) -> tuple[StopListener, ...]:
        """Return what hears one recording while it is spoken; none where only whole ones are."""
        ...
