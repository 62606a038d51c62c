"""Keep one running two-room robot for all stories; a story that breaks it gets the next a new one.

Owns the life of the shared robot and what a failed story shows.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.e2e.robot import Robot
from tests.e2e.system import new_home


class Garage:
    """Hand out a robot at rest; make a new one where the old one can't be brought to rest."""

    def __init__(self) -> None:
        self._robot: Robot | None = None
        self._homes: list[TemporaryDirectory[str]] = []

    def robot(self) -> Robot:
        """Return the robot, at rest."""
        if self._robot is not None and self._robot.healthy():
            try:
                self._robot.rest()
            except (AssertionError, OSError):
                self._scrap()
            else:
                return self._robot
        else:
            self._scrap()
        home = new_home()
        self._homes.append(home)
        self._robot = Robot(Path(home.name))
        self._robot.start()
        self._robot.rest()
        return self._robot

    def _scrap(self) -> None:
        if self._robot is not None:
            self._robot.system.destroy()
            self._robot.judge.close()
            self._robot = None

    def close(self) -> None:
        """End the robot as a person would, and hold that nothing is left."""
        if self._robot is not None:
            self._robot.close()
        for home in self._homes:
            home.cleanup()


@pytest.fixture(scope="session")
def garage() -> Iterator[Garage]:
    """Keep the shared robot until the last story."""
    made = Garage()
    yield made
    made.close()


@pytest.fixture
def robot(garage: Garage) -> Robot:
    """Return a robot at rest on the two-room site."""
    return garage.robot()


@pytest.fixture
def home() -> Iterator[Path]:
    """Return an empty folder with a name short enough for sockets."""
    with new_home() as folder:
        yield Path(folder)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Iterator[None]:
    """Show the ends of all logs, and the bridge's last events, beside a failed story."""
    report = yield
    robots = [found for found in getattr(item, "funcargs", {}).values() if isinstance(found, Robot)]
    if getattr(report, "failed", False):
        for found in robots:
            report.sections.append(("logs", found.system.logs()))
            report.sections.append(("bridge events", _events(found)))
    return report


def _events(robot: Robot) -> str:
    newest = robot.judge.events.since(0.0)[-40:]
    return "\n".join(f"{at_s:.3f} {e.mode} {e.code} {e.detail}" for at_s, e in newest)
