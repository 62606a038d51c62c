"""Write messages of one MCAP file into another, with its own schemas and channels.

Nobody reads it before it is closed, so its chunks are large and packed hard.
"""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING

from mcap.writer import CompressionType, Writer

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from bridge.recording.mcap_reader import Raw
    from bridge.recording.topics import RecordedTopic

CHUNK_BYTES = 4 << 20
LIBRARY = "pons"


class McapCopy:
    """Hold one file that is being written."""

    def __init__(self, path: Path, topics: Iterable[tuple[str, RecordedTopic]]) -> None:
        self._path = path
        self._file = path.open("xb")
        self._writer = Writer(self._file, CHUNK_BYTES, compression=CompressionType.ZSTD)
        self._writer.start(profile="", library=LIBRARY)
        self._channels: dict[str, int] = {}
        for name, topic in topics:
            schema = self._writer.register_schema(
                topic.schema, topic.schema_encoding, topic.schema_data
            )
            self._channels[name] = self._writer.register_channel(name, topic.encoding, schema)

    def add(self, raw: Raw) -> None:
        """Add a message as it was."""
        self._writer.add_message(
            self._channels[raw.topic], raw.at_ns, raw.data, raw.at_ns, raw.sequence
        )

    def close(self) -> None:
        """End the file and bring it to the disk."""
        self._writer.finish()  # type: ignore[no-untyped-call]  # mcap leaves it untyped
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()

    def abandon(self) -> None:
        """Leave nothing behind."""
        with suppress(OSError):
            self._file.close()
        with suppress(OSError):
            self._path.unlink()
