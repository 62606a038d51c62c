"""The wheel carries what a robot runs, and nothing of tests, benches, attacks or training."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from setuptools import find_packages

PRODUCT = {
    "processes",
    "devices",
    "pons_assets",
    "wire",
    "maps",
    "planner",
    "localization",
    "bridge",
    "sensors",
    "ros2",
    "sim",
    "lockstep",
    "pons",
    "fleet",
}
LEFT_OUT = {"tools", "tests", "scripts", "examples", "train", "bench", "attack"}


@pytest.fixture(scope="module")
def packages(repository: Path) -> set[str]:
    """Return the packages that the build would put into a wheel."""
    project = tomllib.loads((repository / "pyproject.toml").read_text("utf-8"))
    find: dict[str, Any] = project["tool"]["setuptools"]["packages"]["find"]
    return {
        name
        for folder in find["where"]
        for name in find_packages(
            str(repository / folder), exclude=find.get("exclude", ()), include=find["include"]
        )
    }


def test_the_wheel_carries_every_package_that_a_robot_runs(packages: set[str]) -> None:
    assert {name.partition(".")[0] for name in packages} == PRODUCT


def test_the_wheel_carries_no_tool_and_no_test(packages: set[str]) -> None:
    assert [name for name in packages if LEFT_OUT & set(name.split("."))] == []


def test_no_module_of_the_product_is_left_out(repository: Path, packages: set[str]) -> None:
    """A folder without ``__init__.py`` would be; launch files of ROS go as assets (setup.py)."""
    folders = {
        file.parent.relative_to(repository)
        for part in PRODUCT
        for file in (repository / part).rglob("*.py")
        if not file.match("pons_ros2/launch/*.launch.py")
    }
    assert {".".join(folder.parts) for folder in folders} == packages
