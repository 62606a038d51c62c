"""Put a base on a stand before the shipped drive: time and a person, in memory."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from bridge.drive import SerialDrive
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from sim.twin.line import TwinLine
from sim.twin.stand import TICK_S, WheelStand, Wires
from tools.lockstep.drive_process import BaseEnd
from tools.lockstep.serial_line import SerialLine
from wire import DriveCommand, RobotDescription

__all__ = ["Stand", "Wires", "alive"]

START_S = 1000.0


@dataclass
class Stand:
    """Be line, time and person; what a test tries is the shipped drive on a stand."""

    robot: RobotDescription
    wires: Wires = field(default_factory=Wires)
    hand: dict[str, tuple[Literal[0, 1], float]] = field(
        default_factory=lambda: {"hand_left": (0, 3.0), "hand_right": (1, 3.0)}
    )
    """Which wheel a person turns when asked, and how many turns."""

    def __post_init__(self) -> None:
        self.line = SerialLine(1)
        self.time_s = START_S
        self.wheels = WheelStand(self.robot, self.wires, BaseEnd(self.line), START_S)
        protocol = SERIAL_PROTOCOLS[self.robot.drive.kind](self.robot, "trial")
        self.drive = SerialDrive(protocol, self.line, "trial", self.now_s)
        self.asked: list[str] = []
        self.steps: list[str] = []
        self._seq = 0

    def now_s(self) -> float:
        """Return the time [s]."""
        return self.time_s

    def ask(self, code: str) -> None:
        """Begin to do what a person is asked to do; it takes two seconds."""
        self.asked.append(code)
        if code == "gyro_left":
            self.wheels.turn_robot_by_hand()
        else:
            self.wheels.turn_by_hand(*self.hand.get(code, (0, 0.0)))

    def has_answered(self) -> bool:
        """Tell whether it is done."""
        return not self.wheels.is_turned

    def tell(self, step: str, seen: str = "") -> None:
        """Note the step."""
        self.steps.append(step)

    def require_watch(self) -> None:
        """Watch always."""

    def wait(self) -> None:
        """Let 10 ms pass."""
        self.time_s += TICK_S
        self.wheels.tick(self.time_s)

    def command_zero(self) -> None:
        """Tell the base to stand, as whoever drives it does."""
        self._seq += 1
        self.drive.write(
            DriveCommand(boot="trial", seq=self._seq, left_radps=0.0, right_radps=0.0, enable=False)
        )


@contextmanager
def alive(stand: Stand, link: Path, also: Callable[[], None] = lambda: None) -> Iterator[None]:
    """Let a stand live at a real line, in real time, until the block ends."""
    line, ending, began_s = TwinLine(link), threading.Event(), time.monotonic()
    stand.wheels.end = line

    def live() -> None:
        while not ending.wait(TICK_S / 4):
            while began_s + stand.time_s - START_S < time.monotonic():
                stand.wait()
            also()

    thread = threading.Thread(target=live)
    thread.start()
    try:
        yield
    finally:
        ending.set()
        thread.join()
        line.close()
