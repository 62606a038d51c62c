"""Define the knobs by which a simulated home is worse than it should be, and draw them by seed.

One frozen record, for ``pons up --domain`` and for lockstep alike. Every knob is neutral by
default, and a neutral knob changes no byte of what the robot says. Bounds are what the simulator
can take; what a draw may choose is narrower: :data:`DRAWN`.
"""

from __future__ import annotations

import json
import tomllib
from dataclasses import dataclass, fields, replace
from random import Random
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from sim.true_parameters import true_base
from wire import ConfigError
from wire.robot import explain

if TYPE_CHECKING:
    from pathlib import Path

    from sim.hardware import Hardware
    from wire.robot import Base

_Share = Annotated[float, Field(ge=0.0, le=0.9)]
_Delay = Annotated[float, Field(ge=0.0, le=0.2)]
_Every = Annotated[float, Field(ge=0.0, le=3600.0)]
_Scale = Annotated[float, Field(ge=0.9, le=1.1)]
_Walkers = Annotated[int, Field(ge=0, le=8)]


@dataclass(frozen=True, slots=True)
class Domain:
    """Hold one draw of the knobs. ``None``: as the hardware has it; 0 of ``_every_s``: never."""

    seed: Annotated[int, Field(ge=0, le=2**53)] = 0
    """Of all chance while the domain runs: where walkers go, when ice comes, what was moved."""
    lidar_sweep_s: Annotated[float, Field(ge=0.0, le=0.2)] | None = None
    """A real lidar turns for 0.1 s; the beams are taken from where the robot is meanwhile."""
    lidar_noise_m: Annotated[float, Field(ge=0.0, le=0.2)] | None = None
    """Standard deviation of a range: 0.01 m for good lidars, 0.05 m for cheap ones."""
    lidar_lost_share: _Share | None = None
    """Of the beams, each for itself: sunlight, and dark cloth at a flat angle."""
    lidar_null_patches: Annotated[int, Field(ge=0, le=40)] = 0
    """Spots of wall and furniture that return nothing: glass, mirrors, black lacquer."""
    lidar_range_scale: Annotated[float, Field(ge=0.95, le=1.05)] = 1.0
    """Range read over true range: cheap lidars are 1 or 2 % off."""
    lidar_x_error_m: Annotated[float, Field(ge=-0.1, le=0.1)] = 0.0
    """How much further forward the lidar sits than robot.toml says."""
    lidar_yaw_error_rad: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    """How far the lidar is turned against robot.toml: screw holes leave half a degree."""
    wheel_radius_scale: _Scale = 1.0
    """True radius over believed: wear, air, load."""
    wheel_track_scale: _Scale = 1.0
    """True track over believed: where a broad tyre really touches."""
    ice_every_s: _Every = 0.0
    """On average; then a wheel or both lose their grip: water, a rug that slides."""
    ice_for_s: Annotated[float, Field(ge=0.0, le=10.0)] = 2.0
    push_every_s: _Every = 0.0
    """On average; then somebody leans on the robot for 0.3 s, from any side; never on ice."""
    push_n: Annotated[float, Field(ge=0.0, le=400.0)] = 100.0
    """The tyres of the default robot hold about 200 N."""
    carry_every_s: _Every = 0.0
    """On average; then somebody carries the robot to anywhere in the home."""
    scan_delay_s: _Delay = 0.0
    """Of each scan's way out of the lidar; its stamp stays true."""
    scan_loss_share: _Share = 0.0
    drive_delay_s: _Delay = 0.0
    """Of each message of the motor controller: a slow serial line."""
    drive_loss_share: _Share = 0.0
    imu_delay_s: _Delay = 0.0
    imu_loss_share: _Share = 0.0
    furniture_moved_share: Annotated[float, Field(ge=0.0, le=1.0)] = 0.0
    """Of the pieces: shifted by at most 0.5 m since the map was made."""
    doors: Annotated[int, Field(ge=0, le=16)] = 0
    """How many of the home's doors have a leaf that opens and closes; more than there are: all."""
    door_open_s: _Every = 60.0
    """On average; 0: a leaf stays as it is until a test moves it, and is open at first."""
    door_shut_s: Annotated[float, Field(ge=1.0, le=3600.0)] = 10.0
    polite_walkers: _Walkers = 0
    """They stop 0.3 m before the robot, wait, and walk round it."""
    blind_walkers: _Walkers = 0
    """They look at a telephone: they stop only 0.12 m before the robot."""
    walker_speed_mps: Annotated[float, Field(ge=0.5, le=1.5)] = 1.0
    """Of the fastest; the others walk at 0.5 m/s or more. Indoors people walk at 0.5 to 1 m/s."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", allow_inf_nan=False, strict=True
    )

    def hardware(self, believed: Base, hardware: Hardware) -> Hardware:
        """Return the hardware with what the domain says of it."""
        radius_m = hardware.wheel_radius_m or believed.wheel_radius_m
        track_m = true_base(believed, hardware).wheel_separation_m
        told: dict[str, float | None] = {
            "lidar_sweep_s": self.lidar_sweep_s,
            "lidar_noise_m": self.lidar_noise_m,
            "lidar_dropout": self.lidar_lost_share,
        }
        chosen: dict[str, Any] = {name: value for name, value in told.items() if value is not None}
        scaled: dict[str, Any] = {
            "wheel_radius_m": radius_m * self.wheel_radius_scale,
            "wheel_separation_m": track_m * self.wheel_track_scale,
            "lidar_range_scale": hardware.lidar_range_scale * self.lidar_range_scale,
            "lidar_x_error_m": hardware.lidar_x_error_m + self.lidar_x_error_m,
            "lidar_yaw_error_rad": hardware.lidar_yaw_error_rad + self.lidar_yaw_error_rad,
        }
        return replace(hardware, **scaled, **chosen)

    @property
    def is_neutral(self) -> bool:
        """Return whether no knob is turned; the seed alone is none."""
        return replace(self, seed=0) == Domain()

    def as_toml(self) -> str:
        """Return the record as a file that :func:`load_domain` reads back, less what is unset."""
        told = ((field.name, getattr(self, field.name)) for field in fields(self))
        return "".join(f"{name} = {value!r}\n" for name, value in told if value is not None)


RANDOM = "random"
"""The word that asks for a draw in the place of a file."""
KNOWN = tuple(field.name for field in fields(Domain))
DRAWN: dict[str, tuple[float, float]] = {
    "lidar_sweep_s": (0.0, 0.1),
    "lidar_noise_m": (0.005, 0.05),
    "lidar_lost_share": (0.0, 0.3),
    "lidar_null_patches": (0, 12),
    "lidar_range_scale": (0.98, 1.02),
    "lidar_x_error_m": (-0.02, 0.02),
    "lidar_yaw_error_rad": (-0.0087, 0.0087),
    "wheel_radius_scale": (0.95, 1.05),
    "wheel_track_scale": (0.95, 1.05),
    "ice_every_s": (20.0, 60.0),
    "ice_for_s": (1.0, 3.0),
    "push_every_s": (60.0, 120.0),
    "push_n": (20.0, 120.0),
    "scan_delay_s": (0.0, 0.04),
    "scan_loss_share": (0.0, 0.05),
    "drive_delay_s": (0.0, 0.01),
    "drive_loss_share": (0.0, 0.01),
    "imu_delay_s": (0.0, 0.01),
    "imu_loss_share": (0.0, 0.01),
    "furniture_moved_share": (0.0, 0.3),
    "doors": (0, 3),
    "door_open_s": (30.0, 120.0),
    "door_shut_s": (5.0, 20.0),
    "polite_walkers": (0, 2),
    "blind_walkers": (0, 1),
    "walker_speed_mps": (0.6, 1.0),
}
"""What a draw chooses from, evenly: what a user's home and a cheap robot may well have. Nobody
carries a drawn robot: that it is lost then is right, so it is asked for by name."""
DECLARED_ALONE = ("furniture_moved_share", "doors")
"""Knobs that need a home.yaml: a map alone says neither what is furniture nor where doors are."""
_FILE = TypeAdapter(Domain)


def draw_domain(seed: int, *, declared: bool = True) -> Domain:
    """Draw every knob by a seed; the same seed gives the same domain.

    Args:
        seed: of the draw, and of the domain's own chance.
        declared: whether the site has a home.yaml; without one nothing is drawn that needs it.

    Raises:
        ConfigError: ``domain_invalid``: no seed can be that.
    """
    told: dict[str, object] = {"seed": seed}
    for name, (low, high) in DRAWN.items():
        random = Random(f"domain {seed} {name}")  # a stream each: a new knob changes no other
        whole = isinstance(low, int) and isinstance(high, int)
        value = random.randint(int(low), int(high)) if whole else random.uniform(low, high)
        if declared or name not in DECLARED_ALONE:
            told[name] = value if whole else round(value, 4)
    return _judge(told, f"seed {seed}")


def load_domain(path: Path) -> Domain:
    """Return the domain that a TOML file describes; what it leaves out is neutral.

    Raises:
        ConfigError: ``domain_missing``, ``domain_syntax`` or ``domain_invalid``: an unknown key or
            an impossible value. The text says what exists.
    """
    try:
        told = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise ConfigError("domain_missing", f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ConfigError("domain_syntax", f"{path}: {error}") from None
    return _judge(told, str(path))


def _judge(told: dict[str, object], origin: str) -> Domain:
    unknown = sorted(told.keys() - set(KNOWN))
    if unknown:
        text = f"{origin}: unknown key {', '.join(map(repr, unknown))}, known: {', '.join(KNOWN)}"
        raise ConfigError("domain_invalid", text)
    try:
        return _FILE.validate_json(json.dumps(told))  # strict, but for a dataclass of a mapping
    except TypeError as error:
        raise ConfigError("domain_invalid", f"{origin}: {error}") from None
    except ValidationError as error:
        raise ConfigError("domain_invalid", f"{origin}: {explain(error)}") from None
