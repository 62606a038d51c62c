"""Describe a robot's gyro: whose it is, and how it sits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pydantic import Field, model_validator

from wire.base import Record

if TYPE_CHECKING:
    from collections.abc import Iterator

Axis = Literal["x", "-x", "y", "-y", "z", "-z"]
"""An axis of the sensor, as printed on it or as its base calls it; "-" for its other end."""

I2C_ADDRESSES = {"mpu6050": (0x68, 0x69), "bno085": (0x4A, 0x4B)}
"""Of the kinds on an I2C bus, the addresses that the chip can have; the first is as it comes."""


class ImuConfig(Record):
    """Choose the gyro and state how it sits on the robot. Counts where ``inputs.imu`` is true."""

    kind: Literal["base", "mpu6050", "bno085"] = "base"
    """``base``: what moves the wheels brings it (the simulator, a base of metal, a ROS 2 topic);
    the others hang on an I2C bus of this computer and have a process of their own."""
    up: Axis = "z"
    """Which axis of the sensor points up. A wrong sign turns every reading round."""
    forward: Axis = "x"
    """Which axis of the sensor points forward."""
    bus: int | None = Field(default=None, ge=0, le=63)
    """Of the kinds on an I2C bus: the number of /dev/i2c-*; on a Raspberry Pi's pins it is 1."""
    address: int | None = Field(default=None, ge=0x08, le=0x77)
    """None: as the chip comes."""

    @model_validator(mode="after")
    def _has_the_keys_of_its_kind(self) -> ImuConfig:
        wrong = "; ".join(_wrong_imu_keys(self))
        if wrong:
            raise ValueError(wrong)
        return self

    @property
    def is_on_i2c(self) -> bool:
        """Return whether a process of its own reads it."""
        return self.kind in I2C_ADDRESSES


def _wrong_imu_keys(imu: ImuConfig) -> Iterator[str]:
    """Yield what does not fit together."""
    if imu.up.strip("-") == imu.forward.strip("-"):
        yield f"imu.up {imu.up!r} and imu.forward {imu.forward!r} lie along one axis"
    known = I2C_ADDRESSES.get(imu.kind)
    if known is None:
        for key in ("bus", "address"):
            if getattr(imu, key) is not None:
                yield f"imu.{key} is for {', '.join(I2C_ADDRESSES)}, not for kind {imu.kind!r}"
        return
    if imu.bus is None:
        yield f"imu.bus is missing: kind {imu.kind!r} hangs on an I2C bus, on a Raspberry Pi 1"
    if imu.address is not None and imu.address not in known:
        told = " or ".join(f"0x{address:02x}" for address in known)
        yield f"imu.address 0x{imu.address:02x}: kind {imu.kind!r} can have {told}"
