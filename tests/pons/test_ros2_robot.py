"""Map and lidar's place come from the node on a robot, over a true socket."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from pons.doctor import ros2_checks
from pons.doctor.finding import HealthVerdict
from pons.robot.command import run
from pons.robot_processes import free_port
from pons.ros2_robot import fetch_map, fetch_mounting
from pons.settings import LaunchSettings
from ros2.pons_ros2.pons_ros2.link import PlannerLink
from ros2.trouble import TopicFailure
from tests.ros2.test_mounting import transform
from tests.ros2.words import odometry, robot, scan, state

MAP = {
    "topic": "/map",
    "header": {"frame_id": "map"},
    "info": {
        "resolution": 0.1, "width": 3, "height": 2,
        "origin": {
            "position": {"x": -3.0, "y": 0.0},
            "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
        },
    },
}  # fmt: skip


@pytest.fixture
def locator() -> Iterator[str]:
    """Return where a robot says all that it knows, again and again."""
    where = f"tcp/127.0.0.1:{free_port()}"
    link, ending = PlannerLink(where, has_key=False), threading.Event()
    frames = [transform("base_link", "laser", (0.12, -0.03, 0.2), yaw_rad=1.5)]

    def say() -> None:
        seq = 0
        while not ending.wait(0.02):
            seq += 1
            link.say_bytes("map", MAP, bytes([0, 100, 255, 0, 0, 0]))
            link.say("scan", scan(seq / 50).decode())
            link.say("frames", frames)
            link.say("state", state(seq / 50, seq).decode())
            link.say("odom", odometry(seq / 50).decode())

    thread = threading.Thread(target=say)
    thread.start()
    yield where
    ending.set()
    thread.join()
    link.close()


def test_a_map_is_read_as_every_map_is(locator: str) -> None:
    made = fetch_map(locator, "/map").grid
    assert (made.width, made.height, made.resolution_m) == (3, 2, 0.1)
    with pytest.raises(TopicFailure, match="parameter map names /map, not /other"):
        fetch_map(locator, "/other")


def test_where_the_lidar_sits_is_found_by_the_frames(locator: str) -> None:
    found, frame = fetch_mounting(locator)
    assert (frame, found.base) == ("laser", "base_link")
    assert (found.x_m, found.y_m, found.yaw_rad) == pytest.approx((0.12, -0.03, 1.5))


def test_the_doctor_hears_the_node_and_says_where_nobody_answers(
    locator: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    described = robot(scan=False, imu=False, node=locator)
    assert ros2_checks.ros2(tmp_path, described).verdict is HealthVerdict.OK
    monkeypatch.setattr(ros2_checks, "ASK_S", 0.2)
    absent = robot(node=f"tcp/127.0.0.1:{free_port()}")
    found = ros2_checks.ros2(tmp_path, absent)
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_node" in json.dumps([str(found)])


def test_the_package_is_written_into_a_new_folder_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 1)
    folder = tmp_path / "src" / "pons_ros2"
    assert run(settings, ["node", str(folder)]) == 0
    for name in ("package.xml", "setup.py", "launch/pons.launch.py", "config/pons.yaml",
                 "resource/pons_ros2", "pons_ros2/node.py"):  # fmt: skip
        assert (folder / name).is_file(), name
    assert run(settings, ["node", str(folder)]) == 3
    assert "node_not_written" in capsys.readouterr().err
