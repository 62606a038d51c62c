"""A planner of goals; one drive through both rooms, for all that makes or mends a map of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from pons.settings import LaunchSettings, load
from pons_assets import ROBOT_FILE
from tests.bridge.recorded import Taken, stream_of, written
from tests.pons.drives import Drive, keep_ticks
from tests.pons.mock_llm.mocks import RunningMock, running_mock
from tests.pons.served_goals import Planner, served_goals
from tests.site_sentences import refusals_are_whole_in_chinese
from tools.lockstep import LockstepWorld

__all__ = ["refusals_are_whole_in_chinese"]


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    return LaunchSettings(
        home=tmp_path / "home", robot=ROBOT_FILE, site=tmp_path, host="127.0.0.1", port=1
    )


@pytest.fixture
def served() -> Iterator[tuple[Planner, LaunchSettings]]:
    planner = Planner()
    with served_goals(planner) as port:
        yield planner, replace(load(), host="127.0.0.1", port=port)


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    """Serve one mock of a model for a module's tests."""
    with running_mock() as served:
        yield served


@pytest.fixture(scope="session")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Drive:
    """Drive through both rooms; return the recording, the first and the last true pose."""
    ticks: list[Taken] = []

    world = LockstepWorld(seed=4, step=keep_ticks(ticks))
    start = world.truth
    for room in ("kitchen", "living room"):
        goal = world.say(f"go to the {room}")
        while not goal.has_ended:
            world.run(0.5)
    (path,) = written(tmp_path_factory.mktemp("drive"), stream_of(world.bridge.config, ticks))
    return path, start, world.truth, ticks
