"""``pons map`` makes a site of a drive's recordings that the robot can then be sent about in."""

from __future__ import annotations

from dataclasses import replace
from math import hypot
from pathlib import Path

import pytest

from bridge.recording.recording_reader import read_motion
from localization.mapping.keyframes import read_keyframes
from maps import FREE, SiteError, load_map
from maps.room_proposals import RoomProposal
from planner.site import Site
from planner.site.taught_places import TaughtPlaces
from pons import mapping
from pons.settings import CHECKOUT, LaunchSettings
from tests.bridge.recorded import Taken, stream_of, written
from tests.pons.drives import Drive, keep_ticks, taught
from tools.lockstep import LockstepWorld
from wire import Odometry, Pose2, Scan, compose, load_robot
from wire.site_map import read_map_id

TWO_ROOM = CHECKOUT / "sites" / "two_room"
OFF_M = (-0.05, 0.0, 0.05)


def test_a_recording_gives_its_odometry_and_scans_back(drive: Drive) -> None:
    path, _, _, ticks = drive
    heard = list(read_motion(path))
    scans = [one for one in heard if isinstance(one, Scan)]
    assert scans == [inbox.scan for _, inbox, _, _ in ticks if inbox.scan is not None]
    told = [decision.odometry for *_, decision in ticks if decision.odometry is not None]
    assert [one for one in heard if isinstance(one, Odometry)] == told


def test_a_drive_becomes_a_site_that_the_planner_loads(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    path, start, _, _ = drive
    assert mapping.run(settings, ["attic", str(path)]) == 0, capsys.readouterr().err
    folder = settings.home / "sites" / "attic"
    site = Site.load(folder)
    home = site.home.pose
    assert hypot(home.x_m, home.y_m) < 0.01, "where the drive began"
    keyframes, _ = read_keyframes((folder / "keyframes.npz").read_bytes())
    assert len(keyframes) > 8
    made, true = load_map(folder / "map.yaml").grid, load_map(TWO_ROOM / "map.yaml").grid
    wrong = seen = 0
    for index, cell in enumerate(made.cells):
        if cell == FREE:
            row, column = divmod(index, made.width)
            at = compose(start, Pose2(*made.centre_of(column, row), 0.0))
            near = {true.at(at.x_m + dx, at.y_m + dy) for dx in OFF_M for dy in OFF_M}
            seen, wrong = seen + 1, wrong + (FREE not in near)
    assert seen > 5000
    assert wrong < 0.01 * seen, "what is free on it is free"
    assert "pons site check attic" in capsys.readouterr().out


def test_the_same_name_twice_is_refused_and_the_first_stays(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["attic", str(drive[0])]
    assert mapping.run(settings, words) == 0
    folder = settings.home / "sites" / "attic"
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert mapping.run(settings, words) == 3
    assert "site_exists" in capsys.readouterr().err
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize("name", ["", "Attic", "../up", "a" * 40, "1st", "阁楼", "a b"])
def test_odd_names_are_refused_before_anything_is_read(
    name: str, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert mapping.run(settings, [name, "/nothing"]) == 3
    assert "site_name_malformed" in capsys.readouterr().err


def test_a_robot_that_stood_makes_no_map(
    drive: Drive, settings: LaunchSettings, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    world = LockstepWorld(seed=4)
    (path,) = written(tmp_path, stream_of(world.bridge.config, drive[3][:100]), boot="stood")
    assert mapping.run(settings, ["attic", str(path)]) == 3
    assert "map_no_drive" in capsys.readouterr().err
    assert not (settings.home / "sites").exists()


def test_recordings_of_two_runs_do_not_join(
    drive: Drive, settings: LaunchSettings, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ticks: list[Taken] = []
    world = LockstepWorld(seed=5, step=keep_ticks(ticks))
    world.run(3.0)
    renamed = [
        (state, inbox, now_s, replace(decision, odometry=_of_another_run(decision.odometry)))
        for state, inbox, now_s, decision in ticks
    ]
    (path,) = written(tmp_path, stream_of(world.bridge.config, renamed), boot="other")
    assert mapping.run(settings, ["attic", str(drive[0]), str(path)]) == 3
    assert "map_of_two_runs" in capsys.readouterr().err


def _of_another_run(odometry: Odometry | None) -> Odometry | None:
    return odometry and odometry.model_copy(update={"odom_id": "bridge-other"})


@pytest.mark.parametrize("data", [None, b"", b"no recording at all"])
def test_what_is_no_recording_is_refused(
    data: bytes | None,
    settings: LaunchSettings,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    path = tmp_path / "a.mcap"
    if data is not None:
        path.write_bytes(data)
    assert mapping.run(settings, ["attic", str(path)]) == 3
    code = {None: "recording_missing", b"": "map_no_drive"}.get(data, "recording_not_mcap")
    english = capsys.readouterr().err
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert mapping.run(settings, ["attic", str(path)]) == 3
    chinese = capsys.readouterr().err
    assert code in english
    assert english.isascii()
    assert code in chinese
    assert "录制" in chinese


def test_a_disk_without_room_is_refused(
    drive: Drive,
    settings: LaunchSettings,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(mapping, "MIN_FREE_BYTES", 1 << 62)
    assert mapping.run(settings, ["attic", str(drive[0])]) == 3
    assert "disk_full" in capsys.readouterr().err


def test_what_a_drive_has_kept_becomes_a_site_and_goes_on_another_day(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = load_robot(settings.robot)
    mapping.prepare_canvas(settings, "attic", robot)
    canvas = settings.home / "mapping" / "attic"
    with pytest.MonkeyPatch.context() as patched:
        for locale, told in (("C", "begun are: none"), ("zh_CN.UTF-8", "已开始的有：无")):
            patched.setenv("LC_ALL", locale)
            assert mapping.run(settings, ["attic"]) == 3
            (said,) = capsys.readouterr().err.splitlines()
            assert "map_not_begun" in said
            assert told in said
    assert mapping.run(settings, ["other", str(drive[0])]) == 0
    kept = settings.home / "sites" / "other" / "keyframes.npz"
    (canvas / "keyframes.npz").write_bytes(kept.read_bytes())
    assert mapping.run(settings, ["attic"]) == 0
    made = settings.home / "sites" / "attic"
    cells = [load_map(one / "map.yaml").grid.cells for one in (made, kept.parent)]
    changed = sum(a != b for a, b in zip(*cells, strict=True))
    assert changed < 0.01 * len(cells[0]), "points are kept to the millimetre"
    assert mapping.run(settings, ["attic"]) == 3
    assert "another name" not in capsys.readouterr().err, "no drive is kept under any other"
    mapping.prepare_canvas(settings, "other", robot)
    again = settings.home / "mapping" / "other" / "keyframes.npz"
    assert again.read_bytes() == kept.read_bytes(), "another day goes on from the site's own"
    before = (canvas / "map.yaml").read_bytes()
    mapping.prepare_canvas(settings, "attic", robot)
    assert (canvas / "map.yaml").read_bytes() == before
    assert (again.parent / "map.yaml").read_bytes() != before, "a place taught here is none there"


def square(room_id: str, x_m: float, side_m: float) -> RoomProposal:
    corners = ((x_m, 0.0), (x_m + side_m, 0.0), (x_m + side_m, side_m), (x_m, side_m))
    return RoomProposal(
        id=room_id,
        polygon=corners,
        pose=Pose2(x_m + 0.5, 0.5, 0.0),
        area_m2=side_m * side_m,
        clearance_m=1.0,
    )


def test_a_name_alone_in_a_room_is_the_rooms_and_the_others_stay_spots() -> None:
    canvas, site, other = "a" * 16, "b" * 16, "c" * 16
    rooms = (square("room_1", 0.0, 3.0), square("room_2", 5.0, 3.0))
    places = (
        taught("study", 1.0, 1.0, canvas),
        taught("sofa", 6.0, 1.0, canvas),
        taught("lamp", 7.0, 2.0, canvas),
        taught("shed", 20.0, 1.0, canvas),
        taught("elsewhere", 1.0, 1.0, other),
    )
    carried = mapping.carry_names(places, canvas, site, rooms)
    assert [place.id for place in carried] == ["study", "sofa", "lamp", "shed"]
    assert {place.map_id for place in carried} == {site}
    assert [place.polygon for place in carried] == [rooms[0].polygon, None, None, None]
    assert [place.pose for place in carried] == [place.pose for place in places[:4]]
    assert mapping.carry_names((*places, *carried), canvas, site, rooms) == ()


def test_names_given_while_mapping_go_with_the_site(
    drive: Drive, settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    mapping.prepare_canvas(settings, "attic", load_robot(settings.robot))
    canvas = settings.home / "mapping" / "attic"
    assert mapping.run(settings, ["other", str(drive[0])]) == 0
    kept = settings.home / "sites" / "other" / "keyframes.npz"
    (canvas / "keyframes.npz").write_bytes(kept.read_bytes())
    store = TaughtPlaces.in_home(settings.home)
    store.save((taught("study", 0.2, 0.0, read_map_id(canvas)),))
    assert mapping.run(settings, ["attic"]) == 0
    assert "while it was mapped go with it: 1" in capsys.readouterr().out
    site = Site.load(settings.home / "sites" / "attic")
    here = [place for place in store.load() if place.map_id == site.map_id]
    assert [place.id for place in here] == ["study"]


def test_a_canvas_with_spoilt_keyframes_is_refused(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    mapping.prepare_canvas(settings, "attic", load_robot(settings.robot))
    (settings.home / "mapping" / "attic" / "keyframes.npz").write_bytes(b"spoilt")
    assert mapping.run(settings, ["attic"]) == 3
    assert "keyframes_malformed" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["", "Attic", "../up", "a b"])
def test_a_canvas_of_an_odd_name_is_refused(name: str, settings: LaunchSettings) -> None:
    with pytest.raises(SiteError, match="site_name_malformed"):
        mapping.prepare_canvas(settings, name, load_robot(settings.robot))
    assert not settings.home.exists()
