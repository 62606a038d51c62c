"""``pons up`` says what it drives, and waits for a robot that looks for its place, not silence."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from planner.brain import OfflineBrain, ThinkRequest
from planner.plan import Means, StepPlan, Vocabulary
from pons.launch_checks import CannotStart
from pons.launch_words import what_to_try
from pons.running import RunningNote
from pons.settings import CHECKOUT, LaunchSettings
from pons.terminal import command_path
from pons.up import READY_LIMIT_S, SEARCH_TOLD_S, UNREACHED_TOLD_S, Supervisor, describe_base
from tests.planner.api.serving import served
from tests.pons.test_readiness import starting
from wire import RobotDescription, load_robot
from wire.lidar_config import LidarConfig

HOUR_S = 3600.0
ROS2 = "ros2_diff_drive.toml"


def supervisor(tmp_path: Path, port: int, robot: RobotDescription | None = None) -> Supervisor:
    site = CHECKOUT / "sites" / "two_room"
    settings = LaunchSettings(tmp_path, CHECKOUT / "robot.toml", site, "127.0.0.1", port)
    note = RunningNote(settings, "r1")
    return Supervisor(settings, robot or RobotDescription(), note, planner=True)


def test_a_robot_that_looks_for_its_place_is_told_of_once_and_waited_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of two rooms that are alike a person must say which; the page was taken from them before."""
    services = starting(("localization",), "searching")
    with served(services) as planner:
        up = supervisor(tmp_path, planner.port)
        up._greet(100.0, 100.0)
        up._greet(100.0 + SEARCH_TOLD_S - 1.0, 100.0)
        assert capsys.readouterr().out == ""
        for now_s in (100.0 + SEARCH_TOLD_S + 1.0, 100.0 + HOUR_S):
            up._greet(now_s, 100.0)
        told = capsys.readouterr().out
        assert told.count(f"http://127.0.0.1:{planner.port}") == 1
        assert "looking for where it is, and stands still" in told
        services.robot.localizer = None
        up._greet(100.0 + HOUR_S + READY_LIMIT_S - 1.0, 100.0)
        with pytest.raises(CannotStart, match="not_ready"):
            up._greet(100.0 + HOUR_S + READY_LIMIT_S + 1.0, 100.0)


def test_once_it_is_found_it_is_ready(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    services = starting(("localization",), "searching")
    with served(services) as planner:
        up = supervisor(tmp_path, planner.port)
        up._greet(100.0, 100.0)
        up._greet(100.0 + HOUR_S, 100.0)
        services.robot = starting((), "tracking").robot
        up._greet(101.0 + HOUR_S, 100.0)
    assert "ready after" in capsys.readouterr().out


def test_a_localization_that_is_silent_is_not_waited_for(tmp_path: Path) -> None:
    with served(starting(("localization",), None)) as planner:
        up = supervisor(tmp_path, planner.port)
        up._greet(100.0, 100.0)
        with pytest.raises(CannotStart, match="not_ready"):
            up._greet(101.0 + READY_LIMIT_S, 100.0)


def test_a_ros2_robot_that_is_not_reached_is_told_at_once_and_keeps_its_page(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with served(starting(("localization", "bridge:drive"), None)) as planner:
        up = supervisor(tmp_path, planner.port, load_robot(CHECKOUT / "robots" / ROS2))
        (ros2,) = (child for child in up._children if child.name == "ros2")
        ros2.log.parent.mkdir(parents=True, exist_ok=True)
        ros2.log.write_text(
            "12:00 ros2 WARNING ros2_no_node: nobody answers at tcp/127.0.0.1:7448\n"
        )
        up._greet(100.0, 100.0)
        assert "ros2_no_node" not in capsys.readouterr().out
        up._greet(100.0 + UNREACHED_TOLD_S, 100.0)
        up._greet(101.0 + UNREACHED_TOLD_S, 100.0)
        told = capsys.readouterr().out
        assert (
            told.count("robot_unreached: ros2_no_node: nobody answers at tcp/127.0.0.1:7448") == 1
        )
        assert up._settings.url in told
        up._greet(101.0 + READY_LIMIT_S, 100.0)  # raises nothing: the page stays


def test_a_person_reads_whether_metal_is_driven(tmp_path: Path) -> None:
    plain = LaunchSettings(tmp_path, CHECKOUT / "robot.toml", CHECKOUT / "sites", "127.0.0.1", 1)
    twin = replace(plain, twin=True)
    lost = tmp_path / "robot.toml"
    lost.write_text('id = "mine"\n[base]\nwheel_radius_m = 0.1\n')
    mcu, ros2 = (load_robot(CHECKOUT / "robots" / name) for name in ("pons_mcu.toml", ROS2))
    assert describe_base(plain, load_robot(lost)) == "simulated"
    blind = "; no [lidar]: it will stand (docs/lidars.md)"
    assert describe_base(plain, mcu) == f"pons_mcu at /dev/ttyACM0{blind}"
    seeing = mcu.model_copy(update={"lidar": LidarConfig(kind="ld19", port="/dev/y")})
    assert describe_base(plain, seeing) == "pons_mcu at /dev/ttyACM0"
    assert describe_base(twin, mcu) == "pons_mcu, played by its twin"
    assert describe_base(plain, ros2) == "ros2"


def test_who_maps_a_home_is_told_what_the_page_can_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    maps = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 1, mapping="flat")
    assert "explore the house" in what_to_try(maps)
    assert what_to_try(maps).endswith(f"then: {command_path()} map flat")
    assert "forward" not in what_to_try(maps), "where it starts there may be no room ahead"
    nothing, can = Vocabulary(entries=()), Means(growing_map=True).runnable
    for said, locale in (("explore the house", "C"), ("探索一下房子", "zh_CN.UTF-8")):
        monkeypatch.setenv("LC_ALL", locale)
        assert said in what_to_try(maps)
        asked = ThinkRequest(text=said, vocabulary=nothing, runnable=can)
        assert isinstance(asyncio.run(OfflineBrain().think(asked)).plan, StepPlan)


def test_what_to_try_names_a_room_that_the_planner_knows(
    tmp_path: Path, free_port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    pons, site = command_path(), CHECKOUT / "sites" / "two_room"
    monkeypatch.setattr("pons.launch_words.ASKED_S", 10.0)  # a starved machine answers late
    with served() as planner:
        up = LaunchSettings(tmp_path, CHECKOUT / "robot.toml", site, "127.0.0.1", planner.port)
        assert what_to_try(up) == f'try: {pons} say "go to the living room"   {pons} stop'
        assert what_to_try(up, arms=True).startswith(f"try: {pons} arm ")
        monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
        assert what_to_try(up) == f"try: {pons} say 去客厅   {pons} stop"
    monkeypatch.delenv("LC_ALL")
    unreached = replace(up, port=free_port)
    assert what_to_try(unreached).startswith(f'try: {pons} say "go home"')
