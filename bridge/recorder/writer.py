"""Write recorded lines to disk. A process of its own, run as a script: standard library only.

It owns the files and their sizes and knows one thing about a line: that one which begins a segment
(``HEADER``) may begin a file. It ends when the pipe ends, however the bridge died, and then writes
what was still in the pipe; that is why it asks for no death signal and ignores Ctrl-C. Everything
is flushed every second: a reader loses at most that of a recording whose writer was killed.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import time
import zlib
from pathlib import Path

HEADER = b'{"kind":"header"'
SUFFIX = ".jsonl.gz"
FLUSH_S = 1.0
NICE = 10
_GZIP = 31  # zlib's name for: deflate in a gzip member
_CHUNK = 1 << 16


class RecordingFile:
    """Be one gzip file of lines, readable up to its last flush even when never closed."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = path.open("xb")
        self._deflate = zlib.compressobj(1, zlib.DEFLATED, _GZIP)
        self.size_bytes = 0

    def write(self, data: bytes) -> None:
        self._put(self._deflate.compress(data))

    def flush(self) -> None:
        """Put what came so far within reach of a reader."""
        self._put(self._deflate.flush(zlib.Z_SYNC_FLUSH))
        self._file.flush()

    def close(self) -> None:
        """End the gzip member and bring it to the disk."""
        self._put(self._deflate.flush(zlib.Z_FINISH))
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()

    def _put(self, data: bytes) -> None:
        self._file.write(data)
        self.size_bytes += len(data)


class Writer:
    """Cut a stream of bytes into lines and lines into files ``<boot>-NNN.jsonl.gz``."""

    def __init__(self, folder: Path, boot: str, rotate_bytes: int, cap_bytes: int) -> None:
        self._folder = folder
        self._boot = boot
        self._rotate_bytes = rotate_bytes
        self._cap_bytes = cap_bytes
        self._part = b""
        self._file: RecordingFile | None = None
        folder.mkdir(parents=True, exist_ok=True)

    def feed(self, data: bytes) -> None:
        """Take what the pipe gave; a line's second half may come with the next call."""
        *lines, self._part = (self._part + data).split(b"\n")
        for line in lines:
            self._line(line)

    def flush(self) -> None:
        if self._file is not None:
            self._file.flush()

    def close(self) -> None:
        """End the last file; half a line is of no use to anyone and is left out."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _line(self, line: bytes) -> None:
        if line.startswith(HEADER) and (self._file is None or self._full(self._file)):
            self.close()
            self._file = RecordingFile(self._next_path())
            prune(self._folder, self._cap_bytes, keep=self._file.path)
        if self._file is not None:
            self._file.write(line + b"\n")

    def _full(self, file: RecordingFile) -> bool:
        return file.size_bytes >= self._rotate_bytes

    def _next_path(self) -> Path:
        taken = len(list(self._folder.glob(f"{self._boot}-*{SUFFIX}")))
        while (path := self._folder / f"{self._boot}-{taken:03d}{SUFFIX}").exists():
            taken += 1
        return path


def prune(folder: Path, cap_bytes: int, keep: Path) -> None:
    """Remove the oldest recordings until the rest fit under the cap."""
    found = sorted(
        (info.st_mtime_ns, info.st_size, path)
        for path in folder.glob(f"*{SUFFIX}")
        if path != keep
        for info in (path.stat(),)
    )
    total_bytes = sum(size for _, size, _ in found)
    for _, size, path in found:
        if total_bytes <= cap_bytes:
            return
        path.unlink(missing_ok=True)
        total_bytes -= size


def pump(source_fd: int, writer: Writer) -> None:
    """Write until the pipe ends."""
    due_s = time.monotonic() + FLUSH_S
    while True:
        readable, _, _ = select.select([source_fd], [], [], max(0.0, due_s - time.monotonic()))
        if time.monotonic() >= due_s:
            writer.flush()
            due_s = time.monotonic() + FLUSH_S
        if not readable:
            continue
        data = os.read(source_fd, _CHUNK)
        if not data:
            return
        writer.feed(data)


def be_humble() -> None:
    """Leave the loop's CPU and rank to the loop, and death to the end of the pipe."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    os.nice(NICE)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, range(os.cpu_count() or 1))


def main(arguments: list[str]) -> int:
    """Run as ``writer.py FOLDER BOOT ROTATE_BYTES CAP_BYTES`` with the pipe as standard input."""
    folder, boot, rotate_bytes, cap_bytes = arguments
    be_humble()
    try:
        writer = Writer(Path(folder), boot, int(rotate_bytes), int(cap_bytes))
        pump(0, writer)
        writer.close()
    except OSError as error:
        # The disk is full or gone. Dying says so: the bridge sees its pipe break and the row of
        # checks before arming does the rest.
        print(f"recorder_failed: {error}", file=sys.stderr, flush=True)  # noqa: T201  # its log
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
