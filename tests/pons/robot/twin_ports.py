"""Play devices at the far ends of lines, as fast as they would speak."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import Any, cast

import numpy as np

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from devices.port_listing import SerialPortEntry
from sim.twin.lidar import LidarTwin
from sim.twin.line import TwinLine
from sim.twin.twin import FIRMWARES
from tests.wire.examples import EXAMPLES
from wire import DriveState, RobotDescription
from wire.drive_config import DRIVE_KINDS
from wire.lidar_config import LidarConfig

PERIOD_S = 0.01
BODY = cast("DriveState", EXAMPLES[DriveState]).model_copy(update={"battery": 0.8})
_NEEDED = {"port": "/dev/x", "ticks_per_turn": 400}
BASES = {
    kind: RobotDescription.model_validate(
        {"drive": {"kind": kind, **{key: _NEEDED[key] for key in DRIVE_KINDS[kind].needed}}}
    )
    for kind in FIRMWARES
}
"""A robot of each kind that has a twin."""


class PlayedLidar:
    """Play one lidar in a round room."""

    def __init__(self, link: Path, kind: str, model: str | None) -> None:
        config = {"kind": kind, "model": model, "port": "/dev/x"}
        self.twin = LidarTwin(LidarConfig.model_validate(config), link)

    def turn(self, now_s: float) -> None:
        self.twin.tick(now_s, lambda angles: tuple((2.0 + np.cos(angles)).tolist()))

    def close(self) -> None:
        self.twin.close()


class PlayedBase:
    """Play a base of one kind and remember whether its motors were ever told anything."""

    def __init__(self, link: Path, kind: str) -> None:
        self.line, self.firmware = TwinLine(link), FIRMWARES[kind](BASES[kind])
        self._baud = SERIAL_PROTOCOLS[kind](BASES[kind], "b1").baud
        self._standing = self.firmware.motors(0.0)
        self.moved = False

    def turn(self, now_s: float) -> None:
        speaks_alike = self.line.baud() == self._baud
        heard = self.line.read()
        self.firmware.hear(heard if speaks_alike else b"", now_s)
        self.moved |= self.firmware.motors(now_s) != self._standing
        said = self.firmware.say(BODY, now_s)
        self.line.write(said if speaks_alike else b"\xf8" * len(said))

    def close(self) -> None:
        self.line.close()


class PlayedNoise:
    """Say random bytes, or nothing."""

    def __init__(self, link: Path, most_bytes: int) -> None:
        self.line, self._most, self._random = TwinLine(link), most_bytes, Random(7)
        self.heard = b""

    def turn(self, _now_s: float) -> None:
        self.heard += self.line.read()
        if self._most:
            self.line.write(self._random.randbytes(self._most))

    def close(self) -> None:
        self.line.close()


@contextmanager
def played(devices: list[Any]) -> Iterator[None]:
    """Let devices live until the block ends."""
    ending = threading.Event()

    def live() -> None:
        while not ending.wait(PERIOD_S):
            for one in devices:
                one.turn(time.monotonic())

    thread = threading.Thread(target=live)
    thread.start()
    try:
        yield
    finally:
        ending.set()
        thread.join()
        for one in devices:
            one.close()


def entry(path: Path, **more: Any) -> SerialPortEntry:
    """Return a port of which nothing is known but its path."""
    known: dict[str, Any] = {
        "path": path, "lasting": path, "usb": None, "driver": "pty", "is_console": False,
        "group": "dialout", "is_permitted": True, "holders": (), **more,
    }  # fmt: skip
    return SerialPortEntry(**known)
