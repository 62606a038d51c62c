"""Read and write the lines of ros_arduino_bridge, the firmware of many small Arduino bases.

57 600 baud, ASCII. A command is a letter with numbers, ended by CR; each is answered by one line,
in order: ``m`` (ticks a frame of both wheels, 30 frames a second) by ``OK``, ``e`` by both counts.
There is no checksum, no number that comes back, and nothing is said unasked.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

from devices.port_probe import PortAnswer, PortProbe

BAUD: Final = 57_600
FRAMES_HZ: Final = 30.0
"""Of its loop on speed; ``m`` counts ticks in one."""
MOST_TICKS: Final = 9_999
LONGEST: Final = 64
_COUNTS: Final = re.compile(rb"(-?\d{1,10}) (-?\d{1,10})")
_COUNT_LIMIT: Final = 1 << 31


@dataclass(frozen=True, slots=True)
class ArduinoOk:
    """Tell that a command was read; which one is known by their order alone."""


@dataclass(frozen=True, slots=True)
class ArduinoCounts:
    """Hold the counts of both wheels since its start."""

    left: int
    right: int


@dataclass(frozen=True, slots=True)
class ArduinoOther:
    """Hold any other line: ``Invalid Command``, or an answer that was spoilt."""

    line: bytes


ArduinoLine = ArduinoOk | ArduinoCounts | ArduinoOther


def encode_move(left_ticks: int, right_ticks: int) -> bytes:
    """Return the command of both speeds [ticks a frame] and the question for the counts."""
    left, right = (min(max(ticks, -MOST_TICKS), MOST_TICKS) for ticks in (left_ticks, right_ticks))
    return b"m %d %d\re\r" % (left, right)


def encode_question() -> bytes:
    """Return the question for the counts."""
    return b"e\r"


class ArduinoReader:
    """Find the lines in a stream of bytes. Keeps at most one unfinished line between calls."""

    def __init__(self) -> None:
        self._rest = b""
        self.spoilt_lines = 0

    def reset(self) -> None:
        """Forget the unfinished line: what comes next is of another time."""
        self._rest = b""

    def read(self, data: bytes) -> list[ArduinoLine]:
        """Return what the whole lines in what came before and now say, oldest first."""
        *whole, rest = (self._rest + data).split(b"\n")
        found = [_read_line(line.rstrip(b"\r")) for line in whole]
        if len(rest) > LONGEST:
            found.append(ArduinoOther(rest[:LONGEST]))
            rest = b""
        self._rest = rest
        self.spoilt_lines += sum(isinstance(line, ArduinoOther) for line in found)
        return found


def _read_line(line: bytes) -> ArduinoLine:
    if line == b"OK":
        return ArduinoOk()
    counts = _COUNTS.fullmatch(line)
    if counts is not None:
        left, right = int(counts[1]), int(counts[2])
        if min(left, right) >= -_COUNT_LIMIT and max(left, right) < _COUNT_LIMIT:
            return ArduinoCounts(left, right)
    return ArduinoOther(line[:LONGEST])


_QUESTION: Final = b"b\r"
"""The speed of the line, which it answers with a number: nothing moves and nothing changes."""


def recognise(data: bytes) -> PortAnswer | None:
    """Return what answers; the number of its speed is all that it says of itself."""
    lines = data.replace(b"\r", b"").split(b"\n")
    if str(BAUD).encode() not in lines[:-1]:
        return None
    where = "of a wheel: edges a turn of the motor times its gear; `pons robot try` counts them"
    words = "Arduino with ros_arduino_bridge; its dead-man is 2 s unless it was compiled otherwise"
    return PortAnswer(words, missing={"ticks_per_turn": where})


PROBES: Final = (PortProbe("drive", "arduino", BAUD, recognise, _QUESTION),)
