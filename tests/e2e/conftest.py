"""Keep one running two-room robot for all stories; a story that breaks it gets the next a new one.

Owns the life of the shared robot and what a failed story shows.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.e2e.robot import Robot
from tests.e2e.system import new_home

FAILED = pytest.StashKey[bool]()
STORY_LIMIT_S = 120


class Garage:
    """Hand out one robot, story after story."""

    def __init__(self) -> None:
        self._robot: Robot | None = None
        self._homes: list[TemporaryDirectory[str]] = []

    def robot(self) -> Robot:
        """Return the robot, at rest."""
        if self._robot is not None:
            return self._robot
        home = new_home()
        self._homes.append(home)
        self._robot = Robot(Path(home.name))
        self._robot.start()
        self._robot.rest()
        return self._robot

    def scrap(self) -> None:
        """Give up a robot that a failed story has left in an unknown state."""
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


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Give stories longer than unit tests: a busy machine drives no slower but starts slower."""
    for item in items:
        if Path(__file__).parent in item.path.parents and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(STORY_LIMIT_S))


@pytest.fixture(scope="session")
def garage() -> Iterator[Garage]:
    """Keep the shared robot until the last story."""
    made = Garage()
    yield made
    made.close()


@pytest.fixture
def robot(garage: Garage, request: pytest.FixtureRequest) -> Iterator[Robot]:
    """Return a robot at rest on the two-room site; hold that every story ends where it can rest."""
    found = garage.robot()
    yield found
    if request.node.stash.get(FAILED, False):
        garage.scrap()
    else:
        found.rest()


@pytest.fixture
def home() -> Iterator[Path]:
    """Return an empty folder with a name short enough for sockets."""
    with new_home() as folder:
        yield Path(folder)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Show the ends of all logs, and the bridge's last events, beside a failed story."""
    report = yield
    if report.failed:
        item.stash[FAILED] = True
        watched = getattr(item, "funcargs", {}).values()
        for found in (thing for thing in watched if isinstance(thing, Robot)):
            report.sections.append(("logs", found.system.logs()))
            report.sections.append(("bridge events", _events(found)))
    return report


def _events(robot: Robot) -> str:
    newest = robot.judge.events.since(0.0)[-40:]
    return "\n".join(f"{at_s:.3f} {e.mode} {e.code} {e.detail}" for at_s, e in newest)
