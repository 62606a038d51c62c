"""What a recording must be, checked before a sample is read."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.voice import MAX_BYTES, BadSound, read_wav
from tests.planner.voice.speech import AUDIO, needs_clips, wav

SECOND = bytes(32_000)


def code_of(data: bytes) -> str:
    with pytest.raises(BadSound) as bad:
        read_wav(data)
    assert bad.value.detail
    return bad.value.code


def patched(data: bytes, at: int, form: str, value: int) -> bytes:
    return data[:at] + struct.pack(form, value) + data[at + struct.calcsize(form) :]


@pytest.mark.parametrize("rate_hz", [8_000, 16_000, 22_050, 44_100, 48_000])
@pytest.mark.parametrize("channels", [1, 2])
def test_a_good_recording_is_read_whole(rate_hz: int, channels: int) -> None:
    pcm = bytes(range(256)) * 100
    sound = read_wav(wav(pcm, rate_hz, channels))
    assert (sound.rate_hz, sound.channels, sound.pcm) == (rate_hz, channels, pcm)
    assert sound.seconds == pytest.approx(len(pcm) / 2 / channels / rate_hz)


def test_chunks_of_others_are_passed_over() -> None:
    data = wav(SECOND)
    note = b"LIST" + struct.pack("<I", 3) + b"abc\0"
    longer = patched(data[:12] + note + data[12:], 4, "<I", len(data) + len(note) - 8)
    assert read_wav(longer).pcm == SECOND


@pytest.mark.parametrize("size", [0, 0xFFFFFFFF, 0x80000000, 32_016, 31_999 + 5])
@pytest.mark.parametrize("riff", [0, 36, 0xFFFFFFFF, 0x80000024, 32_036, 32_052])
def test_a_length_that_was_unknown_is_that_of_the_bytes_that_came(size: int, riff: int) -> None:
    data = patched(patched(wav(SECOND), 4, "<I", riff), 40, "<I", size)
    assert read_wav(data).pcm == SECOND
    assert read_wav(data[:-1]).pcm == SECOND[:-2], "cut within a sample"
    if size in {0, 0xFFFFFFFF, 0x80000000}:
        assert code_of(data + bytes(16 * 32_000)) == "audio_too_long"


@pytest.mark.parametrize("tag", [b"xx", b"TAG" + bytes(125), b"id3 \xff\xff\xff\xff", bytes(9)])
def test_what_stands_behind_the_samples_is_not_read(tag: bytes) -> None:
    assert read_wav(wav(SECOND) + tag).pcm == SECOND


def test_extensible_pcm_is_pcm() -> None:
    guid = bytes.fromhex("0100000000001000800000aa00389b71")
    body = struct.pack("<HHIIHHHHI", 0xFFFE, 1, 16_000, 32_000, 2, 16, 22, 16, 4) + guid
    chunks = b"fmt " + struct.pack("<I", 40) + body + b"data" + struct.pack("<I", 32_000) + SECOND
    data = b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks
    assert read_wav(data).seconds == 1.0


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"", "audio_empty"),
        (b"hello", "not_wav"),
        (b"ID3\x04" + bytes(100), "not_wav"),
        (b"OggS" + bytes(100), "not_wav"),
        (b"fLaC" + bytes(100), "not_wav"),
        (b"\x1aE\xdf\xa3" + bytes(100), "not_wav"),
        (b"<!doctype html>", "not_wav"),
        (wav(SECOND)[:44], "audio_too_short"),
        (wav(SECOND)[:20], "wav_truncated"),
        (wav(b""), "audio_too_short"),
        (wav(bytes(2 * 1_599)), "audio_too_short"),
        (wav(bytes(2 * 8_000 * 16), 8_000), "audio_too_long"),
        (wav(SECOND, width=1), "wav_unsupported"),
        (wav(SECOND, 8_000, 1, 4), "wav_unsupported"),
        (wav(SECOND[:31_998], width=3), "wav_unsupported"),
        (wav(SECOND, channels=4), "wav_unsupported"),
        (wav(SECOND, 7_999), "wav_unsupported"),
        (wav(SECOND, 96_000), "wav_unsupported"),
        (patched(wav(SECOND), 20, "<H", 3), "wav_unsupported"),
        (patched(wav(SECOND), 20, "<H", 0x55), "wav_unsupported"),
        (patched(wav(SECOND), 24, "<I", 0), "wav_unsupported"),
        (patched(wav(SECOND), 28, "<I", 5), "wav_malformed"),
        (patched(wav(SECOND), 32, "<H", 0), "wav_malformed"),
        (patched(wav(SECOND), 16, "<I", 0x66666666), "wav_truncated"),
        (patched(wav(SECOND), 40, "<I", 31_999), "wav_malformed"),
        (b"RIFF\x04\x00\x00\x00WAVE", "wav_malformed"),
        (wav(SECOND).replace(b"fmt ", b"junk"), "wav_malformed"),
        (bytes(MAX_BYTES + 1), "body_too_large"),
    ],
)
def test_what_is_no_such_recording_is_refused_by_name(data: bytes, code: str) -> None:
    assert code_of(data) == code


def test_endless_chunks_end() -> None:
    chunks = (b"junk" + struct.pack("<I", 0)) * 1_000
    data = b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks
    assert code_of(data) == "wav_malformed"


@needs_clips
def test_every_malformed_file_from_outside_is_refused() -> None:
    files = sorted((AUDIO / "malformed").iterdir())
    assert files
    for path in files:
        assert code_of(path.read_bytes()) in {
            "audio_empty",
            "audio_too_short",
            "wav_malformed",
            "wav_truncated",
            "wav_unsupported",
        }


@given(at=st.integers(0, 43), value=st.integers(0, 255), cut=st.integers(0, 400), tail=st.binary())
@settings(max_examples=150)
def test_no_header_makes_anything_else_happen(at: int, value: int, cut: int, tail: bytes) -> None:
    data = bytearray(wav(bytes(3_300)))
    data[at] = value
    try:
        sound = read_wav(bytes(data[: len(data) - cut]) + tail)
    except BadSound:
        return
    assert 0.1 <= sound.seconds <= 15.0
