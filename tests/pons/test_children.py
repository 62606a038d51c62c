"""``pons up`` starts what the robot has, in order; what nothing waits for comes last."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.settings import Settings
from pons.up import children
from wire import RobotDescription

ROBOT = ["sim", "localization", "bridge", "planner"]


@pytest.mark.parametrize(
    ("kind", "expected"),
    [("sim", [*ROBOT, "camera"]), ("node", ROBOT), ("none", ROBOT)],
)
def test_the_simulated_camera_waits_until_the_rest_is_ready(
    tmp_path: Path, kind: str, expected: list[str]
) -> None:
    settings = Settings(tmp_path, tmp_path / "robot.toml", tmp_path, "127.0.0.1", 8420)
    robot = RobotDescription.model_validate({"camera": {"kind": kind}})
    found = children(settings, robot)
    assert [child.name for child in found] == expected
    assert [child.name for child in found if child.waits_for_ready] == expected[4:]
    assert [child.name for child in found if child.knows_tokens] == ["planner"]
    assert all(child.arguments[0] in (child.name, f"sim.{child.name}") for child in found)
