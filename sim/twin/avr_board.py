"""Run the pons_mcu firmware's own bytes on a simulated board, with the simulated robot as its body.

The board is a process of its own (firmware/simulated/board.c): an ATmega328P in simavr with a motor
driver and two encoders. It runs in turns, by its own processor's time, so that what it does is the
same on every computer. ``make -C firmware board`` builds it.
"""

from __future__ import annotations

import subprocess
from contextlib import suppress
from dataclasses import dataclass
from math import tau
from pathlib import Path
from struct import Struct
from typing import IO, TYPE_CHECKING, Final, Literal

from wire import ConfigError

if TYPE_CHECKING:
    from types import TracebackType

    from wire import DriveState, RobotDescription
    from wire.drive_config import DriveConfig

BUILD: Final = Path(__file__).parents[2] / "firmware" / "build"
FREE_RADPS: Final = 20.0
"""Of a wheel at full duty: as firmware/avr/config.h comes."""
STOP_PRESSED: Final = 0x01
FAULT_RESET: Final = 0x01
FAULT_CLOCK: Final = 0x02
_REQUEST: Final = Struct("<IiiHBBH")
_REPLY: Final = Struct("<hhBBH")
_BRIDGES: Final[tuple[Literal["coasts", "drives", "brakes"], ...]] = ("coasts", "drives", "brakes")
_FULL_DUTY, _MILLI, _MICRO = 1000.0, 1000.0, 1e6
_BATTERY_MV = 3300


@dataclass(frozen=True, slots=True)
class MotorPins:
    """Hold what the pins of the motor driver say at the end of a turn."""

    left_duty: int
    """Signed per mille of the supply; 0 unless the bridge drives."""
    right_duty: int
    left_bridge: Literal["coasts", "drives", "brakes"]
    right_bridge: Literal["coasts", "drives", "brakes"]

    @property
    def are_still(self) -> bool:
        """Return whether both motors are shorted, or driven with no duty."""
        return not (self.left_duty or self.right_duty) and "coasts" not in (
            self.left_bridge,
            self.right_bridge,
        )


class AvrBoard:
    """Speak to the process that simulates a board; use it in a ``with``."""

    def __init__(self, build: Path = BUILD) -> None:
        """Start the firmware that lies in ``build``.

        Raises:
            ConfigError: ``twin_not_built``.
        """
        board, firmware = build / "board", build / "pons_mcu.elf"
        if not (board.is_file() and firmware.is_file()):
            raise ConfigError(
                "twin_not_built",
                f"{build}: expected board and pons_mcu.elf; build them: make -C firmware board "
                "(needs gcc, gcc-avr, avr-libc, libsimavr-dev, libelf-dev)",
            )
        self._process = subprocess.Popen(
            [board, firmware], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )

    def __enter__(self) -> AvrBoard:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def run(  # one field of the request each
        self,
        run_s: float,
        heard: bytes = b"",
        *,
        left_edges_ps: float = 0.0,
        right_edges_ps: float = 0.0,
        inputs: int = 0,
        faults: int = 0,
    ) -> tuple[MotorPins, bytes]:
        """Let the processor run while the encoders turn; return the pins and what it sent.

        Raises:
            OSError: the process is gone.
        """
        request = _REQUEST.pack(
            round(run_s * _MICRO),
            round(left_edges_ps * _MILLI),
            round(right_edges_ps * _MILLI),
            _BATTERY_MV,
            inputs,
            faults,
            len(heard),
        )
        to_board, from_board = _pipes(self._process)
        to_board.write(request + heard)
        to_board.flush()
        head = from_board.read(_REPLY.size)
        if len(head) != _REPLY.size:
            raise OSError(f"the simulated board ended with {self._process.wait()}")
        left, right, left_bridge, right_bridge, count = _REPLY.unpack(head)
        pins = MotorPins(left, right, _BRIDGES[left_bridge], _BRIDGES[right_bridge])
        return pins, from_board.read(count)

    def close(self) -> None:
        """End the process."""
        for pipe in _pipes(self._process):
            with suppress(OSError):
                pipe.close()
        self._process.wait()


class AvrFirmware:
    """Stand as a twin's firmware; a motor turns its wheel as fast as the duty's share of full."""

    def __init__(self, config: DriveConfig, board: AvrBoard) -> None:
        self._board = board
        self._ticks_per_turn = config.ticks_per_turn or 1
        self._heard = b""
        self._said = b""
        self._ran_s: float | None = None
        self._body: DriveState | None = None
        self._reported: DriveState | None = None

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived."""
        self._heard += data

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Run the board up to now; return left and right [rad/s] and whether there is torque."""
        run_s = 0.0 if self._ran_s is None else max(0.0, now_s - self._ran_s)
        self._ran_s = now_s
        pins, said = self._board.run(
            run_s,
            self._heard,
            left_edges_ps=self._edges_ps("left_rad", run_s),
            right_edges_ps=self._edges_ps("right_rad", run_s),
            inputs=STOP_PRESSED if self._body is not None and self._body.estop_pressed else 0,
        )
        self._heard, self._reported = b"", self._body
        self._said += said
        share = FREE_RADPS / _FULL_DUTY
        torque = "drives" in (pins.left_bridge, pins.right_bridge)
        return pins.left_duty * share, pins.right_duty * share, torque

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Return what the board sent since."""
        self._body = body
        said, self._said = self._said, b""
        return said

    def close(self) -> None:
        """End the board's process."""
        self._board.close()

    def _edges_ps(self, angle: Literal["left_rad", "right_rad"], run_s: float) -> float:
        """Return how fast the encoder turns, so that it ends where the body's wheel is."""
        if self._body is None or self._reported is None or run_s <= 0.0:
            return 0.0
        turned_rad: float = getattr(self._body, angle) - getattr(self._reported, angle)
        return turned_rad / tau * self._ticks_per_turn / run_s


def boot_build(robot: RobotDescription, build: Path = BUILD) -> AvrFirmware:
    """Return a twin's firmware that runs what lies in a build's folder.

    Raises:
        ConfigError: ``twin_unknown`` for a drive that isn't ours, or ``twin_not_built``.
    """
    if robot.drive.kind != "pons_mcu":
        raise ConfigError(
            "twin_unknown",
            f"drive.kind {robot.drive.kind!r} has no firmware of ours; expected pons_mcu",
        )
    return AvrFirmware(robot.drive, AvrBoard(build))


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes]]:
    if process.stdin is None or process.stdout is None:
        raise OSError("the simulated board has no pipes")
    return process.stdin, process.stdout
