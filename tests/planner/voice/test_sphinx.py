"""The built-in recogniser on synthetic and recorded speech: what it hears, and what it must not."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

import psutil
import pytest

from planner.language.yes_no import consents
from planner.voice import read_wav
from planner.voice.grammar import is_called_stop, is_stop
from planner.voice.recogniser import Recognition
from tests.planner.voice.speech import AUDIO, needs_clips, needs_espeak, speak, wav

pytest.importorskip("pocketsphinx", reason="pocketsphinx has no wheel for this Python")

if TYPE_CHECKING:
    from planner.voice.sphinx import Sphinx

pytestmark = pytest.mark.nightly(keep=20)


NAMES = ("kitchen", "living room", "sofa", "charging dock", "study", "zzyzxq", "hall 9")


@pytest.fixture(scope="module")
def ears() -> Sphinx:
    from planner.voice.sphinx import Sphinx

    return Sphinx(NAMES)


def hear(ears: Sphinx, data: bytes, *, awaits_answer: bool = False) -> Recognition:
    sound = read_wav(data)
    heard = ears.hear(sound.pcm, sound.rate_hz, sound.channels, awaits_answer=awaits_answer)
    assert isinstance(heard, Recognition)
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
    assert hear(ears, recording) == heard


@needs_espeak
def test_an_order_of_the_owners_is_heard_and_no_other_sentence_for_it(ears: Sphinx) -> None:
    taught = type(ears)(NAMES, ("do the evening round", "do the evening round and end in _"))
    for text in ("do the evening round", "do the evening round and end in the kitchen"):
        heard = hear(taught, speak(text, "en-us"))
        assert (heard.transcript, heard.understood) == (text, True)
        assert hear(ears, speak(text, "en-us")).transcript != text
    for text in ("what a nice evening it is", "we are going out this evening"):
        assert not hear(taught, speak(text, "en-us")).understood, text
    for text in ("go to the kitchen", "stop"):
        assert hear(taught, speak(text, "en-us")).transcript == text


@needs_espeak
def test_one_sound_never_changes_the_next(ears: Sphinx) -> None:
    """A decoder adapts to what it hears; a doubtful clip is the first to come out otherwise."""
    clips = [speak(text, "en-us") for text in ("what a nice day it is", "go to the kitchen")]
    first = [hear(ears, clip) for clip in clips]
    for number in range(4):
        hear(ears, speak(f"{number} go to the sofa" if number % 2 else "stop", "en-gb+f2"))
        hear(ears, wav(random.Random(number).randbytes(20_000)))
    assert [hear(ears, clip) for clip in clips] == first
    fresh = type(ears)(NAMES)
    assert [hear(fresh, clip) for clip in reversed(clips)] == first[::-1]


@needs_espeak
def test_the_sounds_of_a_recording_are_searched_once_and_none_are_kept(ears: Sphinx) -> None:
    """Judged three times here: as an order, as another stop, as an answer."""

    class Counting(type(ears)):  # type: ignore[misc]  # imported only where there is a wheel
        searched = 0

        def _phones(self, samples: bytes) -> object:
            self.searched += 1
            return super()._phones(samples)

    counting = Counting(NAMES)
    clip = speak("no please don't", "en-us")
    for times in (1, 2):
        assert hear(counting, clip, awaits_answer=True) == hear(ears, clip, awaits_answer=True)
        assert counting.searched == times


def test_hearing_leaves_no_process_and_no_pipe(ears: Sphinx) -> None:
    us = psutil.Process()
    noise = random.Random(1).randbytes(64_000)
    ears.hear(noise, 16_000, 1)
    before = us.num_fds(), len(us.children())
    for _ in range(3):
        ears.hear(noise, 16_000, 1)
    assert (us.num_fds(), len(us.children())) == before


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
        "not the kitchen",
        "is the kitchen clean",
        "put the book on the sofa",
        "we should go to the cinema",
    ],
)
@pytest.mark.parametrize("voice", ["en-us", "en-gb+f2"])
def test_other_sentences_move_nothing(ears: Sphinx, text: str, voice: str) -> None:
    assert not hear(ears, speak(text, voice)).sure


@needs_espeak
@pytest.mark.parametrize("text", ["yes please", "please do", "no please don't"])
@pytest.mark.parametrize("voice", ["en-us", "en-gb-x-rp"])
def test_a_yes_or_no_is_heard_only_where_a_question_waits(
    ears: Sphinx, text: str, voice: str
) -> None:
    recording = speak(text, voice)
    heard = hear(ears, recording, awaits_answer=True)
    assert (heard.transcript, heard.sure) == (text, True)
    assert hear(ears, recording).transcript != text


@needs_espeak
@pytest.mark.parametrize(
    "text",
    [
        *("go to the kitchen", "stop", "what a nice day it is", "yes it is cold today"),
        *("please do not go there", "go ahead without me and tell her", "no I said the sofa"),
        *("please go to the sofa", "sure it is not broken", "are you sure", "I do not know yet"),
    ],
)
@pytest.mark.parametrize("voice", ["en-us", "en-gb+f2"])
def test_other_sentences_answer_no_question(ears: Sphinx, text: str, voice: str) -> None:
    recording = speak(text, voice)
    asked = hear(ears, recording, awaits_answer=True)
    assert consents(asked.transcript) is None
    assert asked == hear(ears, recording)


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
    assert ears.hear(pcm, 16_000, 1) == Recognition("", 0.0, understood=False)


def test_the_shortest_noise_is_nothing(ears: Sphinx) -> None:
    assert not ears.hear(bytes(range(256)) * 13, 16_000, 1).understood


def heard_early(ears: Sphinx, data: bytes) -> tuple[float, str] | None:
    """Return when a stop is heard in a recording that grows, and which [s]."""
    sound = read_wav(data)
    listener = ears.listener(sound.rate_hz, sound.channels)
    pcm = sound.pcm + bytes(2 * sound.rate_hz)
    step = 2 * (sound.rate_hz // 10)
    for start in range(0, len(pcm), step):
        heard = listener.take(pcm[start : start + step])
        if heard is not None and heard.understood:
            return (start + step) / 2 / sound.rate_hz, heard.transcript
    return None


@needs_espeak
@pytest.mark.parametrize("text", ["stop", "please stop", "stop right there", "hey robot stop"])
@pytest.mark.parametrize("voice", ["en-us", "en-us+f3"])
def test_a_stop_is_heard_while_the_recording_goes_on(ears: Sphinx, text: str, voice: str) -> None:
    recording = speak(text, voice)
    early = heard_early(ears, recording)
    assert early is not None
    assert is_stop(early[1]) or is_called_stop(early[1])
    assert early[0] <= read_wav(recording).seconds + 0.4


@needs_espeak
@pytest.mark.parametrize("text", ["go to the kitchen", "return home", "I like the sofa very much"])
def test_other_words_are_no_early_stop(ears: Sphinx, text: str) -> None:
    assert heard_early(ears, speak(text, "en-us+f3")) is None


def test_silence_is_no_early_stop(ears: Sphinx) -> None:
    assert heard_early(ears, wav(bytes(64_000))) is None
    assert ears.spot_stop(bytes(3_200), 16_000, 1) is None
