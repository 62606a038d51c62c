"""One run follows the other where the page asks for it; what can't be begun leaves the one before.

The planner is played by a process that ends with statuses in turn; all that supervises is real.
"""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from pons import launch
from pons.settings import CHECKOUT, LaunchSettings, load
from pons.supervisor import REFUSED_TO_START, Child
from wire import EXIT_MAP, RobotDescription

TWO_ROOM = CHECKOUT / "sites" / "two_room"
Ends = Callable[..., list[str]]


@pytest.fixture
def up(
    tmp_path: Path, free_port: int, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[..., list[str]]]:
    """Return what runs ``pons up`` with a planner's statuses and tells the sites that it had."""
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    mask, handlers = os.umask(0o022), [signal.getsignal(each) for each in signals]
    said = tmp_path / "statuses"

    def planner(settings: LaunchSettings, _robot: RobotDescription, **_: object) -> list[Child]:
        site = settings.canvas or settings.site
        words = ["tests.pons.ending_planner", str(said), str(site)]
        return [Child("planner", words, settings.home / "logs" / "planner.log")]

    def run(*statuses: int, mapping: str | None = None) -> list[str]:
        said.write_text(" ".join(map(str, statuses)), "utf-8")
        settings = LaunchSettings(
            tmp_path, CHECKOUT / "robot.toml", TWO_ROOM, "127.0.0.1", free_port, mapping=mapping
        )
        assert launch.run(settings) == REFUSED_TO_START, "the planner refuses in the end"
        return said.read_text("utf-8").splitlines()[1:]

    monkeypatch.setattr("pons.up.children", planner)
    yield run
    os.umask(mask)
    for number, handler in zip(signals, handlers, strict=True):
        signal.signal(number, handler)


def test_a_map_is_begun_on_a_canvas_and_the_site_that_was_made_of_it_is_driven_on(
    tmp_path: Path, up: Ends, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(TWO_ROOM, saved := tmp_path / "sites" / "home")
    canvas = str(tmp_path / "mapping" / "home")
    told = up(EXIT_MAP, EXIT_MAP)
    assert told == [str(TWO_ROOM), canvas, str(saved), canvas]
    assert (tmp_path / "mapping" / "home" / "map.yaml").is_file()
    assert "so what ran before runs again" in capsys.readouterr().out


def test_a_map_of_another_name_becomes_the_site_of_that_name(tmp_path: Path, up: Ends) -> None:
    shutil.copytree(TWO_ROOM, saved := tmp_path / "sites" / "attic")
    assert str(saved) in up(EXIT_MAP, mapping="attic")


def test_a_map_that_was_never_saved_goes_on_growing(tmp_path: Path, up: Ends) -> None:
    canvas = str(tmp_path / "mapping" / "home")
    assert up(EXIT_MAP, EXIT_MAP) == [str(TWO_ROOM), canvas, canvas]


def test_a_map_that_can_not_be_begun_leaves_the_site_before_it(
    tmp_path: Path, up: Ends, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mapping").write_text("a file where a folder belongs")
    assert up(EXIT_MAP) == [str(TWO_ROOM)] * 2
    assert "site_unwritable" in capsys.readouterr().out


def test_what_a_robot_keeps_is_readable_by_its_own_user_alone(tmp_path: Path) -> None:
    """Children inherit the mask: journal, recordings, places and logs are made under it."""
    before = os.umask(0o022)
    try:
        settings = replace(load(), home=tmp_path / "h", site=tmp_path / "none")
        assert launch.run(settings) == REFUSED_TO_START
        (tmp_path / "file").touch()
    finally:
        os.umask(before)
    assert (tmp_path / "file").stat().st_mode & 0o777 == 0o600
