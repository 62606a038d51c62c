"""Read an MCAP file's messages, however its writer ended.

A file whose writer was killed, or whose host lost its power, has no footer and may end in half a
record: it is read up to there. A file that was closed and is damaged is refused by name. Reads what
mcap_file writes; layout: https://mcap.dev/spec.
"""

from __future__ import annotations

import fcntl
import os
import struct
import zlib
from dataclasses import dataclass
from typing import IO, TYPE_CHECKING

import zstandard

from bridge.recording.topics import RecordedTopic

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
_GZIP = b"\x1f\x8b"
_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _MESSAGE_INDEX = 0x02, 0x03, 0x04, 0x05, 0x06, 0x07
_LAST_OPCODE = 0x0F
MOST_BYTES = 256 << 20
"""Of one chunk, unpacked: half a second of ticks is 50 kB."""
_RECORD = struct.Struct("<BQ")
_CHUNK_HEAD = struct.Struct("<QQQI")
_MESSAGE_HEAD = struct.Struct("<HIQQ")


class BadRecording(Exception):
    """Name by stable code why a recording can't be read."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code = code
        self.detail = detail


@dataclass(frozen=True, slots=True)
class Raw:
    """Hold one message as it stands in the file."""

    topic: str
    sequence: int
    at_ns: int
    data: bytes


@dataclass(slots=True)
class Chunk:
    """Hold a chunk's place and, by its index, its topics."""

    at: int
    size: int
    topics: set[str]


class McapReader:
    """Read one MCAP file chunk by chunk."""

    def __init__(self, path: Path) -> None:
        """Find the chunks.

        Raises:
            BadRecording: no such file, not MCAP, or closed and damaged.
        """
        self.path = path
        self.chunks: list[Chunk] = []
        self.complete = False
        """The file was closed by its writer."""
        self.growing = False
        """Its writer was still at it when this was opened."""
        self._topic_of: dict[int, str] = {}
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        self._channels: dict[str, tuple[int, str]] = {}
        try:
            self._file = path.open("rb")
        except OSError as error:
            raise BadRecording("recording_missing", f"{path}: {error.strerror}") from None
        try:
            self._find()
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> McapReader:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def messages(self) -> Iterator[Raw]:
        """Yield all messages in order.

        Raises:
            BadRecording: a chunk that is not the last of a file cut short is damaged.
        """
        for chunk in self.chunks:
            yield from self.read(chunk)

    def definitions(self) -> list[tuple[str, RecordedTopic]]:
        """Return each topic with its schema, as the file's first chunk defines them."""
        if self.chunks:
            self.read(self.chunks[0])
        return [
            (topic, RecordedTopic(*self._schemas[schema], encoding))
            for topic, (schema, encoding) in self._channels.items()
            if schema in self._schemas
        ]

    def span_ns(self, chunk: Chunk) -> tuple[int, int]:
        """Return when a chunk's first and last message were logged, without unpacking it."""
        self._file.seek(chunk.at)
        begin_ns, end_ns, _, _ = _CHUNK_HEAD.unpack(self._file.read(_CHUNK_HEAD.size))
        return begin_ns, end_ns

    def read(self, chunk: Chunk) -> list[Raw]:
        """Return one chunk's messages; none where the file was cut short in it.

        Raises:
            BadRecording: it is damaged, and no cut explains it.
        """
        try:
            return list(self._messages(self._unpack(chunk)))
        except (ValueError, struct.error, zstandard.ZstdError) as error:
            if chunk is self.chunks[-1] and not self.complete:
                return []
            text = f"{self.path}, byte {chunk.at}: {error}"
            raise BadRecording("recording_damaged", text) from None

    def _find(self) -> None:
        file = self._file
        self.growing = _is_locked(file)
        size = os.fstat(file.fileno()).st_size
        magic = file.read(len(MAGIC))
        if magic[:2] == _GZIP:
            raise BadRecording(
                "recording_of_old_format",
                f"{self.path} was written before recordings were MCAP; replay it with the version "
                "of Pons that recorded it (git log -- bridge/recording)",
            )
        if magic != MAGIC and MAGIC.startswith(magic):
            return  # its writer was killed in its first moment
        if magic != MAGIC:
            raise BadRecording("recording_not_mcap", f"{self.path} does not begin as MCAP does")
        for opcode, at, length in _records(file, size):
            if opcode == _CHUNK:
                self.chunks.append(Chunk(at, length, set()))
                if not self._topic_of:
                    self.read(self.chunks[0])  # topics are named in the first
            elif opcode == _MESSAGE_INDEX and self.chunks:
                (channel,) = struct.unpack("<H", file.read(2))
                self.chunks[-1].topics.add(self._topic_of.get(channel, ""))
            elif opcode == _FOOTER:
                self.complete = True
        if not self.complete and size >= 2 * len(MAGIC):
            file.seek(-len(MAGIC), os.SEEK_END)
            if file.read(len(MAGIC)) == MAGIC:
                text = f"{self.path} was closed, yet holds what no record is"
                raise BadRecording("recording_damaged", text)

    def _unpack(self, chunk: Chunk) -> bytes:
        if chunk.size > MOST_BYTES:
            raise ValueError(f"a chunk of {chunk.size} bytes, packed")
        self._file.seek(chunk.at)
        body = self._file.read(chunk.size)
        _, _, size, crc = _CHUNK_HEAD.unpack_from(body)
        compression, at = _text(body, _CHUNK_HEAD.size)
        packed = body[at + 8 :]
        if size > MOST_BYTES or compression not in {"", "zstd"}:
            raise ValueError(f"a chunk of {size} bytes in {compression!r}")
        data = _decompress(packed, size) if compression else packed
        if len(data) != size or (crc and zlib.crc32(data) != crc):
            raise ValueError("its checksum does not fit")
        return data

    def _messages(self, data: bytes) -> Iterator[Raw]:
        at = 0
        while at < len(data):
            opcode, length = _RECORD.unpack_from(data, at)
            at += _RECORD.size
            end = at + length
            if end > len(data):
                raise ValueError("a record longer than its chunk")
            if opcode == _MESSAGE:
                channel, sequence, at_ns, _ = _MESSAGE_HEAD.unpack_from(data, at)
                start = at + _MESSAGE_HEAD.size
                yield Raw(self._topic_of.get(channel, ""), sequence, at_ns, data[start:end])
            elif opcode == _CHANNEL:
                channel, schema = struct.unpack_from("<HH", data, at)
                topic, after = _text(data, at + 4)
                self._topic_of[channel] = topic
                self._channels[topic] = schema, _text(data, after)[0]
            elif opcode == _SCHEMA:
                (schema,) = struct.unpack_from("<H", data, at)
                name, after = _text(data, at + 2)
                encoding, after = _text(data, after)
                self._schemas[schema] = name, encoding, data[after + 4 : end]
            at = end


def _decompress(packed: bytes, size: int) -> bytes:
    """Unpack one zstd frame; the library believes the frame's own size before ours."""
    said = zstandard.frame_content_size(packed)
    if said not in {-1, size}:  # -1: it does not say
        raise ValueError(f"a frame of {said} bytes in a chunk of {size}")
    return zstandard.decompress(packed, max_output_size=size)


def _records(file: IO[bytes], size: int) -> Iterator[tuple[int, int, int]]:
    """Yield opcode, place and length of each record that is whole, up to the footer."""
    at = len(MAGIC)
    while at + _RECORD.size <= size:
        file.seek(at)
        opcode, length = _RECORD.unpack(file.read(_RECORD.size))
        at += _RECORD.size
        if not 0 < opcode <= _LAST_OPCODE or length > size - at:
            return  # cut short, or zeros that a power loss left
        yield opcode, at, length
        if opcode == _FOOTER:
            return
        at += length


def _is_locked(file: IO[bytes]) -> bool:
    """Return whether a process holds the lock that a writer takes (mcap_file)."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False  # no locks here
    fcntl.flock(file, fcntl.LOCK_UN)
    return False


def _text(data: bytes, at: int) -> tuple[str, int]:
    (length,) = struct.unpack_from("<I", data, at)
    end = at + 4 + length
    return data[at + 4 : end].decode(), end
