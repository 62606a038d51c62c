"""A server that hears and speaks, as the recogniser's and the speaker's clients meet it."""

from __future__ import annotations

import asyncio
import math
import struct
from collections.abc import Iterator
from typing import Any

import pytest

from planner.plan import Language
from planner.settings import SpeechSettings, VoiceSettings
from planner.voice import Recognition, Sound, SpeechFailure, VoiceFailure, read_wav
from planner.voice.speech_engines import ServerVoice
from planner.voice.transcription import open_caller
from tests.pons.mock_llm.mocks import RunningMock, running_mock

TONE = Sound(
    16_000, 1, b"".join(struct.pack("<h", int(9000 * math.sin(k / 8))) for k in range(8000))
)


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    with running_mock() as running:
        yield running


def hear(mock: RunningMock, timeout_s: float = 5.0, **switches: Any) -> Recognition:
    mock.set(**switches)

    async def story() -> Recognition:
        server = open_caller(VoiceSettings(url=mock.url, timeout_s=timeout_s))
        assert server is not None
        try:
            return await server.hear(TONE)
        finally:
            await server.close()

    return asyncio.run(story())


def test_it_hears_what_it_is_told_to_hear(mock: RunningMock) -> None:
    heard = hear(mock, transcript="去客厅看看", probability=0.9)
    assert (heard.transcript, heard.language) == ("去客厅看看", Language.ZH)
    assert heard.confidence == pytest.approx(0.9 * 0.99)
    assert not hear(mock, transcript="go home", probability=None).sure


@pytest.mark.parametrize(
    ("switches", "code"),
    [
        ({"fault": "status"}, "server_error"),
        ({"fault": "status", "status": 401}, "bad_key"),
        ({"fault": "rate_limited"}, "rate_limited"),
        ({"fault": "not_found"}, "unknown_route"),
        ({"fault": "redirect"}, "redirect"),
        ({"fault": "garbage"}, "bad_reply"),
    ],
)
def test_its_faults_are_met_as_faults(
    mock: RunningMock, switches: dict[str, Any], code: str
) -> None:
    with pytest.raises(VoiceFailure) as failure:
        hear(mock, **switches)
    assert failure.value.code == f"transcription_{code}"


def test_it_speaks_in_tones(mock: RunningMock) -> None:
    async def make(text: str) -> bytes:
        voice = ServerVoice(SpeechSettings(engine="server", url=mock.url))
        try:
            return await voice.make(text, Language.EN)
        finally:
            await voice.close()

    mock.set()
    short, long = (read_wav(asyncio.run(make(text))).seconds for text in ("hi", "hi " * 20))
    assert short < long
    mock.set(fault="garbage")
    with pytest.raises(SpeechFailure, match="speech_bad_reply"):
        asyncio.run(make("hi"))
