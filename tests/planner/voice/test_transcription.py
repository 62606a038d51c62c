"""What a transcription server is asked, and how much of its answer is believed."""

from __future__ import annotations

import asyncio
import json
import math
import struct
from collections.abc import Callable
from typing import Any

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.outbound import CallFailure
from planner.plan import Language
from planner.settings import VoiceSettings
from planner.voice import Recognition, Sound, VoiceFailure, read_wav
from planner.voice.transcription import (
    TranscriptionServer,
    as_wav,
    clean,
    confidence_of,
    is_silent,
    open_caller,
    read_transcription,
)
from wire import ConfigError

TONE = Sound(
    16_000, 1, b"".join(struct.pack("<h", int(9000 * math.sin(k / 8))) for k in range(8000))
)
URL = "http://127.0.0.1:9/v1"
Handler = Callable[[httpx.Request], httpx.Response]
Json = dict[str, Any]


def answer(told: Json, status: int = 200) -> httpx.Response:
    return httpx.Response(status, stream=httpx.ByteStream(json.dumps(told).encode()))


def hear(handler: Handler, sound: Sound = TONE, times: int = 1) -> Recognition:
    async def story() -> Recognition:
        server = open_caller(VoiceSettings(url=URL), httpx.MockTransport(handler))
        assert isinstance(server, TranscriptionServer)
        try:
            return [await server.hear(sound) for _ in range(times)][-1]
        finally:
            await server.close()

    return asyncio.run(story())


def segments(*pairs: tuple[float, float]) -> list[Json]:
    return [{"avg_logprob": log, "no_speech_prob": silent} for log, silent in pairs]


def test_a_recording_goes_out_as_a_wav_of_our_own_and_comes_back_as_text() -> None:
    asked: list[httpx.Request] = []

    def handler(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return answer({"text": " Go to the kitchen. ", "segments": segments((-0.1, 0.02))})

    heard = hear(handler)
    assert heard.transcript == "Go to the kitchen."
    assert (heard.understood, heard.sure, heard.by) == (True, True, "server")
    assert str(asked[0].url) == f"{URL}/audio/transcriptions"
    body = asked[0].content
    assert b'name="model"\r\n\r\nwhisper-1' in body
    assert as_wav(TONE) in body
    assert read_wav(as_wav(TONE)) == TONE


def test_chinese_is_told_by_its_writing() -> None:
    heard = hear(lambda _: answer({"text": "去客厅看看", "language": "english"}))
    assert (heard.language, heard.transcript) == (Language.ZH, "去客厅看看")


def test_a_server_without_probabilities_is_understood_and_never_sure() -> None:
    heard = hear(lambda _: answer({"text": "go home"}))
    assert (heard.understood, heard.sure) == (True, False)


def test_a_server_that_knows_no_verbose_answer_is_asked_simply_from_then_on() -> None:
    forms: list[str] = []

    def handler(request: httpx.Request) -> httpx.Response:
        verbose = b"verbose_json" in request.content
        forms.append("verbose" if verbose else "plain")
        if verbose:
            return answer({"error": "response_format"}, 400)
        return answer({"text": "go home", "logprobs": [{"logprob": -0.05}, {"logprob": -0.15}]})

    assert hear(handler, times=2).confidence == pytest.approx(math.exp(-0.1))
    assert forms == ["verbose", "plain", "plain"]


def test_silence_is_not_sent() -> None:
    asked: list[httpx.Request] = []

    def handler(request: httpx.Request) -> httpx.Response:
        asked.append(request)
        return answer({"text": "Thank you for watching!"})

    assert not hear(handler, Sound(16_000, 1, bytes(32_000))).understood
    offset = Sound(16_000, 1, struct.pack("<h", 3000) * 16_000)
    assert not hear(handler, offset).understood
    assert asked == []
    assert not is_silent(TONE)


@pytest.mark.parametrize(
    "body",
    [b"", b"\xff\xfe", b"[]", b"null", b'"go home"', b"{}", b'{"text": 7}', b'{"text": null}',
     b"[" * 50_000, b"<html>", b"go home"],
)  # fmt: skip
def test_what_is_no_transcription_is_a_failure(body: bytes) -> None:
    with pytest.raises(CallFailure):
        read_transcription(body)
    with pytest.raises(VoiceFailure) as failure:
        hear(lambda _: httpx.Response(200, stream=httpx.ByteStream(body)))
    assert failure.value.code == "transcription_bad_reply"


@pytest.mark.parametrize(
    ("status", "code"), [(401, "bad_key"), (404, "unknown_route"), (400, "bad_request"),
                         (503, "server_error"), (302, "redirect")],
)  # fmt: skip
def test_a_refusal_keeps_its_reason(status: int, code: str) -> None:
    with pytest.raises(VoiceFailure) as failure:
        hear(lambda _: answer({"error": "no"}, status))
    assert failure.value.code == f"transcription_{code}"


NUMBERS = st.one_of(st.none(), st.booleans(), st.text(max_size=3), st.floats(), st.integers())
ENTRIES = st.dictionaries(
    st.sampled_from(("avg_logprob", "no_speech_prob", "logprob")), NUMBERS, max_size=3
)
LISTS = st.one_of(NUMBERS, st.lists(st.one_of(NUMBERS, ENTRIES), max_size=4))


@given(st.fixed_dictionaries({}, optional={"segments": LISTS, "logprobs": LISTS}))
def test_no_figures_of_a_server_make_a_confidence_that_is_none(told: Json) -> None:
    assert 0.0 <= confidence_of(told) <= 1.0


@given(st.lists(st.tuples(st.floats(-20, 0), st.floats(0, 1)), min_size=1, max_size=4))
def test_more_doubt_is_never_more_confidence(pairs: list[tuple[float, float]]) -> None:
    told = confidence_of({"segments": segments(*pairs)})
    for worse in (
        segments(*[(log - 1.0, silent) for log, silent in pairs]),
        segments(*[(log, min(1.0, silent + 0.1)) for log, silent in pairs]),
    ):
        assert confidence_of({"segments": worse}) <= told


def test_nonsense_among_the_figures_is_no_confidence() -> None:
    for wrong in (float("nan"), float("inf"), 0.5, None, "x", True):
        told: Json = {"segments": [{"avg_logprob": -0.1}, {"avg_logprob": wrong}]}
        assert confidence_of(told) == 0.0


@given(st.text(max_size=5000))
def test_a_transcript_is_one_short_line_of_what_can_be_seen(text: str) -> None:
    line = clean(text)
    assert len(line) <= 500
    assert line == " ".join(line.split())
    assert clean(line) == line


def test_sound_leaves_this_machine_only_after_a_yes() -> None:
    away = VoiceSettings(url="https://voices.example/v1")
    with pytest.raises(ConfigError, match="voice_offhost"):
        open_caller(away)
    assert open_caller(VoiceSettings()) is None
    agreed = VoiceSettings(url="https://voices.example/v1", allow_offhost=True)
    assert open_caller(agreed) is not None
