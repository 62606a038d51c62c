"""Read and write a serial port that never blocks and never resets what is behind it.

Raw termios, one owner (TIOCEXCL), no hang-up at closing (HUPCL is cleared), DTR and RTS as they
were unless a device asks for them: raising DTR resets an Arduino, and stops or starts an RPLidar
A1. pyserial was tried: with ``write_timeout=0`` it spins without end once the buffer is full.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import stat
import struct
import termios
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from types import TracebackType

READ_BYTES = 4096
_TCGETS2, _TCSETS2 = 0x802C542A, 0x402C542B
_BOTHER = 0o010000
_CBAUD = 0o010017
_TERMIOS2 = struct.Struct("<IIIIB19sII")
_CODES = {
    errno.ENOENT: "port_missing",
    errno.ENXIO: "port_missing",
    errno.ENODEV: "port_missing",
    errno.EACCES: "port_forbidden",
    errno.EPERM: "port_forbidden",
    errno.EBUSY: "port_busy",
}
_BY_ID = Path("/dev/serial/by-id")
MOST_NAMED = 6
PORT_CURES: Mapping[str, tuple[str, str]] = {
    "port_missing": (
        "plug it in, or name one that is there (`pons robot find`)",
        "请插好，或改用现有的端口（`pons robot find` 可列出）",
    ),
    "port_forbidden": (
        "add your user to the group that owns it (often dialout), and log in anew",
        "请将用户加入拥有该端口的组（通常是 dialout），然后重新登录",
    ),
    "port_busy": (
        "another program holds it; end that one (ModemManager probes new ports)",
        "请结束占用它的程序（ModemManager 会探测新端口）",
    ),
    "port_not_serial": (
        "name a serial port, such as one below /dev/serial/by-id",
        "请写一个串口，例如 /dev/serial/by-id 下的",
    ),
    "port_gone": ("look at its plug and its supply", "请检查插头和供电"),
    "baud_unknown": (
        "the port's driver does not do this speed: leave baud out",
        "该端口的驱动不支持此速率：请删去 baud",
    ),
    "robot_untried": (
        "lift the wheels off the ground and run `pons robot try`",
        "请把轮子架空后运行 `pons robot try`",
    ),
}
"""What cures each, in English and Chinese."""


class PortTrouble(OSError):
    """Say why a port can't be used, with a code that stays and what cures it."""

    def __init__(self, code: str, path: Path, found: str) -> None:
        self.code = code
        self.fact = f"{path}: {found}"
        """What came, without the cure."""
        self.detail = f"{self.fact}; {PORT_CURES[code][0]}"
        super().__init__(f"{code}: {self.detail}")


class SerialPort:
    """Own one port. ``read`` and ``write`` return at once; a port that is gone raises."""

    def __init__(self, path: Path, baud: int, *, dtr: bool | None = None) -> None:
        """Open a port at 8N1 without flow control.

        Args:
            path: of the device; better one below /dev/serial/by-id than ttyUSB0.
            baud: bits a second; any that the driver does, not just those of termios.
            dtr: set the line high or low, or leave it as opening left it.

        Raises:
            PortTrouble: ``port_missing``, ``port_forbidden``, ``port_busy``, ``port_not_serial`` or
                ``baud_unknown``.
        """
        self._path = path
        self._file = _open(path)
        try:
            self._set_up(baud)
            if dtr is not None:
                self._set_dtr(high=dtr)
        except BaseException:
            self.close()
            raise
        self.dropped_bytes = 0
        """Written when the port's buffer was full. What is old is not worth sending late."""

    def __enter__(self) -> SerialPort:
        """Return the port."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        self.close()

    def fileno(self) -> int:
        """Return the descriptor, to wait for bytes with select."""
        return self._file

    def read(self) -> bytes:
        """Return the bytes that came, at most READ_BYTES; none where none came.

        Raises:
            PortTrouble: ``port_gone``.
        """
        try:
            data = os.read(self._file, READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise PortTrouble("port_gone", self._path, error.strerror or "") from None
        if not data and not self._is_there():
            raise PortTrouble("port_gone", self._path, "it was hung up")
        return data

    def write(self, data: bytes) -> bool:
        """Give the port a whole message or nothing; tell whether it took it.

        A message of which the port took a part is finished or counted as dropped: its reader finds
        the next one by its head.

        Raises:
            PortTrouble: ``port_gone``.
        """
        try:
            taken = os.write(self._file, data)
        except BlockingIOError:
            taken = 0
        except OSError as error:
            raise PortTrouble("port_gone", self._path, error.strerror or "") from None
        self.dropped_bytes += len(data) - taken
        return taken == len(data)

    def set_baud(self, baud: int) -> None:
        """Speak at another speed; what came and was not read is thrown away.

        Raises:
            PortTrouble: ``baud_unknown`` or ``port_gone``.
        """
        try:
            self._set_up(baud)
        except PortTrouble:
            raise
        except (OSError, termios.error) as error:
            raise PortTrouble("port_gone", self._path, str(error)) from None

    def discard_input(self) -> None:
        """Throw away what came and was not read: it is of the time before."""
        with contextlib.suppress(termios.error):
            termios.tcflush(self._file, termios.TCIFLUSH)

    def close(self) -> None:
        """Give the port back; twice is once."""
        if self._file >= 0:
            with contextlib.suppress(OSError):
                os.close(self._file)
        self._file = -1

    def _is_there(self) -> bool:
        try:
            termios.tcgetattr(self._file)
        except termios.error:
            return False
        return True

    def _set_up(self, baud: int) -> None:
        fcntl.ioctl(self._file, termios.TIOCEXCL)
        attributes = termios.tcgetattr(self._file)
        attributes[0] = attributes[1] = attributes[3] = 0  # raw: no input, output or line handling
        attributes[2] = termios.CS8 | termios.CREAD | termios.CLOCAL  # and so without HUPCL
        attributes[6][termios.VMIN], attributes[6][termios.VTIME] = 0, 0
        known = getattr(termios, f"B{baud}", None)
        if known is not None:
            attributes[4] = attributes[5] = known
        termios.tcsetattr(self._file, termios.TCSANOW, attributes)
        if known is None:
            self._set_any_baud(baud)
        termios.tcflush(self._file, termios.TCIOFLUSH)

    def _set_any_baud(self, baud: int) -> None:
        """Set a speed for which termios has no name, as the 128 000 of a YDLidar X4: BOTHER."""
        try:
            raw = bytearray(_TERMIOS2.size)
            fcntl.ioctl(self._file, _TCGETS2, raw)
            iflag, oflag, cflag, lflag, line, control, _, _ = _TERMIOS2.unpack(raw)
            cflag = cflag & ~_CBAUD | _BOTHER
            wanted = _TERMIOS2.pack(iflag, oflag, cflag, lflag, line, control, baud, baud)
            fcntl.ioctl(self._file, _TCSETS2, wanted)
        except OSError as error:
            raise PortTrouble("baud_unknown", self._path, f"{baud}: {error.strerror}") from None

    def _set_dtr(self, *, high: bool) -> None:
        request = termios.TIOCMBIS if high else termios.TIOCMBIC
        with contextlib.suppress(OSError):  # a pty has no such line
            fcntl.ioctl(self._file, request, struct.pack("I", termios.TIOCM_DTR))


def _open(path: Path) -> int:
    try:
        found = path.stat()
    except OSError as error:
        raise _trouble(path, error) from None
    if not stat.S_ISCHR(found.st_mode):
        raise PortTrouble("port_not_serial", path, "not a character device")
    try:
        file = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise _trouble(path, error) from None
    if not os.isatty(file):
        os.close(file)
        raise PortTrouble("port_not_serial", path, "not a terminal device")
    try:  # TIOCEXCL does not keep root out; between two of ours this does
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(file)
        raise PortTrouble("port_busy", path, error.strerror or "") from None
    return file


def _trouble(path: Path, error: OSError) -> PortTrouble:
    code = _CODES.get(error.errno or 0, "port_missing")
    found = error.strerror or ""
    return PortTrouble(
        code, path, f"{found}; {_name_adapters()}" if code == "port_missing" else found
    )


def list_adapters() -> list[str]:
    """Return the lasting names of what is plugged in: what came back by another name is there."""
    try:
        return sorted(str(entry) for entry in _BY_ID.iterdir())
    except OSError:
        return []


def _name_adapters() -> str:
    names = list_adapters()
    more = ", …" if len(names) > MOST_NAMED else ""
    known = ", ".join(names[:MOST_NAMED]) or f"nothing below {_BY_ID}"
    return f"there is {known}{more}"
