"""Frame what a host and a motor controller with the pons_mcu firmware say to each other.

The protocol is ours (docs/drives.md has the table). Little-endian throughout, as AVR, RP2040 and
ESP32 are. A frame is::

    A5 5A | length of payload u8 | type u8 | seq u32 | payload | CRC-16 over length to payload

CRC-16/XMODEM: polynomial 1021, beginning at 0, sent least significant byte first. It finds every
error of one to three bits in a frame and every burst of up to 16; of other damage it lets 1 of
65 536 by. A frame of an unknown type, or of another length than its type's, is none however well it
checks.

Each command carries all that the controller needs, so one that was reset in mid-drive needs no
talk before it can obey, and none that it could have missed.
"""

from __future__ import annotations

from binascii import crc_hqx
from dataclasses import dataclass
from struct import Struct
from typing import Final

from devices.port_probe import PortAnswer, PortProbe

HEAD: Final = b"\xa5\x5a"
TYPE_COMMAND: Final = 0x01
TYPE_STATE: Final = 0x81
TTL_MS: Final = (50, 500)
"""What a command may ask for as its time to live; a controller refuses any other."""
NOT_MEASURED: Final = 0xFFFF
"""Of current and battery, where the controller can't measure it."""

_FRAME: Final = Struct("<2sBBI")
_CRC: Final = Struct("<H")
_COMMAND: Final = Struct("<IiiIHB")
_STATE: Final = Struct("<IIIIiiiiHHB")
_SIZES: Final = {TYPE_COMMAND: _COMMAND.size, TYPE_STATE: _STATE.size}
LONGEST: Final = _FRAME.size + _STATE.size + _CRC.size

ENABLE: Final = 0x01
"""Flag of a command: give the motors torque."""

ENABLED: Final = 0x01
"""Bits of a state, from here on."""
TIMED_OUT: Final = 0x02
STOP_PRESSED: Final = 0x04
BUMPER_FRONT: Final = 0x08
BUMPER_REAR: Final = 0x10
CLIFF: Final = 0x20
TRIPPED: Final = 0x40
"""The controller took the torque away itself: a wheel disobeyed, or drew too much current."""


@dataclass(frozen=True, slots=True)
class McuCommand:
    """Ask both wheels for a speed, for as long as ``ttl_ms`` and no longer."""

    seq: int
    boot: int
    """Drawn by the host at its start, never 0: a seq counts within it."""
    left_mradps: int
    right_mradps: int
    ticks_per_turn: int
    """Of the wheel, all edges counted: the controller knows no geometry of its own."""
    ttl_ms: int
    flags: int


@dataclass(frozen=True, slots=True)
class McuState:
    """Report what the controller does and measures."""

    seq: int
    boot: int
    """Drawn by the controller at its start."""
    echo_boot: int
    """Of the newest command that it accepted; 0 where there was none."""
    echo_seq: int
    time_us: int
    """Of the controller's clock when it counted; begins again at 2^32."""
    left_ticks: int
    """Since its start, begins again at 2^31."""
    right_ticks: int
    left_mradps: int
    right_mradps: int
    current_ma: int
    battery_mv: int
    bits: int


def encode_command(command: McuCommand) -> bytes:
    """Return the frame of a command.

    Raises:
        struct.error: a number does not fit its field.
    """
    payload = _COMMAND.pack(
        command.boot,
        command.left_mradps,
        command.right_mradps,
        command.ticks_per_turn,
        command.ttl_ms,
        command.flags,
    )
    return _frame(TYPE_COMMAND, command.seq, payload)


def encode_state(state: McuState) -> bytes:
    """Return the frame of a state.

    Raises:
        struct.error: a number does not fit its field.
    """
    payload = _STATE.pack(
        state.boot,
        state.echo_boot,
        state.echo_seq,
        state.time_us,
        state.left_ticks,
        state.right_ticks,
        state.left_mradps,
        state.right_mradps,
        state.current_ma,
        state.battery_mv,
        state.bits,
    )
    return _frame(TYPE_STATE, state.seq, payload)


class McuReader:
    """Find the frames in a stream of bytes. Keeps at most one unfinished frame between calls."""

    def __init__(self) -> None:
        self._rest = b""
        self.spoilt_bytes = 0
        """Skipped because they were part of no frame."""
        self.foreign_frames = 0
        """Whole frames that check, of a type or length that this protocol does not have: another
        version of the firmware speaks."""

    def reset(self) -> None:
        """Forget the unfinished frame: what comes next is of another time."""
        self._rest = b""

    def read(self, data: bytes) -> list[McuCommand | McuState]:
        """Return the whole frames in what came before and now, oldest first."""
        data = self._rest + data
        found: list[McuCommand | McuState] = []
        at = 0
        while True:
            head = data.find(HEAD, at)
            if head < 0:
                keep = 1 if data[at:].endswith(HEAD[:1]) else 0
                self.spoilt_bytes += len(data) - keep - at
                self._rest = data[len(data) - keep :]
                return found
            self.spoilt_bytes += head - at
            end = _end_of(data, head)
            if end is None:
                self._rest = data[head:]
                return found
            if end == 0 or not _checks(data[head:end]):
                self.foreign_frames += end == 0 and _is_foreign(data, head)
                at = head + 1  # a true frame may begin within what only looked like one
                self.spoilt_bytes += 1
                continue
            found.append(_decode(data[head:end]))
            at = end


def _frame(kind: int, seq: int, payload: bytes) -> bytes:
    body = _FRAME.pack(HEAD, len(payload), kind, seq) + payload
    return body + _CRC.pack(crc_hqx(body[len(HEAD) :], 0))


def _end_of(data: bytes, head: int) -> int | None:
    """Return where the frame ends; 0 where none begins there, None where more must come."""
    if len(data) < head + _FRAME.size:
        return None
    _, length, kind, _ = _FRAME.unpack_from(data, head)
    if _SIZES.get(kind) != length:
        return 0
    end = head + _FRAME.size + int(length) + _CRC.size
    return end if len(data) >= end else None


def _is_foreign(data: bytes, head: int) -> bool:
    """Return whether a whole frame of no type of ours begins there and checks."""
    length = data[head + len(HEAD)]
    end = head + _FRAME.size + length + _CRC.size
    return len(data) >= end and _checks(data[head:end])


def _checks(frame: bytes) -> bool:
    (crc,) = _CRC.unpack_from(frame, len(frame) - _CRC.size)
    return bool(crc == crc_hqx(frame[len(HEAD) : -_CRC.size], 0))


def _decode(frame: bytes) -> McuCommand | McuState:
    _, _, kind, seq = _FRAME.unpack_from(frame)
    if kind == TYPE_COMMAND:
        return McuCommand(seq, *_COMMAND.unpack_from(frame, _FRAME.size))
    return McuState(seq, *_STATE.unpack_from(frame, _FRAME.size))


_ENOUGH_STATES: Final = 3
"""Three that check by chance in noise: odds of 2^-48 for each place."""


def recognise(data: bytes) -> PortAnswer | None:
    """Return what a controller says of itself; it speaks 100 times a second, unasked."""
    states = [frame for frame in McuReader().read(data) if isinstance(frame, McuState)]
    if len(states) < _ENOUGH_STATES:
        return None
    last = states[-1]
    words = f"motor controller with the pons_mcu firmware, boot {last.boot:08x}"
    if last.battery_mv != NOT_MEASURED:
        words += f", battery {last.battery_mv / 1000:.1f} V"
    if last.bits & STOP_PRESSED:
        words += ", its stop input is pressed"
    where = "of a wheel: edges a turn of the motor times its gear; `pons robot try` counts them"
    return PortAnswer(words, missing={"ticks_per_turn": where})


PROBES: Final = (PortProbe("drive", "pons_mcu", 115_200, recognise),)
