"""Make and play the sound of sentences by programs and servers that the owner has.

espeak-ng speaks both languages on any small computer; a server speaks better. Both give a WAV,
which a program of the owner's plays, so that falling silent is the end of one process.
"""

from __future__ import annotations

import asyncio
import shutil
from asyncio.subprocess import PIPE, Process
from collections.abc import Sequence
from typing import TYPE_CHECKING

from planner.outbound import Address, CallFailure
from planner.plan import Language
from planner.voice.speech_output import SpeechEngine, SpeechFailure, SpeechOutput
from wire import ConfigError

if TYPE_CHECKING:
    from planner.outbound.caller import Transport
    from planner.settings import SpeechSettings

ROUTE = "/audio/speech"
ESPEAK = "espeak-ng"
MAX_SOUND_BYTES = 10_000_000
"""Of one sentence; a minute at 48 kHz and 16 bits is 5.8 MB."""
MAX_COMPLAINT = 200


def open_speech(settings: SpeechSettings) -> SpeechOutput:
    """Return the speaker that the settings describe; a mute one where none is set.

    Raises:
        ConfigError: ``speech_incomplete``, ``speech_url``, ``speech_offhost`` or
            ``speech_program``: a program that is named is not installed.
    """
    if settings.engine == "none":
        return SpeechOutput(None, None)
    engine: SpeechEngine = (
        ServerVoice(settings) if settings.engine == "server" else _espeak(settings)
    )
    need_program(settings.player[0])
    return SpeechOutput(engine, ProgramPlayer(settings.player), settings.quiet)


def need_program(name: str) -> None:
    """Refuse a program that is not there.

    Raises:
        ConfigError: ``speech_program``.
    """
    if shutil.which(name) is None:
        known = {"aplay": "alsa-utils", ESPEAK: ESPEAK}.get(name)
        cure = f"; on Debian: sudo apt install {known}" if known else ""
        raise ConfigError(
            "speech_program", f"[speech] needs {name!r}, which is not installed{cure}"
        )


def _espeak(settings: SpeechSettings) -> EspeakVoice:
    need_program(ESPEAK)
    return EspeakVoice(settings)


class EspeakVoice:
    """Speak by espeak-ng."""

    def __init__(self, settings: SpeechSettings) -> None:
        self._voices = {Language.EN: settings.voice_en, Language.ZH: settings.voice_zh}

    async def make(self, text: str, language: Language) -> bytes:
        """Return the WAV that espeak-ng writes.

        Raises:
            SpeechFailure: ``speech_engine``.
        """
        voice = self._voices[language]
        # By its input: a sentence that begins with a dash is no option, and no process list has it.
        command = (ESPEAK, "-v", voice, "--stdin", "--stdout")
        return await run_program(command, text.encode(), "speech_engine")

    async def close(self) -> None:
        """Hold nothing."""


class ServerVoice:
    """Speak by a server: OpenAI's ``/audio/speech``."""

    def __init__(self, settings: SpeechSettings, transport: Transport | None = None) -> None:
        """Judge the address; nothing is asked yet.

        Raises:
            ConfigError: ``speech_incomplete``, ``speech_url`` or ``speech_offhost``.
        """
        if settings.url is None:
            raise ConfigError("speech_incomplete", '[speech] engine = "server" needs a url')
        address = Address.parse(settings.url, ROUTE, "speech")
        if not address.local and not settings.allow_offhost:
            raise ConfigError(
                "speech_offhost",
                f"what the robot says would be sent to {address.host}; if that is meant, set "
                "allow_offhost = true under [speech]",
            )
        from planner.outbound.caller import Caller  # httpx costs 0.1 s: not for nothing

        self._settings = settings
        key = settings.key.get_secret_value() if settings.key is not None else ""
        self._caller = Caller(address, key, timeout_s=settings.timeout_s, transport=transport)

    async def make(self, text: str, language: Language) -> bytes:
        """Return the WAV that the server makes.

        Raises:
            SpeechFailure: ``speech_`` and the reason of ``planner.outbound``.
        """
        del language  # such a server reads it from the text
        body = {
            "model": self._settings.model,
            "voice": self._settings.voice or "alloy",
            "input": text,
            "response_format": "wav",
        }
        try:
            async with asyncio.timeout(self._settings.timeout_s):
                answer = await self._caller.post(most_bytes=MAX_SOUND_BYTES, json=body)
        except TimeoutError:
            told = f"no sound within {self._settings.timeout_s:g} s"
            raise SpeechFailure("speech_timeout", told) from None
        except CallFailure as failure:
            raise SpeechFailure(f"speech_{failure.why}", str(failure)) from None
        if not (answer.body.startswith(b"RIFF") and answer.body[8:12] == b"WAVE"):
            told = f"{answer.kind or 'something'} of {len(answer.body)} bytes; expected a WAV"
            raise SpeechFailure("speech_bad_reply", told)
        return answer.body

    async def close(self) -> None:
        """Give the connections back."""
        await self._caller.close()


class ProgramPlayer:
    """Play by a program that reads a WAV from its input."""

    def __init__(self, command: Sequence[str]) -> None:
        self._command = tuple(command)

    async def play(self, sound: bytes) -> None:
        """Return when the program has ended.

        Raises:
            SpeechFailure: ``speech_player``.
        """
        await run_program(self._command, sound, "speech_player")


async def run_program(command: Sequence[str], given: bytes, code: str) -> bytes:
    """Return a program's output; a cancelled call kills it and waits until it is gone.

    Raises:
        SpeechFailure: ``code``: it did not start, or ended with an error.
    """
    try:
        process = await asyncio.create_subprocess_exec(
            *command, stdin=PIPE, stdout=PIPE, stderr=PIPE
        )
    except OSError as error:
        raise SpeechFailure(code, f"{command[0]}: {error.strerror}") from None
    try:
        out, complaint = await process.communicate(given)
    except BaseException:
        await _kill(process)
        raise
    if process.returncode != 0:
        words = " ".join(complaint.decode("utf-8", "replace").split())[:MAX_COMPLAINT]
        raise SpeechFailure(code, f"{command[0]} ended with {process.returncode}: {words}")
    return out


async def _kill(process: Process) -> None:
    if process.returncode is None:
        process.kill()
    await asyncio.shield(process.wait())
