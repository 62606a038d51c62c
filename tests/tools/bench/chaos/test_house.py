"""Processes are known by their command lines, sockets wherever they lie below ``run``."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.children import children
from pons.settings import CHECKOUT, LaunchSettings
from processes.parent_death import child_command, worker_command
from tools.bench.chaos.draw import OWNER_OF, PROCESSES
from tools.bench.chaos.faults import sockets
from tools.bench.chaos.house import role
from wire import load_robot

WORKER = list(worker_command("MODULE"))[:-1]


def test_every_child_of_pons_up_has_a_name_of_ours() -> None:
    robot = CHECKOUT / "robot.toml"
    settings = LaunchSettings(Path("/h"), robot, CHECKOUT / "sites" / "home", "127.0.0.1", 1)
    told = [
        role([*child_command(*child.arguments)]) for child in children(settings, load_robot(robot))
    ]
    assert sorted(told) == ["bridge", "camera", "localization", "planner", "sim"]
    assert set(told) < set(PROCESSES)


@pytest.mark.parametrize(
    ("words", "name"),
    [
        ([*WORKER, "planner.navigation.process_main", "/site"], "route"),
        ([*WORKER, "planner.perception.process_main", "{}"], "vision"),
        ([*WORKER, "planner.voice.process_main"], "voice"),
        (["python", "-I", "-c", "from bridge.recording.__main__ import main", "/home"], "recorder"),
        (["python", "-m", "pons", "stop"], ""),
        ([], ""),
    ],
)
def test_the_others_do_too(words: list[str], name: str) -> None:
    assert role(words) == name


def test_a_socket_is_found_in_a_folder_of_its_own_too(tmp_path: Path) -> None:
    (tmp_path / "run" / "robot").mkdir(parents=True)
    for path in ("run/bridge.sock", "run/robot/robot.sock"):
        (tmp_path / path).touch()
    assert [path.name for name in OWNER_OF for path in sockets(tmp_path, name)] == [
        "bridge.sock",
        "robot.sock",
    ]
