"""Define the interface of a drive: four methods and three facts about its metal."""

from __future__ import annotations

from typing import Literal, Protocol

from wire import ConfigError, DecodeFailure, DriveCommand, DriveState, Imu

Braking = Literal["brake", "coast"]
"""What the wheels do without torque: short or brake, or roll on. Decides what CUT0 is worth; who
coasts is refused by :func:`require_brakes`."""


class Drive(Protocol):
    """Move the wheels and read them. No method blocks."""

    kind: str
    virtual: bool
    """No metal moves: refused real-time rights are a banner, and the published key counts."""
    braking: Braking

    def read(self) -> tuple[DriveState | DecodeFailure, ...]:
        """Return the states since the last call, oldest first, at most the 4 newest."""

    def take_imu(self) -> Imu | None:
        """Return what the drive's own gyro said in the states last read, once; None if none."""

    def write(self, command: DriveCommand | None) -> None:
        """Send one command; None sends nothing, which SELFTEST needs to see the time-out work."""

    def halt(self) -> None:
        """Zero both wheels and take the torque away. Never raises: all else may have failed."""


def require_brakes(drive: Drive) -> Drive:
    """Return the drive if its wheels brake without torque.

    Every stop but HOLD2 ends without torque. On wheels that roll on, that is safe only with torque
    kept at standstill until a person acts, which this bridge does not do.

    Raises:
        ConfigError: ``drive_coasts``.
    """
    if drive.braking != "brake":
        raise ConfigError(
            "drive_coasts",
            f"drive {drive.kind!r} declares braking {drive.braking!r}; expected 'brake': a stop "
            "takes the torque away, and wheels that roll on then would not stand. Short the motors "
            "or fit a brake",
        )
    return drive
