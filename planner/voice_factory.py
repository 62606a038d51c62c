"""Join the parts that hear and speak, as the owner's settings say. Chooses nothing by itself."""

from __future__ import annotations

import logging
from collections.abc import Callable

from planner.plan import Language
from planner.settings import Settings
from planner.voice import Ears, Recogniser, VoiceAbilities, VoiceWorker
from planner.voice.speech_engines import open_speech
from planner.voice.transcription import open_caller

log = logging.getLogger(__name__)


class VoiceParts:
    """Hold recognisers and the robot's own voice."""

    def __init__(self, settings: Settings, names: Callable[[], list[str]]) -> None:
        """Judge what is set; nothing is started.

        Args:
            settings: the owner's.
            names: returns the English names that may be said now.

        Raises:
            ConfigError: a setting can never work; see ``open_caller`` and ``open_speech``.
        """
        self._settings, self._names = settings, names
        self._grammar = VoiceWorker(names())
        self._server = open_caller(settings.voice)
        self.speaker = open_speech(settings.speech)

    def recogniser(self) -> Recogniser:
        """Return what hears recordings: the grammar, and a server beside it where one is set."""
        if self._server is None:
            return self._grammar
        log.info("recordings are heard by %s, too", self._server.host)
        return Ears(self._grammar, self._server, "server", self._settings.voice.timeout_s)

    def learn_names(self) -> None:
        """Hear the names of now from now on."""
        self._grammar.know(self._names())

    def abilities(self) -> VoiceAbilities:
        """Show what is heard and spoken."""
        trouble, server = self.speaker.trouble, self._server
        return VoiceAbilities(
            languages=(Language.EN,) if server is None else tuple(Language),
            recogniser="grammar" if server is None else "server",
            host=None if server is None else server.host,
            speaks=self._settings.speech.engine,
            quiet=self.speaker.is_quiet,
            trouble=None if trouble is None else trouble.code,
        )

    def start(self) -> None:
        """Load the recogniser beside everything else, and begin to speak."""
        self._grammar.warm()
        self.speaker.start()

    async def close(self) -> None:
        """Fall silent, and end the recogniser's process."""
        await self.speaker.close()
        await self._grammar.close()
        if self._server is not None:
            await self._server.close()
