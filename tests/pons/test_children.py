"""``pons up`` starts what the robot has, in order; what nothing waits for comes last."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from pons.children import children
from pons.launch_checks import CannotStart, check
from pons.launch_words import brain_example
from pons.settings import CHECKOUT, LaunchSettings
from pons.supervisor import REFUSED_TO_START
from wire import RobotDescription

pytestmark = pytest.mark.nightly(keep=14)


ROBOT = ["sim", "localization", "bridge", "planner"]


def settings_in(folder: Path, **more: Any) -> LaunchSettings:
    given = {"site": folder, "robot": folder / "robot.toml", "port": 8420, **more}
    return LaunchSettings(folder, host="127.0.0.1", **given)


def arguments_of(folder: Path, robot: object, **more: Any) -> dict[str, list[str]]:
    """Return the arguments of each process of a robot that is described so."""
    described = RobotDescription.model_validate(robot)
    return {one.name: one.arguments for one in children(settings_in(folder, **more), described)}


@pytest.mark.parametrize(
    ("kind", "expected"),
    [("sim", [*ROBOT, "camera"]), ("node", ROBOT), ("none", ROBOT)],
)
def test_the_simulated_camera_waits_until_the_rest_is_ready(
    tmp_path: Path, kind: str, expected: list[str]
) -> None:
    robot = RobotDescription.model_validate({"camera": {"kind": kind}})
    found = children(settings_in(tmp_path), robot)
    assert [child.name for child in found] == expected
    assert [child.name for child in found if child.waits_for_ready] == expected[4:]
    assert [child.name for child in found if child.knows_tokens] == ["planner"]
    assert all(child.arguments[0] in (child.name, f"sim.{child.name}") for child in found)


MCU = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 4096}
ROS2 = {"node": "tcp/10.0.0.5:7448"}
LD19 = {"kind": "ld19", "port": "/dev/y"}


@pytest.mark.parametrize(
    ("drive", "lidar", "twin", "expected"),
    [
        (MCU, {}, False, ["bridge", "planner"]),
        (MCU, LD19, False, ["lidar", "localization", "bridge", "planner"]),
        (MCU, {}, True, [*ROBOT, "camera"]),
        (MCU, LD19, True, ["sim", "lidar", *ROBOT[1:], "camera"]),
        ({}, LD19, True, ["sim", "lidar", *ROBOT[1:], "camera"]),
    ],
)
def test_a_robot_of_metal_has_what_its_file_names_and_a_twin_what_it_plays(
    tmp_path: Path,
    drive: dict[str, object],
    lidar: dict[str, object],
    twin: bool,
    expected: list[str],
) -> None:
    found = arguments_of(tmp_path, {"drive": drive, "lidar": lidar}, twin=twin)
    assert list(found) == expected
    assert ("--drive-port" in found["bridge"]) == (twin and bool(drive))
    if "lidar" in found:
        assert found["lidar"][0] == "sensors.lidar"
        assert ("--port" in found["lidar"]) == twin
    if "sim" in found:
        assert ("--twin" in found["sim"]) == bool(drive)
        assert ("--lidar-twin" in found["sim"]) == bool(lidar)


@pytest.mark.parametrize("kind", ["uvc", "stream", "realsense", "ros2", "node", "none"])
@pytest.mark.parametrize("twin", [False, True])
def test_a_camera_of_metal_has_its_process_and_where_a_twin_plays_is_drawn(
    tmp_path: Path, kind: str, twin: bool
) -> None:
    keys = {
        "uvc": {"device": "/dev/video0"},
        "stream": {"url": "rtsp://10.0.0.9/1"},
    }
    base: dict[str, dict[str, object]] = {"drive": MCU}
    if kind == "ros2":
        base = {"drive": {"kind": "ros2"}, "ros2": dict(ROS2), "inputs": {"imu": False}}
    robot = RobotDescription.model_validate(base | {"camera": {"kind": kind, **keys.get(kind, {})}})
    found = arguments_of(tmp_path, robot, twin=twin)
    assert ("camera" in found) == robot.camera.is_real
    if robot.camera.is_real:
        assert found["camera"][0] == ("sim.camera" if twin else "sensors.camera")


@pytest.mark.parametrize("twin", [False, True])
@pytest.mark.parametrize("counts", [False, True])
def test_a_gyro_on_i2c_has_its_process_where_metal_counts_on_it(
    tmp_path: Path, twin: bool, counts: bool
) -> None:
    chip = {"kind": "mpu6050", "bus": 1, "address": 0x68} if counts else {}
    robot = {"drive": MCU, "imu": chip, "inputs": {"imu": counts}}
    found = arguments_of(tmp_path, robot, twin=twin)
    assert ("imu" in found) == (counts and not twin)
    if "imu" in found:
        assert found["imu"][0] == "sensors.imu"


@pytest.mark.parametrize(
    ("twin", "expected"),
    [
        (False, ["ros2", "localization", "bridge", "planner"]),
        (True, ["sim", "ros2", *ROBOT[1:], "camera"]),
    ],
)
def test_a_base_of_ros2_has_its_process_and_its_twin_a_node_that_this_dials(
    tmp_path: Path, twin: bool, expected: list[str]
) -> None:
    robot = {"drive": {"kind": "ros2"}, "lidar": {"kind": "ros2"}, "ros2": ROS2}
    found = arguments_of(tmp_path, robot, twin=twin)
    assert list(found) == expected
    assert ("--port" in found["ros2"]) == twin
    assert "--drive-port" not in found["bridge"]
    if twin:
        port = found["sim"][found["sim"].index("--ros2-twin") + 1]
        assert found["ros2"][-1] == port
        assert not {"--twin", "--lidar-twin"} & set(found["sim"])


@pytest.mark.parametrize(
    ("text", "twin", "code"),
    [
        ("", True, "twin_needless"),
        ('[camera]\nkind = "uvc"\ndevice = "/dev/video0"\n', False, "camera_of_another_world"),
        ('[lidar]\nkind = "ld19"\nport = "/dev/y"\n', False, "lidar_of_another_world"),
    ],
)
def test_up_refuses_what_would_see_another_world_than_it_drives_in(
    tmp_path: Path, text: str, twin: bool, code: str
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(text)
    site = CHECKOUT / "sites" / "two_room"
    settings = LaunchSettings(tmp_path, path, site, "127.0.0.1", 8420, twin=twin)
    with pytest.raises(CannotStart, match=code):
        check(settings)


@pytest.mark.parametrize("name", [*ROBOT, "camera"])
def test_no_child_calls_a_home_that_cannot_be_written_a_wrong_setting(
    tmp_path: Path, free_port: int, name: str
) -> None:
    """A wrong setting ends ``pons up``, and no systemd starts that process again."""
    home = tmp_path / "home"
    home.write_text("a file where a folder should be")
    site = CHECKOUT / "sites" / "two_room"
    settings = LaunchSettings(home, CHECKOUT / "robot.toml", site, "127.0.0.1", free_port)
    (child,) = (one for one in children(settings, RobotDescription()) if one.name == name)
    done = subprocess.run(
        [sys.executable, "-m", *child.arguments],
        cwd=CHECKOUT, capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode not in (0, REFUSED_TO_START), done.stderr
    assert f"{name}: home_unwritable: " in done.stderr


def test_what_may_be_tried_without_a_planner_is_there_to_be_tried(tmp_path: Path) -> None:
    python, file, *rest = brain_example(tmp_path).split()
    assert (python, rest) == ("python", ["--home", str(tmp_path)])
    assert Path(file).is_file()
    assert brain_example(tmp_path, root=tmp_path).startswith("a brain of your own ")


@pytest.mark.parametrize(
    ("text", "planner", "joins"),
    [
        ('[mqtt]\nhost = "broker"\n', True, True),
        ('[mqtt]\nhost = "broker"\n', False, False),
        ("[budget]\n", True, False),
        ("[mqtt", True, False),
        (None, True, False),
    ],
)
def test_a_smart_home_is_joined_last_where_the_owner_names_its_broker(
    tmp_path: Path, text: str | None, planner: bool, joins: bool
) -> None:
    if text is not None:
        (tmp_path / "settings.toml").write_text(text)
    found = children(settings_in(tmp_path), RobotDescription(), planner=planner)
    home = [child for child in found if child.name == "mqtt"]
    assert len(home) == joins
    assert all(each.waits_for_ready and not each.knows_tokens for each in home)


def test_while_a_home_is_mapped_only_the_simulator_knows_it(tmp_path: Path) -> None:
    world = CHECKOUT / "sites" / "two_room"
    found = arguments_of(tmp_path, {}, site=world, mapping="attic")
    canvas = str(tmp_path / "mapping" / "attic")
    sites = {name: words[words.index("--site") + 1] for name, words in found.items()}
    assert sites == {
        "sim": str(world),
        "camera": str(world),
        "localization": canvas,
        "bridge": canvas,
        "planner": canvas,
    }
    assert [name for name, words in found.items() if "--mapping" in words] == ["localization"]
    assert [name for name, words in found.items() if "--may-map" in words] == ["planner"]
