"""Read the simulated robot's true parameters where they differ from robot.toml.

A metal file is TOML with any fields of :class:`sim.hardware.Hardware`. Bridge and planner never see
it: it stands for the workshop that built the robot, and calibration has to find it out.
"""

from __future__ import annotations

import json
import tomllib
from dataclasses import fields
from typing import TYPE_CHECKING

from pydantic import TypeAdapter, ValidationError

from sim.hardware import Hardware
from wire import ConfigError
from wire.robot import explain

if TYPE_CHECKING:
    from pathlib import Path

    from wire.robot import Base

_FILE = TypeAdapter(Hardware)
KNOWN = tuple(field.name for field in fields(Hardware))


SKID_TIMES = 1.6
"""A base that skids turns as if its wheels stood so many times as far apart as they do. Two wheels
there stand for four: what skidding costs in turns is modelled, its jerks are not."""


def load_metal(path: Path) -> Hardware:
    """Return the hardware that a file describes; the rest keeps its defaults.

    Raises:
        ConfigError: it is missing, no TOML, or has an unknown key or an impossible value.
    """
    try:
        told = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise ConfigError("metal_missing", f"{path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ConfigError("metal_syntax", f"{path}: {error}") from None
    unknown = sorted(told.keys() - set(KNOWN))
    if unknown:
        text = f"{path}: unknown key {', '.join(map(repr, unknown))}, known: {', '.join(KNOWN)}"
        raise ConfigError("metal_invalid", text)
    try:
        return _FILE.validate_json(json.dumps(told))  # strict, but for a dataclass of a mapping
    except TypeError as error:
        raise ConfigError("metal_invalid", f"{path}: {error}") from None
    except ValidationError as error:
        raise ConfigError("metal_invalid", f"{path}: {explain(error)}") from None


def true_base(believed: Base, hardware: Hardware) -> Base:
    """Return the geometry that the physics has: the hardware's own where it says so."""
    radius_m, separation_m = hardware.wheel_radius_m, hardware.wheel_separation_m
    if separation_m is None and believed.wheels_apart_m is not None:
        separation_m = SKID_TIMES * believed.wheels_apart_m
    return believed.model_copy(
        update={
            "wheel_radius_m": believed.wheel_radius_m if radius_m is None else radius_m,
            "wheel_separation_m": (
                believed.wheel_separation_m if separation_m is None else separation_m
            ),
        }
    )
