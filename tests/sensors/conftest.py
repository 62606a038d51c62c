"""Start a sensor's process with a table of robot.toml, and end it with the test."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


@pytest.fixture
def write_robot(tmp_path: Path, request: pytest.FixtureRequest) -> Callable[[str], Path]:
    """Return who writes a robot.toml with this text in the table of the test's ``SENSOR``."""

    def write(text: str) -> Path:
        path = tmp_path / "robot.toml"
        path.write_text(f"[{request.module.SENSOR}]\n{text}\n")
        return path

    return write


@pytest.fixture
def started(
    tmp_path: Path, request: pytest.FixtureRequest, write_robot: Callable[[str], Path]
) -> Iterator[Callable[[str], subprocess.Popen[str]]]:
    """Yield who starts the process of the test's ``SENSOR``."""
    processes: list[subprocess.Popen[str]] = []

    def start(text: str) -> subprocess.Popen[str]:
        words = ["--robot", str(write_robot(text)), "--home", str(tmp_path)]
        command = [sys.executable, "-m", f"sensors.{request.module.SENSOR}", *words]
        processes.append(subprocess.Popen(command, stderr=subprocess.PIPE, text=True))
        return processes[-1]

    yield start
    for process in processes:
        process.kill()
        process.communicate(timeout=30.0)
