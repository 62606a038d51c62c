"""Record what was seen of a robot with its wheels off the ground: robot.toml's ``[trial]``.

``pons robot try`` writes it. It holds only for the wiring that it was made with: another port,
another count of ticks, another lidar, and it is of another robot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from wire.base import Record
from wire.fingerprint import fingerprint

if TYPE_CHECKING:
    from wire.drive_config import DriveConfig
    from wire.lidar_config import LidarConfig

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


def wiring_of(drive: DriveConfig, lidar: LidarConfig) -> str:
    """Return the fingerprint of what a trial proves: which wheels and lidar are on which line."""
    return fingerprint(
        drive.model_dump_json(include=_DRIVE).encode(),
        lidar.model_dump_json(include=_LIDAR).encode(),
    )
