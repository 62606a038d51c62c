"""Robot and Pons speak over a true socket: these keys, this way, and nothing else."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pons.robot_processes import free_port
from ros2.pons_ros2.pons_ros2.link import OpenToAll, PlannerLink, is_loopback
from ros2.robot_link import RobotLink

LIMIT_S = 20.0


def until(done: Callable[[], object]) -> None:
    end_s = time.monotonic() + LIMIT_S
    while not done():
        assert time.monotonic() < end_s, "nothing came of it"
        time.sleep(0.01)


@pytest.fixture
def locator() -> str:
    return f"tcp/127.0.0.1:{free_port()}"


@pytest.fixture
def robot(locator: str) -> Iterator[PlannerLink]:
    made = PlannerLink(locator, has_key=False)
    yield made
    made.close()


def test_words_go_both_ways_and_heads_beside_bytes(robot: PlannerLink, locator: str) -> None:
    heard: list[str] = []
    robot.hear("command", heard.append)
    with RobotLink(locator, ("state", "picture", "odom")) as pons:
        until(lambda: pons.is_joined)
        until(lambda: robot.has_listener("state") and not robot.has_listener("map"))

        def commands() -> bool:
            pons.say("command", b"drive")
            return bool(heard)

        def states() -> bool:
            robot.say("state", {"seq": 1})
            return bool(pons.take("state"))

        until(commands)
        assert set(heard) == {"drive"}
        until(states)
        robot.say_bytes("picture", {"kind": "packed"}, b"abc")
        got: list[tuple[bytes, bytes]] = []

        def pictures() -> bool:
            got.extend(pons.take_headed("picture"))
            return bool(got)

        until(pictures)
        assert got == [(b'{"kind": "packed"}', b"abc")]
    until(lambda: not robot.has_listener("state"))


def test_a_robot_that_comes_late_is_found(locator: str) -> None:
    with RobotLink(locator, ("state",)) as pons:
        assert not pons.is_joined
        robot = PlannerLink(locator, has_key=False)
        until(lambda: pons.is_joined)
        robot.close()
        until(lambda: not pons.is_joined)


@pytest.mark.parametrize(
    ("listen", "is_ours"),
    [
        ("tcp/127.0.0.1:7448", True),
        ("tcp/[::1]:7448", True),
        ("tcp/localhost:7448", True),
        ("tcp/0.0.0.0:7448", False),
        ("tcp/192.168.1.7:7448", False),
        ("tcp/[::]:7448", False),
    ],
)
def test_beyond_the_loopback_it_listens_with_a_key_alone(listen: str, *, is_ours: bool) -> None:
    assert is_loopback(listen) is is_ours
    if not is_ours:
        with pytest.raises(OpenToAll):
            PlannerLink(listen, has_key=False)


def test_the_package_stands_alone(repository: Path) -> None:
    """It is copied to a robot where nothing else of Pons is."""
    ours = ("wire", "ros2", "bridge", "processes", "devices", "sim", "pons", "maps", "planner")
    for path in (repository / "ros2" / "pons_ros2" / "pons_ros2").glob("*.py"):
        for line in path.read_text("utf-8").splitlines():
            words = line.split()
            if words[:1] in (["import"], ["from"]):
                assert words[1].split(".")[0] not in ours, f"{path.name}: {line}"
