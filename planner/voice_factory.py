"""Join the parts that hear and speak, as the owner's settings say. Chooses nothing by itself."""

from __future__ import annotations

import logging

from planner.plan import Language
from planner.settings import Settings
from planner.site import KnownPlaces
from planner.skill_files.words import list_spoken
from planner.voice import Ears, Recogniser, VoiceAbilities, VoiceWorker
from planner.voice.grammar import PLACE
from planner.voice.sherpa_model import open_model
from planner.voice.speech_engines import open_speech
from planner.voice.transcription import open_caller

log = logging.getLogger(__name__)


class VoiceParts:
    """Hold recognisers and the robot's own voice."""

    def __init__(self, settings: Settings, known: KnownPlaces) -> None:
        """Judge what is set; nothing is started.

        Args:
            settings: the owner's.
            known: the places whose English names may be said, and the skills.

        Raises:
            ConfigError: a setting can never work; see ``open_caller``, ``open_model`` and
                ``open_speech``.
        """
        self._settings, self._known = settings, known
        self._grammar = VoiceWorker(self._list_names())
        self._server = open_caller(settings.voice)
        self._model = open_model(settings.voice)
        self.speaker = open_speech(settings.speech)

    def recogniser(self) -> Recogniser:
        """Return what hears recordings: the grammar, and beside it what the owner set."""
        timeout_s = self._settings.voice.timeout_s
        if self._server is not None:
            log.info("recordings are heard by %s, too", self._server.host)
            return Ears(self._grammar, self._server, "server", timeout_s)
        if self._model is not None:
            log.info("recordings are heard by the model in %s, too", self._settings.voice.folder)
            return Ears(self._grammar, self._model, "sherpa", timeout_s)
        return self._grammar

    def learn_names(self) -> None:
        """Hear the names and orders of now from now on."""
        self._grammar.know(self._list_names(), list_spoken(self._known.vocabulary, PLACE))

    def _list_names(self) -> list[str]:
        return [name for place in self._known.places for name in place.said_in_english]

    def abilities(self) -> VoiceAbilities:
        """Show what is heard and spoken."""
        trouble, server = self.speaker.trouble, self._server
        model_hears = self._model is not None and self._model.failure is None
        heard_by = "server" if server else "sherpa" if model_hears else "grammar"
        return VoiceAbilities(
            languages=(Language.EN,) if heard_by == "grammar" else tuple(Language),
            recogniser=heard_by,
            host=None if server is None else server.host,
            speaks=self._settings.speech.engine,
            quiet=self.speaker.is_quiet,
            trouble=None if trouble is None else trouble.code,
        )

    def start(self) -> None:
        """Load a model that was set beside everything else, and begin to speak.

        The grammar's process begins where somebody may speak soon: a page was opened.
        """
        if self._model is not None:
            self._model.warm()
        self.speaker.start()

    async def close(self) -> None:
        """Fall silent, and end the recognisers' processes."""
        await self.speaker.close()
        await self._grammar.close()
        if self._model is not None:
            await self._model.close()
        if self._server is not None:
            await self._server.close()
