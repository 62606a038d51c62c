"""``pons site rooms`` and ``check`` know the names that people gave while the robot ran."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest

from maps.room_proposals import read_proposals
from planner.site import Site, TaughtPlace, TaughtPlaces
from planner.site.places import Names
from pons import site
from pons.settings import LaunchSettings, site_of
from tests.pons.test_site import plan, settings

__all__ = ["plan", "settings"]


def test_a_room_that_was_named_at_the_page_has_its_name_here_too(
    settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert site.run(settings, ["import", str(plan), "mine", "--unknown", "unknown"]) == 0
    assert "no_rooms" in capsys.readouterr().out
    assert not (settings.home / "state.sqlite").exists(), "looking makes no store"
    folder = site_of("mine", settings.home)
    room, other = read_proposals(folder)[:2]
    kitchen = TaughtPlace(
        id="kitchen", name=Names(en="kitchen", zh="厨房"), pose=room.pose, polygon=room.polygon,
        map_id=Site.load(folder).map_id, by="page", taught=datetime(2026, 11, 26, tzinfo=UTC),
    )  # fmt: skip
    TaughtPlaces.in_home(settings.home).save((kitchen,))
    assert site.run(settings, ["rooms", "mine"]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert lines[room.id].endswith("named kitchen")
    assert lines[other.id].endswith("no name yet")
    site.run(settings, ["check", "mine"])
    assert "no_rooms" not in capsys.readouterr().out
