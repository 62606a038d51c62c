"""Whether a robot that starts is ready, waits, or looks for its place: as a real API tells it."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import pytest

from pons.readiness import Readiness, ask_readiness
from pons.settings import LaunchSettings
from tests.planner.api.fakes import FakeRobot, FakeServices
from tests.planner.api.serving import served
from tests.wire.examples import EXAMPLES, STATUS
from wire import LocalizerStatus

Said = Literal["searching", "tracking", "coasting", "lost"]


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wait as long as a starved machine needs for the first answer of a server."""
    monkeypatch.setattr("pons.readiness.TIMEOUT_S", 10.0)


class StartingRobot(FakeRobot):
    """Be a robot whose processes answer, but for those that a test names."""

    silent: tuple[str, ...] = ()

    def ages_s(self) -> dict[str, float | None]:
        """Return how old the newest word of each is."""
        names = ("status", "localization", "scan")
        return {name: None if name in self.silent else 0.1 for name in names}


def settings_for(tmp_path: Path, port: int) -> LaunchSettings:
    return LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", port)


def starting(silent: tuple[str, ...], state: Said | None) -> FakeServices:
    services = FakeServices()
    made = StartingRobot(STATUS.model_copy(update={"waiting_for": ()}))
    made.silent = silent
    said = EXAMPLES[LocalizerStatus]
    assert isinstance(said, LocalizerStatus)
    made.localizer = None if state is None else said.model_copy(update={"state": state})
    services.robot = made
    return services


@pytest.mark.parametrize(
    ("silent", "state", "wanted"),
    [
        ((), "tracking", Readiness.READY),
        (("localization",), "searching", Readiness.SEARCHING),
        (("localization",), "lost", Readiness.SEARCHING),
        (("localization",), None, Readiness.WAITING),
        (("localization",), "tracking", Readiness.WAITING),
        (("localization", "scan"), "searching", Readiness.WAITING),
        (("status",), "tracking", Readiness.WAITING),
    ],
)
def test_a_search_is_told_from_a_process_that_is_silent(
    tmp_path: Path, silent: tuple[str, ...], state: Said | None, wanted: Readiness
) -> None:
    with served(starting(silent, state)) as planner:
        assert ask_readiness(settings_for(tmp_path, planner.port)) is wanted


def test_in_set_up_an_answer_is_enough(tmp_path: Path) -> None:
    with served(starting(("localization", "scan"), None)) as planner:
        assert ask_readiness(settings_for(tmp_path, planner.port), set_up=True) is Readiness.READY


def test_nobody_there_is_waited_for(tmp_path: Path, free_port: int) -> None:
    assert ask_readiness(settings_for(tmp_path, free_port)) is Readiness.WAITING
