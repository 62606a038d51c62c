"""A metal file changes the simulated robot and nothing that the bridge believes."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.hardware import Hardware
from sim.true_parameters import load_metal, true_base
from wire import ConfigError
from wire.robot import Base


def written(folder: Path, text: str) -> Path:
    path = folder / "metal.toml"
    path.write_text(text, "utf-8")
    return path


def test_what_is_left_out_is_as_always(tmp_path: Path) -> None:
    path = written(tmp_path, "right_gain = 0.9\nwheel_radius_m = 0.095\nlidar_beams = 180\n")
    assert load_metal(path) == Hardware(right_gain=0.9, wheel_radius_m=0.095, lidar_beams=180)
    assert load_metal(written(tmp_path, "")) == Hardware()


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("left_gian = 1.0", "metal_invalid", "known: mass_kg, wheel_radius_m"),
        ("left_gain = 7.0", "metal_invalid", "less than or equal to 2"),
        ("left_gain = nan", "metal_invalid", "left_gain"),
        ("mass_kg = inf", "metal_invalid", "mass_kg"),
        ('mass_kg = "20"', "metal_invalid", "mass_kg"),
        ("mass_kg = 2020-01-01", "metal_invalid", "date"),
        ("mass_kg", "metal_syntax", "metal.toml"),
    ],
)
def test_what_cannot_be_is_refused(tmp_path: Path, text: str, code: str, said: str) -> None:
    with pytest.raises(ConfigError, match=said) as refused:
        load_metal(written(tmp_path, text))
    assert refused.value.code == code


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="No such file"):
        load_metal(tmp_path / "none.toml")


def test_only_wheels_differ_from_the_description() -> None:
    believed = Base(wheel_radius_m=0.1, wheel_separation_m=0.5, radius_m=0.3)
    assert true_base(believed, Hardware()) == believed
    true = true_base(believed, Hardware(wheel_separation_m=0.52))
    assert true == Base(wheel_radius_m=0.1, wheel_separation_m=0.52, radius_m=0.3)
