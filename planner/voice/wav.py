"""Read a WAV's header and judge it before a sample is touched. Knows bytes; not words.

The standard library's `wave` believes a header's sizes and refuses by exceptions of many kinds;
here every number is compared with the bytes that came, and each refusal has its code. A size of
a chunk of samples that is open or too large is no refusal: who writes to a pipe can't know it.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

MAX_SECONDS = 15.0
MIN_SECONDS = 0.1
MAX_BYTES = 3_000_000
"""15 s of two channels at 48 kHz and 16 bits are 2.88 MB."""
MIN_RATE_HZ, MAX_RATE_HZ = 8_000, 48_000
MAX_CHUNKS = 64

_RIFF = struct.Struct("<4sI4s")
_CHUNK = struct.Struct("<4sI")
_FORMAT = struct.Struct("<HHIIHH")
_PCM, _EXTENSIBLE = 0x0001, 0xFFFE
_PCM_SUBFORMAT = bytes.fromhex("0100000000001000800000aa00389b71")
_FORMAT_SIZES = frozenset({16, 18, 40})
_FOREIGN = (
    (b"ID3", "MP3"),
    (b"\xff\xfb", "MP3"),
    (b"OggS", "Ogg"),
    (b"fLaC", "FLAC"),
    (b"\x1aE\xdf\xa3", "WebM or Matroska"),
    (b"FORM", "AIFF"),
    (b"RIFX", "big-endian WAV"),
    (b"RF64", "RF64"),
    (b".snd", "AU"),
)
_ENCODINGS = {2: "ADPCM", 3: "floating point", 6: "A-law", 7: "mu-law", 0x55: "MP3"}


class BadSound(Exception):
    """The recording can't be used; ``code`` is stable."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


@dataclass(frozen=True, slots=True)
class Sound:
    """Hold 16-bit little-endian samples, channels interleaved."""

    rate_hz: int
    channels: int
    pcm: bytes

    @property
    def seconds(self) -> float:
        """Return how long it lasts [s]."""
        return len(self.pcm) / (2 * self.channels * self.rate_hz)


def read_wav(data: bytes) -> Sound:
    """Return the samples of a WAV file whose every number has been checked.

    Raises:
        BadSound: ``audio_empty``, ``not_wav``, ``wav_truncated``, ``wav_malformed``,
            ``wav_unsupported``, ``audio_too_long``, ``audio_too_short``, ``body_too_large``.
    """
    _check_outside(data)
    shape: tuple[int, int] | None = None
    for kind, start, size in _chunks(data):
        if kind == b"fmt ":
            shape = _shape(data[start : start + size])
        elif kind == b"data":
            if shape is None:
                raise BadSound("wav_malformed", "the samples come before their format")
            return _sound(shape, data, start, size)
    missing = "samples" if shape else "format"
    raise BadSound("wav_malformed", f"there is no chunk of {missing}")


def _check_outside(data: bytes) -> None:
    if not data:
        raise BadSound("audio_empty", "0 bytes came; expected a WAV file")
    if len(data) > MAX_BYTES:
        raise BadSound("body_too_large", f"{len(data)} bytes came; at most {MAX_BYTES}")
    for mark, name in _FOREIGN:
        if data.startswith(mark):
            raise BadSound("not_wav", f"this is {name}; expected WAV with 16-bit PCM")
    if len(data) < _RIFF.size or data[:4] != b"RIFF" or data[8:12] != b"WAVE":
        raise BadSound("not_wav", f"begins with {data[:12]!r}; expected RIFF … WAVE")


def _chunks(data: bytes) -> Iterator[tuple[bytes, int, int]]:
    """Yield kind, first byte and size of each chunk.

    The file's own size is not read: who writes to a pipe does not know it, a recorder that lost
    power left that of an empty file, and taggers append to files without changing it.
    """
    at, found = _RIFF.size, 0
    while at + _CHUNK.size <= len(data):
        kind, size = _CHUNK.unpack_from(data, at)
        at += _CHUNK.size
        if kind == b"data" and (size == 0 or at + size > len(data)):
            size = len(data) - at  # written before it was known: to a pipe, or by who lost power
        if at + size > len(data):
            text = f"chunk {kind!r} speaks of {size} bytes, {len(data) - at} are left"
            raise BadSound("wav_truncated", text)
        found += 1
        if found > MAX_CHUNKS:
            raise BadSound("wav_malformed", f"more than {MAX_CHUNKS} chunks")
        yield kind, at, size
        at += size + size % 2
    if at < len(data):
        raise BadSound("wav_malformed", f"{len(data) - at} bytes at the end are no chunk")


def _shape(body: bytes) -> tuple[int, int]:
    """Return rate [Hz] and channels of a format chunk."""
    if len(body) not in _FORMAT_SIZES:
        text = f"a format chunk of {len(body)} bytes; expected 16, 18 or 40"
        raise BadSound("wav_malformed", text)
    encoding, channels, rate_hz, bytes_per_s, block, bits = _FORMAT.unpack_from(body)
    if encoding == _EXTENSIBLE and len(body) == 40 and body[24:40] == _PCM_SUBFORMAT:
        encoding = _PCM
    if encoding != _PCM:
        name = _ENCODINGS.get(encoding, f"encoding {encoding:#06x}")
        raise BadSound("wav_unsupported", f"{name}; expected 16-bit PCM")
    if bits != 16:
        raise BadSound("wav_unsupported", f"{bits} bits a sample; expected 16")
    if channels not in (1, 2):
        raise BadSound("wav_unsupported", f"{channels} channels; expected 1 or 2")
    if not MIN_RATE_HZ <= rate_hz <= MAX_RATE_HZ:
        text = f"{rate_hz} Hz; expected {MIN_RATE_HZ} to {MAX_RATE_HZ}"
        raise BadSound("wav_unsupported", text)
    if block != 2 * channels or bytes_per_s != block * rate_hz:
        text = f"{bytes_per_s} bytes/s in blocks of {block} do not fit {channels} × {rate_hz} Hz"
        raise BadSound("wav_malformed", text)
    return rate_hz, channels


def _sound(shape: tuple[int, int], data: bytes, start: int, size: int) -> Sound:
    rate_hz, channels = shape
    if start + size == len(data):
        size -= size % (2 * channels)  # cut in the middle of a block
    if size % (2 * channels):
        raise BadSound("wav_malformed", f"{size} bytes of samples are no whole blocks")
    seconds = size / (2 * channels * rate_hz)
    if seconds > MAX_SECONDS:
        raise BadSound("audio_too_long", f"{seconds:.1f} s; at most {MAX_SECONDS:g} s")
    if seconds < MIN_SECONDS:
        raise BadSound("audio_too_short", f"{seconds:.3f} s; at least {MIN_SECONDS:g} s")
    return Sound(rate_hz, channels, data[start : start + size])
