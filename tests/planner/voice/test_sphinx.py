"""The built-in recogniser on synthetic and recorded speech: what it hears, and what it must not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.voice import read_wav
from planner.voice.protocol import Heard
from tests.planner.voice.speech import AUDIO, needs_clips, needs_espeak, speak

pytest.importorskip("pocketsphinx", reason="pocketsphinx has no wheel for this Python")

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx

NAMES = ("kitchen", "living room", "sofa", "charging dock", "study", "zzyzxq", "hall 9")


@pytest.fixture
def ears() -> Sphinx:
    from planner.voice.sphinx import Sphinx

    return Sphinx(NAMES)


def hear(ears: Sphinx, data: bytes) -> Heard:
    sound = read_wav(data)
    heard = ears.hear(sound.pcm, sound.rate_hz, sound.channels)
    assert isinstance(heard, Heard)
    return heard


def test_words_without_a_pronunciation_are_left_out(ears: Sphinx) -> None:
    assert ears.language.left_out == ("zzyzxq", "hall 9")


@needs_espeak
@pytest.mark.parametrize("text", ["go to the kitchen", "go to the living room", "come back"])
@pytest.mark.parametrize("voice", ["en-us", "en-us+f3"])
def test_clean_orders_are_heard(ears: Sphinx, text: str, voice: str) -> None:
    recording = speak(text, voice)
    heard = hear(ears, recording)
    assert (heard.transcript, heard.understood) == (text, True)
    assert heard.confidence >= 0.5
    again = hear(ears, recording)
    assert (again.transcript, again.understood) == (text, True)
    assert again.confidence == pytest.approx(heard.confidence, abs=0.05)


@needs_espeak
@pytest.mark.parametrize(
    "text",
    [
        "do not go to the kitchen",
        "open the study",
        "what a nice day it is",
        "I like the living room",
        "go to the basement",
        "bring me a cup of tea",
        "the kitchen is very clean",
    ],
)
@pytest.mark.parametrize("voice", ["en-us", "en-gb+f2"])
def test_other_sentences_move_nothing(ears: Sphinx, text: str, voice: str) -> None:
    assert not hear(ears, speak(text, voice)).understood


@needs_clips
def test_recorded_people_who_order_nothing_move_nothing(ears: Sphinx) -> None:
    clips = sorted((AUDIO / "pocketsphinx").glob("*.raw"))
    clips += sorted((AUDIO / "pocketsphinx").glob("*.wav"))
    assert clips
    for clip in clips:
        data = clip.read_bytes()
        pcm = data[44:] if clip.suffix == ".wav" else data
        heard = ears.hear(pcm[: len(pcm) // 2 * 2], 16_000, 1)
        assert not heard.understood or heard.transcript.startswith("stop"), (clip.name, heard)


@pytest.mark.parametrize("pcm", [bytes(32_000), b"\x01\x00" * 16_000, b"\xff\x7f" * 16_000])
def test_silence_is_nothing(ears: Sphinx, pcm: bytes) -> None:
    assert ears.hear(pcm, 16_000, 1) == Heard("", 0.0, understood=False)


def test_the_shortest_noise_is_nothing(ears: Sphinx) -> None:
    assert not ears.hear(bytes(range(256)) * 13, 16_000, 1).understood
