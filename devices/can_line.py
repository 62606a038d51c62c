"""Keep a CAN bus open and carry its frames as records of 16 bytes, without making anybody wait.

python-can does the work, an extra that is loaded when a bus is opened. Its calls may wait, for a
frame or for room in the controller's queue, so each direction has a thread. What stands between
them and the user is bounded: the oldest is dropped, and counted. To its user this is a line of
bytes as a serial port is: whole records in, whole records out (Linux' ``struct can_frame``).
"""

from __future__ import annotations

import importlib
import logging
import threading
from collections import deque
from struct import Struct
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

log = logging.getLogger("devices")

RECORD: Final = Struct("=IB3x8s")
EXTENDED: Final = 1 << 31
"""Set in a record's number where it is one of 29 bits."""
KEPT: Final = 256
"""Frames that wait to be read: a tick's at 500 kbit/s are 40."""
UNSENT: Final = 16
"""Frames that wait to be sent; a bus on which nobody answers takes none."""
WAIT_S: Final = 0.1
RETRY_S: Final = 0.5
LIBRARY: Final = "can"


class CanFrame(NamedTuple):
    """Hold one frame."""

    number: int
    data: bytes
    is_extended: bool = False


class CanTrouble(Exception):
    """A bus can't be used. The code is stable; ``detail`` says what came."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


def pack(frames: Iterable[CanFrame]) -> bytes:
    """Return frames as records.

    Raises:
        ValueError: a frame of more than 8 bytes.
    """
    records = []
    for frame in frames:
        if len(frame.data) > 8:
            raise ValueError(f"{len(frame.data)} bytes; a CAN frame has at most 8")
        number = frame.number | (EXTENDED if frame.is_extended else 0)
        records.append(RECORD.pack(number, len(frame.data), frame.data))
    return b"".join(records)


def unpack(records: bytes) -> list[CanFrame]:
    """Return the frames of whole records; a rest is none."""
    frames = []
    for at in range(0, len(records) - RECORD.size + 1, RECORD.size):
        number, size, data = RECORD.unpack_from(records, at)
        if size <= 8:
            is_extended = bool(number & EXTENDED)
            frames.append(CanFrame(number & ~EXTENDED, data[:size], is_extended))
    return frames


class CanLine:
    """Read and write a bus that is opened anew whenever it went."""

    def __init__(self, channel: str, interface: str = "socketcan", bitrate: int = 500_000) -> None:
        """Begin to open it.

        Args:
            channel: ``can0``.
            interface: python-can's name of what it hangs on.
            bitrate: for interfaces that take one; SocketCAN's is set by ``ip link``.

        Raises:
            CanTrouble: ``can_library_missing``.
        """
        self._can = load_library()
        self._words: dict[str, Any] = {"channel": channel, "interface": interface}
        if interface != "socketcan":
            self._words["bitrate"] = bitrate
        self._bus: Any = None
        self._in: deque[bytes] = deque(maxlen=KEPT)
        self._out: deque[CanFrame] = deque()
        self._wake = threading.Event()
        self._ending = threading.Event()
        self.opened = 0
        self.dropped = 0
        """Frames that found no room on their way out."""
        self.trouble: CanTrouble | None = CanTrouble("can_unopened", "not opened yet")
        self._threads = [
            threading.Thread(target=work, name=f"can-{name}", daemon=True)
            for name, work in (("in", self._receive), ("out", self._send))
        ]
        for thread in self._threads:
            thread.start()

    def read(self) -> bytes:
        """Return the records that came; none where the bus is away."""
        found = []
        while self._in:
            found.append(self._in.popleft())
        return b"".join(found)

    def write(self, data: bytes) -> bool:
        """Queue records whole or not at all; return which."""
        frames = unpack(data)
        if self._bus is None or len(self._out) + len(frames) > UNSENT:
            self.dropped += len(frames)
            return False
        self._out.extend(frames)
        self._wake.set()
        return True

    def close(self) -> None:
        """Give the bus back."""
        self._ending.set()
        self._wake.set()
        for thread in self._threads:
            thread.join(2 * RETRY_S)

    def _receive(self) -> None:
        """Open, read until it fails, open again."""
        while not self._ending.is_set():
            try:
                with self._can.Bus(**self._words) as bus:
                    self._begin(bus)
                    while not self._ending.is_set():
                        message = bus.recv(WAIT_S)
                        if message is not None and not message.is_error_frame:
                            self._in.append(pack([_frame_of(message)]))
            except (self._can.CanError, OSError, ValueError) as error:
                self._lose(str(error))
            finally:
                self._bus = None
            self._ending.wait(RETRY_S)

    def _send(self) -> None:
        while not self._ending.is_set():
            self._wake.wait(WAIT_S)
            self._wake.clear()
            bus = self._bus
            while self._out and bus is not None:
                frame = self._out.popleft()
                message = self._can.Message(
                    arbitration_id=frame.number, data=frame.data, is_extended_id=frame.is_extended
                )
                try:
                    bus.send(message, timeout=WAIT_S)
                except (self._can.CanError, OSError) as error:
                    self.dropped += 1 + len(self._out)
                    self._out.clear()  # what waited meanwhile is of another time
                    self._say(f"a frame was not taken: {error}")

    def _begin(self, bus: Any) -> None:
        self._in.clear()
        self._out.clear()
        self._bus = bus
        self.opened += 1
        self._say(None)

    def _lose(self, why: str) -> None:
        self._in.clear()
        self._say(why)

    def _say(self, trouble: str | None) -> None:
        """Log a trouble once, not at each frame."""
        if trouble is None:
            self.trouble = None
            return
        if self.trouble is None or self.trouble.code == "can_unopened":
            log.warning("can_gone: %s: %s", self._words["channel"], trouble)
        self.trouble = CanTrouble("can_gone", trouble)


def load_library() -> Any:
    """Return python-can.

    Raises:
        CanTrouble: ``can_library_missing``.
    """
    try:
        return importlib.import_module(LIBRARY)
    except ImportError:
        text = "python-can is not installed; pip install 'pons-robot[can]'"
        raise CanTrouble("can_library_missing", text) from None


def _frame_of(message: Any) -> CanFrame:
    return CanFrame(message.arbitration_id, bytes(message.data[:8]), message.is_extended_id)
