"""Record what was seen of a robot with its wheels off the ground: robot.toml's ``[trial]``.

``pons robot try`` writes it. It holds only for the wiring that it was made with: another port,
another count of ticks, another lidar, and it is of another robot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Protocol

from pydantic import Field

from wire.base import Record
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from pydantic import BaseModel

_DRIVE = {"kind", "port", "baud", "ticks_per_turn", "timeout_s"}
_LIDAR = {"kind", "model", "port", "upside_down", "yaw_rad"}


class TrialRecord(Record):
    """State when, of which wiring, and what the wheels did."""

    date: Annotated[str, Field(pattern=r"^\d{4}-\d{2}-\d{2}$")]
    wiring: Annotated[str, Field(pattern=r"^[0-9a-f]{16}$")]
    """The fingerprint of what it is true of."""
    dead_man_s: Annotated[float, Field(ge=0.0, le=60.0)]
    """From the last command until the wheels stood, the longest of all trials."""
    brake_s: Annotated[float, Field(ge=0.0, le=60.0)]
    """Of that, from the first loss of speed until they stood."""
    gyro: bool = False
    """The gyro turned left when a person turned the robot left; false: it was not tried."""
    camera: bool = False
    """The camera saw a hand at its left, and its covered lens; false: none was tried. No part of
    the wiring: no wheel turns by it."""


class WiredRobot(Protocol):
    """Describe what hangs on which wires, as robot.toml does."""

    @property
    def drive(self) -> BaseModel: ...

    @property
    def lidar(self) -> BaseModel: ...

    @property
    def imu(self) -> BaseModel: ...


def wiring_of(robot: WiredRobot) -> str:
    """Return the fingerprint of what a trial proves: which wheels, lidar and gyro hang where.

    A gyro that sits as it comes adds nothing, so that trials from before there were gyros hold.
    """
    parts = [
        robot.drive.model_dump_json(include=_DRIVE).encode(),
        robot.lidar.model_dump_json(include=_LIDAR).encode(),
    ]
    imu = robot.imu.model_dump_json(exclude_defaults=True)
    if imu != "{}":
        parts.append(imu.encode())
    return fingerprint(*parts)
