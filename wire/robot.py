"""Describe a robot: one frozen record read from robot.toml, checked at birth.

Owned by the bridge, which loads it while DISARMED and publishes its hash; planner and sim take
limits from the same record. Unknown keys and unsafe values refuse to start: there is no default for
a value that somebody wrote wrongly.
"""

from __future__ import annotations

import glob
import tomllib
from math import hypot
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import BaseModel, Field, ValidationError, model_validator

from wire.base import Record
from wire.camera_config import CameraConfig
from wire.drive_config import DRIVE_KINDS, DriveConfig
from wire.errors import ConfigError
from wire.file_trouble import describe_error, describe_syntax
from wire.fingerprint import fingerprint
from wire.imu_config import ImuConfig
from wire.lidar_config import LidarConfig
from wire.margins import OBSTACLE_MARGIN_M
from wire.plain_file import read_plain_file
from wire.ros2_config import FORMER_CODE, Ros2Config, explain_former_keys, wrong_ros2
from wire.trial_record import TrialRecord, wiring_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

MOST_BYTES = 16_000
"""Ours has 3 000. A parser is busy for seconds with 64 kB of one dotted key."""
MOST_SKID = 2.5
"""Track that counts over distance of the wheels; four wheels on carpet come to 2."""
HIDDEN_BEYOND_M = OBSTACLE_MARGIN_M
"""What comes so near the robot's disc stops it."""
RobotId = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,31}$")]


class Base(Record):
    """Give the geometry of a differential base: a disc on the floor with two driven wheels."""

    wheel_radius_m: float = Field(default=0.1, ge=0.01, le=1.0)
    wheel_separation_m: float = Field(default=0.5, ge=0.05, le=3.0)
    wheels_apart_m: float | None = Field(default=None, ge=0.05, le=3.0)
    """Of a base that skids in turns (four wheels and more, tracks): how far apart they stand;
    ``wheel_separation_m`` is then the track that counts, which `pons calibrate --track` finds."""
    radius_m: float = Field(default=0.30, ge=0.05, le=3.0)
    """The disc that holds the whole robot, centred on ``base``."""


class Limits(Record):
    """Bound the bridge's commands for ever. Each bound has its reason beside it."""

    max_speed_mps: float = Field(default=0.5, ge=0.05, le=2.0)
    """Forward and back; a walking person is 1.4."""
    max_turn_radps: float = Field(default=1.0, ge=0.1, le=4.0)
    max_accel_mps2: float = Field(default=0.5, ge=0.05, le=3.0)
    """At the wheels, away from zero."""
    max_decel_mps2: float = Field(default=1.0, ge=0.2, le=5.0)
    """At the wheels, towards zero; an ordinary stop."""
    hardest_decel_mps2: float = Field(default=2.5, ge=0.2, le=10.0)
    """At the wheels, towards zero; FAST1. Beyond it wheels slip or the robot tips."""
    max_jerk_mps3: float = Field(default=2.0, ge=0.1, le=50.0)
    stop_jerk_mps3: float = Field(default=10.0, ge=1.0, le=200.0)
    max_lateral_mps2: float = Field(default=0.5, ge=0.05, le=5.0)
    max_wheel_radps: float = Field(default=10.0, ge=0.5, le=100.0)

    @model_validator(mode="after")
    def _hardest_is_hardest(self) -> Limits:
        if not self.hardest_decel_mps2 >= self.max_decel_mps2:
            raise ValueError("hardest_decel_mps2 must not be below max_decel_mps2")
        return self


class RealTime(Record):
    """Ask for the loop's place on the machine."""

    priority: int = Field(default=60, ge=1, le=80)
    cpu: int | None = Field(default=None, ge=0, le=1023)
    """None: the highest-numbered CPU that this process may use."""


class Recording(Record):
    """Bound the black box's share of the disk. There is no value that switches it off."""

    file_mb: int = Field(default=64, ge=4, le=1024)
    """A file that is larger ends, and the next begins."""
    total_mb: int = Field(default=2048, ge=256, le=1_000_000)
    """All files together; the oldest go first."""

    @model_validator(mode="after")
    def _several_files_fit(self) -> Recording:
        if not 4 * self.file_mb <= self.total_mb:
            raise ValueError(
                f"recording.total_mb {self.total_mb} must hold four files of "
                f"file_mb {self.file_mb}: the newest must survive when the oldest goes"
            )
        return self


class Inputs(Record):
    """Name the safety inputs that are wired up."""

    estop_link: bool = False
    """A stop button's node speaks on op/estop_link; silence then counts as pressed."""
    imu: bool = True
    """False: nothing shows wheels that slip, and row YAW_DISAGREE stays up (at most 0.3 m/s)."""


class LocalizationConfig(Record):
    """Choose what says where the robot is in ``map``."""

    kind: Literal["stand_in", "scans"] = "scans"
    """``scans``: the lidar's scans against the site's map, which needs no simulator;
    ``stand_in``: the simulator's truth plus noise, for tests."""


class RobotDescription(Record):
    """Hold all that is particular to one robot."""

    id: RobotId = "r1"
    base: Base = Base()
    limits: Limits = Limits()
    drive: DriveConfig = DriveConfig()
    lidar: LidarConfig = LidarConfig()
    camera: CameraConfig = CameraConfig()
    imu: ImuConfig = ImuConfig()
    realtime: RealTime = RealTime()
    inputs: Inputs = Inputs()
    recording: Recording = Recording()
    localization: LocalizationConfig = LocalizationConfig()
    trial: TrialRecord | None = None
    ros2: Ros2Config | None = None
    """Where ``drive.kind`` is "ros2", and there alone (docs/ros2.md)."""

    @model_validator(mode="after")
    def _wheels_reach_the_speed(self) -> RobotDescription:
        reach_mps = self.limits.max_wheel_radps * self.base.wheel_radius_m
        if not self.limits.max_speed_mps <= reach_mps:
            raise ValueError(
                f"limits.max_speed_mps {self.limits.max_speed_mps} cannot be reached: "
                f"max_wheel_radps x wheel_radius_m is {reach_mps}"
            )
        return self

    @model_validator(mode="after")
    def _parts_fit(self) -> RobotDescription:
        wrong = "; ".join((*_misfits(self.base, self.lidar), *_shared_port(self.drive, self.lidar)))
        if wrong:
            raise ValueError(wrong)
        return self

    @model_validator(mode="after")
    def _ros2_is_whole(self) -> RobotDescription:
        parts = (self.ros2, self.drive.kind, self.lidar.kind, self.camera.kind)
        wrong = "; ".join(wrong_ros2(*parts))
        if wrong:
            raise ValueError(wrong)
        return self

    @property
    def hash(self) -> str:
        """Return the fingerprint that status publishes and hello must match.

        Without the trial, which says something about the robot and changes nothing of it.
        """
        return fingerprint(self.model_dump_json(exclude={"trial"}).encode())

    @property
    def has_gyro(self) -> bool:
        """Return whether metal has a gyro to read: a chip on I2C, or one that the base reports."""
        return self.imu.is_on_i2c or DRIVE_KINDS[self.drive.kind].has_gyro

    @property
    def valid_trial(self) -> TrialRecord | None:
        """Return the trial; None where there was none, or one of another wiring."""
        trial = self.trial
        if trial is None or trial.wiring != wiring_of(self):
            return None
        return trial


def _misfits(base: Base, lidar: LidarConfig) -> Iterator[str]:
    """Yield the parts that reach out of the disc that is kept clear of obstacles [m]."""
    apart_m = base.wheels_apart_m or base.wheel_separation_m
    half_m, offset_m = apart_m / 2, hypot(lidar.x_m, lidar.y_m)
    stops_m = base.radius_m + HIDDEN_BEYOND_M
    if not apart_m <= base.wheel_separation_m <= MOST_SKID * apart_m:
        yield (
            f"base.wheel_separation_m {base.wheel_separation_m} must be 1 to {MOST_SKID:g} times "
            f"wheels_apart_m {apart_m}: wheels that skid turn the robot less, never more"
        )
    if not base.radius_m >= half_m:
        yield (
            f"base.radius_m {base.radius_m} must be at least {half_m:g}, half of "
            "wheel_separation_m: the disc holds the whole robot, wheels too"
        )
    if not offset_m <= base.radius_m:
        yield (
            f"lidar.x_m {lidar.x_m} and y_m {lidar.y_m} lie {offset_m:.3g} m from the middle, "
            f"outside base.radius_m {base.radius_m}: the disc holds the whole robot, its lidar too"
        )
    elif not offset_m + lidar.range_min_m <= stops_m:
        yield (
            f"lidar.range_min_m {lidar.range_min_m} must be at most {stops_m - offset_m:.3g}: what "
            "is nearer counts as being so far away, and further than base.radius_m "
            f"{base.radius_m} + {HIDDEN_BEYOND_M} - {offset_m:.3g} (lidar from the middle) it "
            "never stops the robot"
        )


def _shared_port(drive: DriveConfig, lidar: LidarConfig) -> Iterator[str]:
    """Yield that base and lidar are named at one port, which one of them would find busy."""
    if drive.port is not None and drive.port == lidar.port:
        yield (
            f"drive.port and lidar.port are both {drive.port}: two adapters that call themselves "
            "alike have names below /dev/serial/by-path that differ (`pons robot find`)"
        )


def load_robot(path: Path) -> RobotDescription:
    """Read robot.toml.

    Raises:
        ConfigError: the file is missing, is not TOML, has an unknown key or an unsafe value;
            the message names every such key, what came and what is allowed.
    """
    text = ""
    try:
        text = read_plain_file(path, MOST_BYTES).decode("utf-8")
        raw = tomllib.loads(text)
        former = explain_former_keys(raw)
        if former is not None:
            raise ConfigError(FORMER_CODE, f"{path}: {former}")
        return RobotDescription.model_validate(raw, strict=True)
    except OSError as error:
        raise ConfigError("robot_toml_missing", f"{path}: {error.strerror}") from None
    except ValidationError as error:
        raise ConfigError(
            "robot_toml_invalid", f"{path}: {explain(error, RobotDescription)}"
        ) from None
    except UnicodeDecodeError as error:
        found = f"{path}: {error.reason} at byte {error.start}; save it as UTF-8"
        raise ConfigError("robot_toml_syntax", found) from None
    except ValueError as error:  # no TOML, or a number of thousands of digits
        found = f"{path}: {describe_syntax(text, error)}{_older_copy(path)}"
        raise ConfigError("robot_toml_syntax", found) from None
    except RecursionError:
        raise ConfigError("robot_toml_syntax", f"{path}: nested too deeply") from None


def _older_copy(path: Path) -> str:
    """Return a hint at the copy that was made before Pons last changed a robot.toml."""
    copies = sorted(path.parent.glob(f"{glob.escape(path.name)}.bak-*"))
    return f"; {copies[-1].name} beside it is an older copy" if copies else ""


def explain(error: ValidationError, model: type[BaseModel] | None = None) -> str:
    """Describe a validation error in one line: the value, the expectation, the known keys."""
    found = error.errors(include_url=False)
    return "; ".join(describe_error(item, _keys_beside(model, item["loc"])) for item in found)


def _keys_beside(model: type[BaseModel] | None, loc: tuple[int | str, ...]) -> list[str]:
    """Return the keys of the table that an unknown key stood in; none where that is no table."""
    for part in loc[:-1]:
        field = model.model_fields.get(str(part)) if model is not None else None
        inner = field.annotation if field is not None else None
        model = inner if isinstance(inner, type) and issubclass(inner, BaseModel) else None
    return list(model.model_fields) if model is not None else []
