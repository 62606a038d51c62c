"""``pons up`` waits for a robot that looks for its place, and not for a process that is silent."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.launch_checks import CannotStart
from pons.settings import CHECKOUT, LaunchSettings
from pons.up import READY_LIMIT_S, SEARCH_TOLD_S, Supervisor
from tests.planner.api.serving import served
from tests.pons.test_readiness import starting
from wire import RobotDescription

HOUR_S = 3600.0


def supervisor(tmp_path: Path, port: int) -> Supervisor:
    site = CHECKOUT / "sites" / "two_room"
    settings = LaunchSettings(tmp_path, CHECKOUT / "robot.toml", site, "127.0.0.1", port)
    return Supervisor(settings, RobotDescription(), planner=True)


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
        assert "期间停着不动" in told
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
