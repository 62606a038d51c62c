"""Run the process that writes recordings: ``FOLDER BOOT ROTATE_BYTES CAP_BYTES CLOCK_OFFSET_S``.

Frames come by standard input, words go by standard output. It ends when the pipe ends, however the
bridge died, and then writes what was still in the pipe; that is why it asks for no death signal and
ignores Ctrl-C. A reader loses at most ``BEAT_S`` of a recording whose writer was killed, and
``SYNC_S`` of one whose host lost its power.
"""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

from bridge.recording.foxglove_messages import UnixClock
from bridge.recording.pipe_frames import BadFrame, Splitter
from bridge.recording.writer import Writer
from processes.parent_death import child_command
from processes.priority import add_nice

_ROOT = Path(__file__).resolve().parents[2]
BEAT_S = 0.5
SYNC_S = 2.0
NICE = 5
"""A third of an ordinary weight. Of a core it needs 2.7 %, and one that gets less loses ticks: five
steps behind sixteen busy processes on two cores it has 3.9 %, ten behind 1.3 %."""
_READ_BYTES = 1 << 16
EXIT_DONE, EXIT_BAD_FRAME = 0, 1


def pump(source_fd: int, words_fd: int, writer: Writer) -> None:
    """Write until the pipe ends.

    Raises:
        BadFrame: what comes is no frame.
    """
    splitter = Splitter()
    beat_s = sync_s = time.monotonic()
    while True:
        wait_s = max(0.0, beat_s - time.monotonic())
        readable, _, _ = select.select([source_fd], [], [], wait_s)
        if readable:
            data = os.read(source_fd, _READ_BYTES)
            if not data:
                return
            for kind, payload in splitter.feed(data):
                writer.take(kind, payload, time.time())
        if (now_s := time.monotonic()) >= beat_s:
            beat_s = now_s + BEAT_S
            _say(words_fd, writer.beat())
            if now_s >= sync_s:
                sync_s = now_s + SYNC_S
                writer.sync()


def _say(words_fd: int, word: bytes) -> None:
    """Answer the loop without waiting: it may be dead, and its frames still count."""
    try:
        os.write(words_fd, word)
    except (BlockingIOError, BrokenPipeError):
        return


class ThinnerStart:
    """Start the process that thins finished recordings out; it dies with this one."""

    def __init__(self, arguments: list[str]) -> None:
        self._command = child_command("bridge.recording.thinning", *arguments)
        self._running: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it, unless the last one is still at it; without one the oldest files go as ever."""
        if self._running is not None and self._running.poll() is None:
            return
        try:
            self._running = subprocess.Popen(
                self._command, cwd=_ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
            )
        except OSError as error:
            print(f"thinner_not_started: {error}", file=sys.stderr, flush=True)

    def end(self) -> None:
        """Leave no process behind; what it was at is whole on the disk, and done the next time."""
        if self._running is not None:
            self._running.kill()
            self._running.wait()


def be_humble() -> None:
    """Leave the loop's CPU and priority to the loop, and death to the end of the pipe."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
    add_nice(NICE, own_session=True)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, range(os.cpu_count() or 1))


def main(arguments: list[str]) -> int:
    """Return the exit status."""
    be_humble()
    folder, boot, rotate_bytes, cap_bytes, offset_s = arguments
    os.set_blocking(1, False)
    clock = UnixClock(float(offset_s))
    thinner = ThinnerStart([folder, boot, cap_bytes, rotate_bytes])
    sizes = int(rotate_bytes), int(cap_bytes)
    writer = Writer(Path(folder), boot, *sizes, clock, on_new_file=thinner.start)
    try:
        pump(0, 1, writer)
    except BadFrame as error:
        print(f"recorder_failed: {error}", file=sys.stderr, flush=True)
        return EXIT_BAD_FRAME
    finally:
        thinner.end()
        writer.close()
    return EXIT_DONE


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
