"""``pons map NAME --mend`` shows what is wrong with a map; a yes changes all of it or nothing."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from maps import FREE, OCCUPIED, load_map
from maps.new_site import map_picture, map_yaml
from planner.site import Site
from planner.site.fence import load_fence
from planner.site.taught_places import TaughtPlaces
from pons import mapping
from pons.home_lock import HomeLock
from pons.settings import CHECKOUT, LaunchSettings
from tests.pons.drives import Drive, taught
from wire.fence import fence_text
from wire.site_map import read_map_id

pytestmark = pytest.mark.nightly(keep=4)


TWO_ROOM = CHECKOUT / "sites" / "two_room"
CRATE_M = (1.0, 2.0)


def stale_site(settings: LaunchSettings) -> Path:
    """Make a site of one's own whose map shows a crate in the kitchen that is not there."""
    folder = settings.home / "sites" / "den"
    shutil.copytree(TWO_ROOM, folder, ignore=shutil.ignore_patterns("home.yaml"))
    grid = load_map(folder / "map.yaml").grid
    cells, (column, row) = bytearray(grid.cells), grid.cell_of(*CRATE_M)
    for line in range(row, row + 8):
        cells[line * grid.width + column : line * grid.width + column + 10] = bytes([OCCUPIED]) * 10
    drawn = replace(grid, cells=bytes(cells))
    (folder / "map.yaml").write_bytes(map_yaml(drawn))
    (folder / "map.pgm").write_bytes(map_picture(drawn))
    fence = load_fence(folder / "fence.json").record
    fence = fence.model_copy(update={"map_id": read_map_id(folder)})
    (folder / "fence.json").write_text(fence_text(fence), "utf-8")
    return folder


def proposed(told: str) -> str:
    """Return the id of the mend that was told of."""
    return told.split("--accept ")[1].split(maxsplit=1)[0]


def test_a_drive_mends_a_site_and_nothing_of_it_is_lost(
    drive: Drive,
    settings: LaunchSettings,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    folder = stale_site(settings)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    old = Site.load(folder)
    TaughtPlaces.in_home(settings.home).save((taught("spot", 2.0, 1.0, old.map_id),))
    assert mapping.run(settings, ["den", "--mend", str(drive[0])]) == 0, capsys.readouterr().err
    told = capsys.readouterr().out
    assert "gone   0.50 x 0.40 m" in told
    with monkeypatch.context() as patched:
        patched.setenv("LC_ALL", "zh_CN.UTF-8")
        assert mapping.run(settings, ["den", "--mend", "--without", "1"]) == 0
        assert "0.50 x 0.40 m" in (chinese := capsys.readouterr().out)
        assert "已不在" in chinese
    assert mapping.run(settings, ["den", "--mend", str(drive[0])]) == 0
    assert told == capsys.readouterr().out
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert (settings.home / "mending" / "den" / "changes.png").is_file()
    mend_id = proposed(told)

    assert mapping.run(settings, ["den", "--accept", "0" * 16]) == 3
    assert "mend_unknown" in capsys.readouterr().err
    with HomeLock(settings.home):
        assert mapping.run(settings, ["den", "--accept", mend_id]) == 3
    assert "robot_running" in capsys.readouterr().err
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before

    assert mapping.run(settings, ["den", "--accept", mend_id]) == 0, capsys.readouterr().err
    new = Site.load(folder)
    assert new.map_id == mend_id != old.map_id
    assert new.grid.at(CRATE_M[0] + 0.2, CRATE_M[1] + 0.2) == FREE
    assert (folder / "places.yaml").read_bytes() == before["places.yaml"]
    parts = ("allowed", "keep_outs", "speed_zones")
    for part in parts:
        assert getattr(new.fence.record, part) == getattr(old.fence.record, part)
    here = [one for one in TaughtPlaces.in_home(settings.home).load() if one.map_id == mend_id]
    assert [one.id for one in here] == ["spot"]
    assert mapping.run(settings, ["den", "--accept", mend_id]) == 3, "one yes is for one change"

    assert mapping.run(settings, ["den", "--undo"]) == 0
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert mapping.run(settings, ["den", "--undo"]) == 3
    assert "mend_unknown" in capsys.readouterr().err


def test_rooms_that_were_named_at_the_page_are_known_to_the_mended_map(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = stale_site(settings)
    kitchen = Site.load(folder).rooms[0]
    places = folder / "places.yaml"
    home_alone = (
        "version: 1\nhome: home\nplaces:\n- {id: home, kind: place, name: {en: home, zh: 家}, "
    )
    places.write_text(f"{home_alone}pose: {{x_m: 1.0, y_m: 4.2, yaw_rad: 0.0}}}}\n", "utf-8")
    named = taught("cook", kitchen.pose.x_m, kitchen.pose.y_m, Site.load(folder).map_id)
    named = named.model_copy(update={"polygon": kitchen.polygon})
    for names, told in (((), True), ((named,), False)):
        TaughtPlaces.in_home(settings.home).save(names)
        assert mapping.run(settings, ["den", "--mend", str(drive[0])]) == 0
        mend_id = proposed(capsys.readouterr().out)
        assert mapping.run(settings, ["den", "--accept", mend_id]) == 0
        assert ("no_rooms" in capsys.readouterr().out) is told
        assert mapping.run(settings, ["den", "--undo"]) == 0
        capsys.readouterr()


def test_a_change_that_is_left_out_is_not_made(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    stale_site(settings)
    assert mapping.run(settings, ["den", "--mend", str(drive[0])]) == 0
    listed = [line for line in capsys.readouterr().out.splitlines() if " 0.50 x 0.40 m" in line]
    number = listed[0].split()[0]
    assert mapping.run(settings, ["den", "--mend", "--without", number]) == 0
    assert f"{number}  gone" in capsys.readouterr().out
    told = json.loads((settings.home / "mending" / "den" / "changes.json").read_bytes())
    assert told["left_out"] == [int(number)]
    grid = load_map(settings.home / "mending" / "den" / "map.yaml").grid
    assert grid.at(CRATE_M[0] + 0.2, CRATE_M[1] + 0.2) == OCCUPIED
    assert mapping.run(settings, ["den", "--mend", "--without", "99"]) == 3
    assert "mend_change_unknown" in capsys.readouterr().err


def test_a_proposal_for_another_map_is_stale(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = stale_site(settings)
    assert mapping.run(settings, ["den", "--mend", str(drive[0])]) == 0
    mend_id = proposed(capsys.readouterr().out)
    (folder / "map.yaml").write_bytes((folder / "map.yaml").read_bytes() + b"# by hand\n")
    assert mapping.run(settings, ["den", "--accept", mend_id]) == 3
    assert "mend_stale" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["nowhere", "--mend"], "site_missing"),
        (["two_room", "--mend"], "recordings_none"),
        (["two_room", "--accept", "0" * 16], "mend_unknown"),
        (["two_room", "--undo"], "mend_unknown"),
        (["two_room", "--mend", "--without", "1"], "mend_unknown"),
        (["two_room", "--without", "1"], "mend_change_unknown"),
    ],
)
def test_orders_about_a_mend_that_make_no_sense_are_refused(
    words: list[str], code: str, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert mapping.run(settings, words) == 3
    assert code in capsys.readouterr().err
