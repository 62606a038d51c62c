"""``pons up`` says whether it drives metal."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from pons.settings import CHECKOUT, LaunchSettings
from pons.up import describe_base, what_to_try
from wire import load_robot

ROS2 = "ros2_diff_drive.toml"


def test_a_person_reads_whether_metal_is_driven(tmp_path: Path) -> None:
    plain = LaunchSettings(tmp_path, CHECKOUT / "robot.toml", CHECKOUT / "sites", "127.0.0.1", 1)
    twin = replace(plain, twin=True)
    lost = tmp_path / "robot.toml"
    lost.write_text('id = "mine"\n[base]\nwheel_radius_m = 0.1\n')
    mcu, ros2 = (load_robot(CHECKOUT / "robots" / name) for name in ("pons_mcu.toml", ROS2))
    assert describe_base(plain, load_robot(lost)) == "simulated"
    assert describe_base(plain, mcu) == "pons_mcu at /dev/ttyACM0"
    assert describe_base(twin, mcu) == "pons_mcu, played by its twin"
    assert describe_base(plain, ros2) == "ros2"


def test_who_maps_a_home_is_told_what_the_page_can_do(tmp_path: Path) -> None:
    maps = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 1, mapping="flat")
    assert "explore the house" in what_to_try(maps)
    assert what_to_try(maps).endswith("then: pons map flat")
