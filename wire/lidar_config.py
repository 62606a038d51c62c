"""Describe a robot's planar lidar: which it is, where it sits, what it can measure."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, model_validator

from wire.base import Record
from wire.bounded_types import DevicePath

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

LIDAR_MODELS: Mapping[str, tuple[str, ...]] = {
    "sim": (),
    "ros2": (),
    "ld08": (),
    "ld19": (),
    "rplidar": ("a1", "a2", "a2m12", "a3", "c1", "s1", "s2"),
    "ydlidar": ("x2", "x4", "g2", "g4", "tg15"),
}
"""The kinds, and the models among which each must choose; LD06, LD19 and STL-19P speak alike, and
TurtleBot 3's LDS-02 is an LD08."""
SIMULATED = "sim"
WITHOUT_LINE = (SIMULATED, "ros2")
"""Kinds that no process of ours reads at a serial port."""


class LidarConfig(Record):
    """Place the planar lidar on the robot and state its range."""

    kind: Literal["sim", "ros2", "ld08", "ld19", "rplidar", "ydlidar"] = "sim"
    """``sim``: the simulator casts its rays; ``ros2``: a topic (docs/ros2.md); the others are read
    at ``port`` (docs/lidars.md)."""
    model: Annotated[str, Field(pattern=r"^[a-z0-9]{1,16}$")] | None = None
    """Of the kinds that have several, which differ in speed and answer."""
    port: DevicePath | None = None
    """Serial port of the lidar; one below /dev/serial/by-id keeps its name."""
    baud: int | None = Field(default=None, ge=9_600, le=4_000_000)
    """None: as the model comes."""
    upside_down: bool = False
    """It hangs with its head down, so that it counts its angles the other way round."""
    x_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    y_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    yaw_rad: float = Field(default=0.0, ge=-pi, le=pi)
    """Where its zero points, seen from above; 0: forward."""
    range_min_m: float = Field(default=0.12, ge=0.0, le=1.0)
    """What is nearer counts as being so far, which must still stop the robot: see ``_misfits``."""
    range_max_m: float = Field(default=8.0, ge=1.0, le=100.0)
    scan_s: float = Field(default=0.1, ge=0.01, le=0.2)
    """Period of a turn; LIDAR_STALE allows 0.25 s, so a slower lidar could never be fresh."""

    @model_validator(mode="after")
    def _has_the_keys_of_its_kind(self) -> LidarConfig:
        wrong = "; ".join(_wrong_lidar_keys(self))
        if wrong:
            raise ValueError(wrong)
        return self

    @property
    def is_simulated(self) -> bool:
        """Return whether the simulator's own messages stand for it."""
        return self.kind == SIMULATED

    @property
    def has_line(self) -> bool:
        """Return whether it hangs on a serial line, which a process of its own reads."""
        return self.kind not in WITHOUT_LINE


def _wrong_lidar_keys(lidar: LidarConfig) -> Iterator[str]:
    """Yield what a kind of lidar lacks, and what it was given though it can't use it."""
    models = LIDAR_MODELS[lidar.kind]
    if not lidar.has_line:
        for key in ("port", "baud"):
            if getattr(lidar, key) is not None:
                yield f"lidar.{key} is for a lidar on a serial line, not for kind {lidar.kind!r}"
        if lidar.upside_down:
            yield f"lidar.upside_down is for one on a serial line, not for kind {lidar.kind!r}"
    elif lidar.port is None:
        yield f"lidar.port is missing: kind {lidar.kind!r} is read at a serial port"
    if models and lidar.model not in models:
        yield (
            f"lidar.model {lidar.model!r} is none that kind {lidar.kind!r} knows: "
            f"{', '.join(models)}"
        )
    if not models and lidar.model is not None:
        yield f"lidar.model is for kinds of several models, not for kind {lidar.kind!r}"
