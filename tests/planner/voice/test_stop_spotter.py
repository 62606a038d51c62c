"""When the beginning of a piece of speech is looked at, and that what is looked at has a bound."""

from __future__ import annotations

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.voice import Recognition
from planner.voice.stop_spotter import FRAME_S, MOST_FRAMES, StopSpotter

RATE_HZ = 16_000
STOP = Recognition("stop", 0.9, understood=True)
FRAME_BYTES = int(2 * RATE_HZ * FRAME_S)


def sound(seconds: float, loudness: float) -> bytes:
    chance = np.random.default_rng(int(seconds * 1000 + loudness))
    heard = chance.normal(0.0, loudness, int(seconds * RATE_HZ)).clip(-32_768, 32_767)
    return bytes(heard.astype("<i2").tobytes())


def looks(*parts: tuple[float, float], step_s: float = 0.05) -> list[float]:
    """Return the length of each piece that is looked at [s], in a sound of (seconds, loudness)."""
    found: list[float] = []

    def spot(pcm: bytes) -> None:
        found.append(len(pcm) / 2 / RATE_HZ)

    spotter = StopSpotter(RATE_HZ, 1, spot)
    whole = b"".join(sound(*part) for part in parts)
    step = int(step_s * RATE_HZ) * 2
    for start in range(0, len(whole), step):
        assert spotter.take(whole[start : start + step]) is None
    return found


def test_silence_and_a_click_are_not_looked_at() -> None:
    assert looks((3.0, 0.0)) == []
    assert looks((1.0, 20.0), (0.06, 8_000.0), (1.0, 20.0)) == []


def test_a_word_is_looked_at_while_it_is_spoken_and_in_the_pause_behind_it() -> None:
    found = looks((0.4, 30.0), (0.5, 5_000.0), (2.0, 30.0))
    assert 5 <= len(found) <= 9
    assert found[0] <= 0.4 + 0.3
    assert max(found) <= 0.4 + 0.5 + 0.4


def test_each_pause_begins_a_new_piece() -> None:
    word, pause = (0.4, 5_000.0), (0.6, 30.0)
    found = looks((0.5, 30.0), word, pause, word, pause, word, pause)
    starts = [b for a, b in itertools.pairwise(found) if b < a]
    assert len(starts) == 2
    assert all(length < 0.5 for length in starts)  # the words before are in no later piece


def test_long_speech_is_looked_at_in_its_beginning_alone() -> None:
    found = looks((0.2, 30.0), (10.0, 5_000.0))
    assert found
    assert max(found) <= MOST_FRAMES * FRAME_S + 1e-9


def test_a_stop_is_returned_as_soon_as_it_is_spotted() -> None:
    spotter = StopSpotter(RATE_HZ, 1, lambda _: STOP)
    assert spotter.take(sound(0.1, 5_000.0)) is None
    assert spotter.take(sound(0.2, 5_000.0)) == STOP


def test_a_word_that_comes_late_and_at_once_with_what_follows_is_looked_at() -> None:
    """A process that starts takes seconds, and all that was said meanwhile comes in one piece."""
    parts = ((0.5, 30.0), (0.5, 5_000.0), (3.0, 30.0), (0.4, 5_000.0), (2.0, 30.0))
    found = looks(*parts, step_s=9.0)
    assert len(found) == 2
    assert all(0.4 <= length <= 1.5 for length in found)


@given(
    st.lists(st.binary(max_size=5_000), max_size=30),
    st.sampled_from([(8_000, 1), (16_000, 1), (44_100, 2), (48_000, 1)]),
)
@settings(max_examples=40)
def test_any_bytes_are_taken_and_each_look_has_whole_frames_and_a_bound(
    pieces: list[bytes], shape: tuple[int, int]
) -> None:
    rate_hz, channels = shape
    seen: list[int] = []

    def spot(pcm: bytes) -> None:
        seen.append(len(pcm))

    spotter = StopSpotter(rate_hz, channels, spot)
    for piece in pieces:
        spotter.take(piece)
    frame_bytes = 2 * channels * round(FRAME_S * rate_hz)
    assert all(size % frame_bytes == 0 and size <= (MOST_FRAMES + 1) * frame_bytes for size in seen)
