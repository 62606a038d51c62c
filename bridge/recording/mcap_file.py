"""Write one MCAP file so that it can be read up to its last flush, however its writer ends.

Owns the file's bytes: a chunk is whole or, after a failed write, cut off again. A file that is
closed carries an index; one that was not is read from its beginning (mcap_reader). While it is
being written it is locked, so that a reader can tell that from a writer that was killed.
"""

from __future__ import annotations

import fcntl
import os
from contextlib import suppress
from typing import IO, TYPE_CHECKING, cast

from mcap.writer import CompressionType, Writer

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from bridge.recording.topics import RecordedTopic

CHUNK_BYTES = 16 << 20
"""Never reached: chunks end when they are flushed, between two ticks."""
LIBRARY = "pons"


class McapFile:
    """Write one MCAP file. Every method may raise OSError; then only ``abandon`` is left."""

    def __init__(self, path: Path, topics: Mapping[str, RecordedTopic]) -> None:
        self.path = path
        self._sink = _Sink(path)
        self._writer = Writer(
            cast("IO[bytes]", self._sink), CHUNK_BYTES, compression=CompressionType.ZSTD
        )
        self._channels: dict[str, int] = {}
        self._good_bytes = 0
        try:
            self._writer.start(profile="", library=LIBRARY)
            for name, topic in topics.items():
                schema = self._writer.register_schema(
                    topic.schema, topic.schema_encoding, topic.schema_data
                )
                self._channels[name] = self._writer.register_channel(name, topic.encoding, schema)
            self._good_bytes = self._sink.tell()
            _sync_folder(path.parent)
        except OSError:
            self.abandon()
            path.unlink(missing_ok=True)
            raise

    @property
    def size_bytes(self) -> int:
        """Return the file's size, without the messages that wait for a flush."""
        return self._sink.tell()

    def add(self, topic: str, at_ns: int, sequence: int, data: bytes) -> None:
        """Add a message; it is in memory until the next flush."""
        self._writer.add_message(self._channels[topic], at_ns, data, at_ns, sequence)

    def flush(self) -> None:
        """Write all messages so far, so that a reader finds them even if this process is killed."""
        self._writer.flush()  # type: ignore[no-untyped-call]  # mcap leaves it untyped
        self._good_bytes = self._sink.tell()

    def sync(self) -> None:
        """Bring the flushed bytes to the disk itself, for the power may fail."""
        self._sink.sync()

    def close(self) -> None:
        """End the file with its index."""
        self._writer.finish()  # type: ignore[no-untyped-call]  # mcap leaves it untyped
        self._good_bytes = self._sink.tell()
        self._sink.sync()
        self._sink.close()

    def abandon(self) -> None:
        """Leave the file with its whole chunks. Never raises: the disk has failed already."""
        self._sink.leave(self._good_bytes)


class _Sink:
    """Pass every byte of mcap's writer to the system at once, or raise."""

    def __init__(self, path: Path) -> None:
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
        self._fd = os.open(path, flags, 0o640)
        self._at = 0
        with suppress(OSError):  # a file system without locks: readers take it for cut short
            fcntl.flock(self._fd, fcntl.LOCK_SH | fcntl.LOCK_NB)

    def write(self, data: bytes) -> int:
        left = memoryview(data)
        while left:
            done = os.write(self._fd, left)
            self._at += done
            left = left[done:]
        return len(data)

    def tell(self) -> int:
        return self._at

    def flush(self) -> None:
        """Nothing is held back."""

    def sync(self) -> None:
        _to_disk(self._fd)

    def close(self) -> None:
        fd, self._fd = self._fd, -1
        os.close(fd)

    def leave(self, good_bytes: int) -> None:
        if self._fd >= 0:
            with suppress(OSError):
                os.ftruncate(self._fd, good_bytes)
            with suppress(OSError):
                self.close()


_to_disk = getattr(os, "fdatasync", os.fsync)  # macOS has no fdatasync


def _sync_folder(folder: Path) -> None:
    """Make the new name survive a power loss, where the file system can."""
    fd = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)
