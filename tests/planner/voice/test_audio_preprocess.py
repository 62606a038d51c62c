"""How samples are prepared: one rate, one channel, the same each time."""

from __future__ import annotations

import numpy as np
import pytest

from planner.voice.audio_preprocess import FRAME, RATE_HZ, SILENT_PEAK, prepare, quiet, resample


@pytest.mark.parametrize("rate_hz", [8_000, 11_025, 22_050, 44_100, 48_000])
def test_a_tone_keeps_its_height(rate_hz: int) -> None:
    time_s = np.arange(rate_hz) / rate_hz
    heard = resample(np.sin(2 * np.pi * 440.0 * time_s), rate_hz)
    assert len(heard) == RATE_HZ
    assert int(np.argmax(np.abs(np.fft.rfft(heard)))) == 440
    assert np.abs(heard).max() == pytest.approx(1.0, abs=0.01)


def test_what_16_khz_cant_carry_is_taken_out() -> None:
    time_s = np.arange(48_000) / 48_000
    assert np.abs(resample(np.sin(2 * np.pi * 15_000.0 * time_s), 48_000)).max() < 0.01


def test_two_channels_become_one_and_quiet_becomes_loud() -> None:
    left = (1_000 * np.sin(np.arange(16_000) / 10)).astype("<i2")
    both = np.stack([left, left], axis=1).tobytes()
    assert prepare(both, RATE_HZ, 2) == prepare(left.tobytes(), RATE_HZ, 1)
    samples = np.frombuffer(prepare(left.tobytes(), RATE_HZ, 1) or b"", "<i2")
    assert 19_000 < np.abs(samples).max() < 21_000


def test_silence_is_not_made_loud() -> None:
    quiet = np.full(16_000, 30_000, "<i2")  # a constant is no sound
    assert prepare(quiet.tobytes(), RATE_HZ, 1) is None
    below = ((SILENT_PEAK - 2) * np.sin(np.arange(16_000) / 10)).astype("<i2")
    assert prepare(below.tobytes(), RATE_HZ, 1) is None


def test_silence_at_the_ends_is_cut_and_what_is_quiet_between_is_known() -> None:
    tone = (9_000 * np.sin(np.arange(16_000) / 10)).astype("<i2").tobytes()
    short = prepare(tone + bytes(16_000) + tone, RATE_HZ, 1) or b""
    assert prepare(bytes(32_000) + tone + bytes(16_000) + tone + bytes(64_000), RATE_HZ, 1)
    long = prepare(bytes(32_000) + tone + bytes(16_000) + tone + bytes(64_000), RATE_HZ, 1) or b""
    assert 0 <= len(long) - len(short) <= 2 * 2 * 0.1 * RATE_HZ
    assert quiet(short, 16_000 // FRAME, 8_000 // FRAME)
    assert not quiet(short, 0, 50)
    assert not quiet(short, 90, 30)
