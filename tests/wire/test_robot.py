"""robot.toml is read whole or refused with every reason."""

from __future__ import annotations

from pathlib import Path

import pytest

from wire import ConfigError, RobotDescription, load_robot
from wire.drive_config import DriveConfig
from wire.imu_config import ImuConfig


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "robot.toml"
    path.write_text(text, "utf-8")
    return path


def test_an_empty_file_is_the_default_robot(tmp_path: Path) -> None:
    assert load_robot(written(tmp_path, "")) == RobotDescription()


def test_values_are_taken_and_change_the_hash(tmp_path: Path) -> None:
    robot = load_robot(written(tmp_path, "[limits]\nmax_speed_mps = 0.3\n"))
    assert robot.limits.max_speed_mps == 0.3
    assert robot.hash != RobotDescription().hash
    assert robot.hash == load_robot(tmp_path / "robot.toml").hash


MCU = "[drive]\nkind = 'pons_mcu'\nticks_per_turn = 4096\n"


@pytest.mark.parametrize(
    ("text", "code", "named"),
    [
        ("max_sped_mps = 1", "robot_toml_invalid", "unknown key 'max_sped_mps', known there: id, "),
        ("[limits]\nmax_sped_mps = 1", "robot_toml_invalid",
         "unknown key 'limits.max_sped_mps', known there: max_speed_mps, "),
        ("[limits]\nmax_speed_mps = 50.0", "robot_toml_invalid", "limits.max_speed_mps: got 50.0"),
        ("[limits]\nmax_speed_mps = nan", "robot_toml_invalid", "limits.max_speed_mps"),
        ("[limits]\nmax_speed_mps = inf", "robot_toml_invalid", "limits.max_speed_mps"),
        ("[limits]\nmax_decel_mps2 = 0.0", "robot_toml_invalid", "limits.max_decel_mps2"),
        ("[limits]\nmax_decel_mps2 = '1'", "robot_toml_invalid", "limits.max_decel_mps2"),
        ("[recording]\nfile_mb = 1024\ntotal_mb = 4095", "robot_toml_invalid",
         "must hold four files"),
        ("[limits]\nhardest_decel_mps2 = 0.5", "robot_toml_invalid", "hardest_decel_mps2"),
        ("[limits]\nmax_wheel_radps = 1.0", "robot_toml_invalid", "cannot be reached"),
        ("[drive]\ntimeout_s = 0.0", "robot_toml_invalid", "drive.timeout_s"),
        ("[drive]\ntimeout_s = 10.0", "robot_toml_invalid", "drive.timeout_s"),
        ("[drive]\nkind = 'warp'", "robot_toml_invalid", "drive.kind"),
        ("[drive]\nport = '/dev/ttyACM0'", "robot_toml_invalid",
         "drive.port is for pons_mcu, waveshare, arduino, turtlebot3, not for kind 'sim'"),
        ("[drive]\nkind = 'pons_mcu'", "robot_toml_invalid",
         ("drive.port is missing: kind 'pons_mcu' needs port, ticks_per_turn; "
         "drive.ticks_per_turn is missing")),
        (f"{MCU}port = 'ttyACM0'", "robot_toml_invalid", "drive.port: got 'ttyACM0'"),
        (f"{MCU}port = '/dev/x'\nbattery_full_v = 12.0", "robot_toml_invalid",
         "come together or not at all"),
        (f"{MCU}port = '/dev/x'\nbattery_full_v = 9.0\nbattery_empty_v = 9.0",
         "robot_toml_invalid", "drive.battery_empty_v 9.0 must be less than battery_full_v 9.0"),
        ("[drive]\nvirtual = true", "robot_toml_invalid", "unknown key 'drive.virtual'"),
        ("[camera]\ndepth_min_m = 1.0\ndepth_max_m = 1.0", "robot_toml_invalid",
         "camera.depth_min_m 1.0 must be less than"),
        ("[lidar]\nscan_s = 1.0", "robot_toml_invalid", "lidar.scan_s"),
        ("[lidar]\nrange_min_m = 1.0", "robot_toml_invalid",
         "lidar.range_min_m 1.0 must be at most 0.35: "),
        ("[lidar]\nx_m = -0.18\ny_m = 0.24", "robot_toml_invalid",
         "lidar.range_min_m 0.12 must be at most 0.05: "),
        ("[lidar]\ny_m = 0.31", "robot_toml_invalid", "outside base.radius_m 0.3: "),
        (
            '[drive]\nkind = "waveshare"\nport = "/dev/x"\n[lidar]\nkind = "ld19"\nport = "/dev/x"',
            "robot_toml_invalid",
            "both /dev/x: two adapters that call themselves alike",
        ),
        ("[base]\nradius_m = 0.24", "robot_toml_invalid",
         "base.radius_m 0.24 must be at least 0.25, "),
        ("[base]\nradius_m = 0.1\n[lidar]\nrange_min_m = 0.2", "robot_toml_invalid",
         "lidar.range_min_m 0.2 must be at most 0.15: "),
        ("[drive]\npeak_current_a = 15.0", "robot_toml_invalid", "must be less than"),
        ("[drive]\npeak_current_a = 150.1", "robot_toml_invalid",
         "drive.peak_current_a 150.1 must be at most 10 times"),
        ("id = 'r1/../x'", "robot_toml_invalid", "id"),
        ("[limits", "robot_toml_syntax", "robot.toml"),
        ("a = " + "[" * 10_000, "robot_toml_syntax", "nested too deeply"),
        ("a = " + "9" * 5_000, "robot_toml_syntax", "robot.toml"),
    ],
)  # fmt: skip
def test_what_is_unknown_or_unsafe_refuses(
    tmp_path: Path, text: str, code: str, named: str
) -> None:
    with pytest.raises(ConfigError) as refused:
        load_robot(written(tmp_path, text))
    assert refused.value.code == code
    assert named in refused.value.detail


@pytest.mark.parametrize(
    "text",
    [
        "[lidar]\nrange_min_m = 0.35",
        "[lidar]\nx_m = 0.3\nrange_min_m = 0.05",
        "[base]\nradius_m = 0.25",
        "[drive]\npeak_current_a = 150.0",
    ],
)
def test_what_just_fits_is_taken(tmp_path: Path, text: str) -> None:
    load_robot(written(tmp_path, text))


def test_every_fault_is_named_at_once(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as refused:
        load_robot(written(tmp_path, "a = 1\nb = 2\n[limits]\nmax_speed_mps = -1.0"))
    for name in ("'a'", "'b'", "limits.max_speed_mps"):
        assert name in refused.value.detail


def test_a_missing_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as refused:
        load_robot(tmp_path / "robot.toml")
    assert refused.value.code == "robot_toml_missing"


def test_bytes_that_are_no_text_are_said(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError) as refused:
        load_robot(path)
    assert refused.value.code == "robot_toml_syntax"


def test_a_peak_current_below_the_continuous_one_is_refused() -> None:
    with pytest.raises(ValueError, match="must be less than"):
        DriveConfig(peak_current_a=10.0, continuous_current_a=10.0)


def test_a_gyro_is_the_bases_own_or_a_chip_on_i2c() -> None:
    chip = {"kind": "mpu6050", "bus": 1, "address": 0x68}
    bare: dict[str, object] = {}
    mcu = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 1320}
    ugv = {"kind": "waveshare", "port": "/dev/x"}
    for drive, imu, expected in ((mcu, bare, False), (mcu, chip, True), (ugv, bare, True)):
        robot = RobotDescription.model_construct(
            drive=DriveConfig.model_construct(**drive), imu=ImuConfig.model_validate(imu)
        )
        assert robot.has_gyro is expected


@pytest.mark.parametrize("separation_m", [0.29, 3.0])
def test_wheels_that_skid_turn_the_robot_less_and_never_more(separation_m: float) -> None:
    base = {"wheels_apart_m": 0.3, "wheel_separation_m": separation_m}
    with pytest.raises(ValueError, match="times wheels_apart_m"):
        RobotDescription.model_validate({"base": base})
