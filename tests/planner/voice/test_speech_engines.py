"""The sound of sentences: real programs, a server that answers anything, and silence at once."""

from __future__ import annotations

import asyncio
import json
import shutil
import sys
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from planner.plan import Language
from planner.settings import SpeechSettings
from planner.voice import SpeechFailure, read_wav
from planner.voice.speech_engines import EspeakVoice, ProgramPlayer, ServerVoice, open_speech
from tests.e2e.polling import until
from tests.planner.voice.speech import needs_espeak, wav
from wire import ConfigError

SOUND = wav(bytes(3200))
SERVER: dict[str, Any] = {"engine": "server", "url": "http://127.0.0.1:9/v1"}


def seconds(sound: bytes) -> float:
    """Return how long a WAV of a program lasts, whose header speaks of endless sound."""
    pcm = sound[44 : len(sound) // 2 * 2]
    return read_wav(wav(pcm, int.from_bytes(sound[24:28], "little"))).seconds


@needs_espeak
@pytest.mark.parametrize(
    ("text", "language"),
    [
        ("Dinner is ready.", Language.EN),
        ("饭好了，快来吃。", Language.ZH),
        ("--help me", Language.EN),
    ],
)
def test_espeak_speaks_both_languages_and_takes_no_words_for_options(
    text: str, language: Language
) -> None:
    sound = asyncio.run(EspeakVoice(SpeechSettings(engine="espeak")).make(text, language))
    assert sound.startswith(b"RIFF")
    assert 0.3 < seconds(sound) < 10.0


@needs_espeak
def test_a_voice_that_espeak_does_not_have_is_a_failure() -> None:
    engine = EspeakVoice(SpeechSettings(engine="espeak", voice_en="klingon-9"))
    with pytest.raises(SpeechFailure, match="speech_engine"):
        asyncio.run(engine.make("hello", Language.EN))


def speak(handler: httpx.MockTransport, text: str = "hello") -> bytes:
    async def story() -> bytes:
        voice = ServerVoice(SpeechSettings(**SERVER), handler)
        try:
            return await voice.make(text, Language.EN)
        finally:
            await voice.close()

    return asyncio.run(story())


def test_a_server_is_asked_for_a_wav() -> None:
    asked: list[httpx.Request] = []

    def handler(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return httpx.Response(200, stream=httpx.ByteStream(SOUND))

    assert speak(httpx.MockTransport(handler)) == SOUND
    assert str(asked[0].url).endswith("/v1/audio/speech")
    told = json.loads(asked[0].content)
    assert (told["input"], told["response_format"]) == ("hello", "wav")


@pytest.mark.parametrize(
    ("status", "body", "code"),
    [(200, b"", "bad_reply"), (200, b"ID3mp3", "bad_reply"), (200, b"RIFF1234AVI ", "bad_reply"),
     (200, b'{"error": 1}', "bad_reply"), (401, b"", "bad_key"), (500, b"", "server_error"),
     (200, bytes(10_000_001), "too_large")],
)  # fmt: skip
def test_what_is_no_wav_is_not_played(status: int, body: bytes, code: str) -> None:
    def handler(_: httpx.Request) -> httpx.Response:
        return httpx.Response(status, stream=httpx.ByteStream(body))

    with pytest.raises(SpeechFailure) as failure:
        speak(httpx.MockTransport(handler))
    assert failure.value.code == f"speech_{code}"


def test_a_program_plays_what_it_is_given(tmp_path: Path) -> None:
    heard = tmp_path / "heard.wav"
    asyncio.run(ProgramPlayer(("tee", str(heard))).play(SOUND))
    assert heard.read_bytes() == SOUND


async def test_a_cancelled_player_is_gone_before_the_call_returns() -> None:
    command = (sys.executable, "-S", "-c", "import sys, time; sys.stdin.read; time.sleep(60)")
    playing = asyncio.create_task(ProgramPlayer(command).play(SOUND))
    me = psutil.Process()
    children = await asyncio.to_thread(until, me.children, 10.0, "a player")
    playing.cancel()
    with pytest.raises(asyncio.CancelledError):
        await playing
    assert not any(each.is_running() for each in children)


@pytest.mark.parametrize("command", [("false",), ("/nowhere/at-all",)])
def test_a_player_that_fails_says_so(command: tuple[str, ...]) -> None:
    with pytest.raises(SpeechFailure, match="speech_player"):
        asyncio.run(ProgramPlayer(command).play(bytes(1_000_000)))


@pytest.mark.parametrize(
    ("given", "code"),
    [
        ({"engine": "server"}, "speech_incomplete"),
        ({"engine": "server", "url": "ftp://x"}, "speech_url"),
        ({"engine": "server", "url": "https://voices.example/v1"}, "speech_offhost"),
        ({**SERVER, "player": ("no-such-program",)}, "speech_program"),
    ],
)
def test_settings_that_can_never_sound_refuse_to_start(given: dict[str, Any], code: str) -> None:
    with pytest.raises(ConfigError) as refused:
        open_speech(SpeechSettings(**given))
    assert refused.value.code == code


def test_nothing_set_is_mute_and_needs_no_program(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda _: None)
    open_speech(SpeechSettings())
    with pytest.raises(ConfigError, match="apt install espeak-ng"):
        open_speech(SpeechSettings(engine="espeak"))
