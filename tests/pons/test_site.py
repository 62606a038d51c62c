"""``pons site`` makes a site, asks what only a person knows, and says what is wrong with it."""

from __future__ import annotations

import shutil
from datetime import UTC, datetime
from math import pi
from pathlib import Path

import pytest

from maps.room_proposals import read_proposals
from planner.site import Site, TaughtPlace, TaughtPlaces
from planner.site.places import Names
from pons import site
from pons.settings import LaunchSettings, site_of
from pons.site_findings import reserved_name_findings
from pons_assets import SITES
from tests.known import known
from tests.site_sentences import english_in
from wire import FenceFile


def told_twice(
    settings: LaunchSettings, words: list[str], capsys: pytest.CaptureFixture[str]
) -> tuple[int, str, str]:
    """Give an order that changes nothing in both languages; return its status and what it told."""
    capsys.readouterr()
    ended = site.run(settings, words)
    english = capsys.readouterr().err
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("LC_ALL", "zh_CN.UTF-8")
        assert site.run(settings, words) == ended
    return ended, english, capsys.readouterr().err


@pytest.fixture
def plan(tmp_path: Path, repository: Path) -> Path:
    """Return the map of two_room, as Nav2's saver would have written it."""
    text = (repository / "sites" / "two_room" / "map.yaml").read_text()
    shutil.copy(repository / "sites" / "two_room" / "map.pgm", tmp_path)
    path = tmp_path / "nav.yaml"
    path.write_text(text.replace("0.196", "0.25"))
    return path


@pytest.fixture
def mine(settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """Return the folder of a site that was imported."""
    assert site.run(settings, ["import", str(plan), "mine", "--unknown", "unknown"]) == 0
    capsys.readouterr()
    return site_of("mine", settings.home)


def closed_mask(plan: Path) -> str:
    """Return a keep-out mask that closes everything."""
    picture = (plan.parent / "map.pgm").read_bytes()
    header = picture[: picture.index(b"255\n") + 4]
    (plan.parent / "closed.pgm").write_bytes(header + bytes(len(picture) - len(header)))
    mask = plan.parent / "mask.yaml"
    mask.write_text(plan.read_text().replace("map.pgm", "closed.pgm"))
    return str(mask)


def test_unknown_floor_needs_a_persons_word(
    settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ended, english, chinese = told_twice(settings, ["import", str(plan), "mine"], capsys)
    assert ended == 3
    assert "map_unknown_word" in english
    assert "--unknown unknown or --unknown free" in english
    assert chinese.strip().endswith("请说明是哪一种：--unknown unknown 或 --unknown free")
    assert "which" not in chinese
    assert site.run(settings, ["import", str(plan), "mine", "--unknown", "unknown"]) == 0
    assert site.run(settings, ["import", str(plan), "mine", "--unknown", "unknown"]) == 3
    assert "site_exists" in capsys.readouterr().err


def test_a_proposed_room_gets_a_name_and_is_a_place(
    settings: LaunchSettings, mine: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = Site.load(mine).map_id
    assert site.run(settings, ["name", "mine", "room_1", "tea kitchen", "--zh", "茶水间"]) == 0
    loaded = Site.load(mine)
    found = known(loaded.find_place("茶水间"))
    assert found.id == "tea_kitchen"
    assert loaded.map_id == before
    assert site.run(settings, ["name", "mine", "room_2", "tea kitchen"]) == 3
    assert "place_" in capsys.readouterr().err
    assert len(Site.load(mine).rooms) == 1, "a refusal leaves nothing"
    assert site.run(settings, ["name", "mine", "room_9", "attic"]) == 3
    assert "room_unknown" in capsys.readouterr().err
    assert site.run(settings, ["rooms", "mine"]) == 0
    assert "named tea kitchen" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "status", "code"),
    [
        (["import", "{plan}", "../evil"], 3, "site_name_malformed"),
        (["import", "{plan}", "mine", "--resolution", "0.05"], 2, "resolution_once"),
        (["import", "{image}", "mine"], 2, "resolution_once"),
        (["import", "{image}", "mine", "--resolution", "nan"], 3, "value_malformed"),
        (["import", "nowhere.yaml", "mine"], 3, "site_file_missing"),
        (["check", "nowhere"], 3, "site_missing"),
        (["rooms", "nowhere"], 3, "site_missing"),
    ],
)
def test_what_cannot_be_is_refused_by_name(
    settings: LaunchSettings,
    plan: Path,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    status: int,
    code: str,
) -> None:
    image = plan.parent / "map.pgm"
    given = [word.format(plan=plan, image=image) for word in words]
    ended, english, chinese = told_twice(settings, given, capsys)
    assert ended == status
    assert code in english
    assert any(ord(letter) > 0x2E80 for letter in chinese)
    assert english_in(chinese) == ""


@pytest.mark.parametrize(
    ("start", "code"),
    [
        (("nan", "1", "0"), "value_malformed"),
        (("1", "inf", "0"), "value_malformed"),
        (("1", "1", "nan"), "value_malformed"),
        (("99", "1", "0"), "place_outside_map"),
        (("0", "0", "0"), "place_in_obstacle"),
    ],
)
def test_a_start_that_cannot_be_is_refused_and_leaves_nothing(
    settings: LaunchSettings,
    plan: Path,
    capsys: pytest.CaptureFixture[str],
    start: tuple[str, str, str],
    code: str,
) -> None:
    words = ["import", str(plan), "mine", "--unknown", "unknown", "--start", *start]
    ended, english, chinese = told_twice(settings, words, capsys)
    assert ended == 3
    assert english.startswith(f"refused: {code}: ")
    assert "起点" in chinese or "应为" in chinese
    assert not (settings.home / "sites").exists()


def test_a_start_may_look_any_way_round(settings: LaunchSettings, plan: Path) -> None:
    words = ["import", str(plan), "mine", "--unknown", "unknown", "--start", "1.5", "1.5", "450"]
    assert site.run(settings, words) == 0
    home = Site.load(site_of("mine", settings.home)).home
    assert home.pose.yaw_rad == pytest.approx(pi / 2)


def test_a_site_that_would_not_load_is_not_left_behind(
    settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Home would lie outside the fence."""
    words = ["import", str(plan), "mine", "--unknown", "unknown"]
    asked = [*words, "--keepout", closed_mask(plan)]
    ended, english, chinese = told_twice(settings, asked, capsys)
    assert ended == 3
    assert "place_outside_fence" in english
    assert "禁入区" in chinese
    assert not list((settings.home / "sites").iterdir())
    assert site.run(settings, words) == 0


def test_after_an_import_with_an_error_nobody_is_told_to_drive_there(
    settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["import", str(plan), "mine", "--unknown", "unknown", "--start", "0.15", "1.5", "0"]
    assert site.run(settings, words) == 1
    said = capsys.readouterr().out
    assert "error: home_tight" in said
    assert "pons up" not in said
    assert "before you drive there" in said


def test_what_grey_205_was_taken_for_is_told(
    settings: LaunchSettings, plan: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for word, taken_for in (("unknown", "unknown"), ("free", "floor")):
        assert site.run(settings, ["import", str(plan), f"as_{word}", "--unknown", word]) == 0
        assert f"grey 205 were taken for {taken_for}" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["stop", "停", "yes", "go to the kitchen"])
def test_a_room_is_not_called_by_an_order(
    settings: LaunchSettings, mine: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    ended, english, chinese = told_twice(settings, ["name", "mine", "room_1", name], capsys)
    assert ended == 3
    assert "place_name_reserved" in english
    assert "名称" in chinese
    assert not Site.load(mine).rooms


@pytest.mark.parametrize("again", [["kitchen"], ["KITCHEN"], ["galley", "--zh", "厨房"]])
def test_a_name_that_a_place_has_is_told_with_that_place(
    settings: LaunchSettings, mine: Path, capsys: pytest.CaptureFixture[str], again: list[str]
) -> None:
    assert site.run(settings, ["name", "mine", "room_1", "kitchen", "--zh", "厨房"]) == 0
    before = (mine / "places.yaml").read_bytes()
    ended, english, chinese = told_twice(settings, ["name", "mine", "room_1", *again], capsys)
    assert ended == 3
    assert "place_name_taken" in english
    assert f"{again[-1]!r} is a name of 'kitchen' already" in english
    assert f"{again[-1]!r} 已是 'kitchen' 的名称" in chinese
    assert (mine / "places.yaml").read_bytes() == before


@pytest.mark.parametrize(
    ("line", "reserved"),
    [
        ("  name: {en: shelf, zh: 架子}\n", []),
        ("  name: {en: stop, zh: 架子}\n", ["stop"]),
        ("  name: {en: do not, zh: 停}\n", ["do not", "停"]),
        ("  name: {en: shelf, zh: 架子}\n  aliases: {en: [halt, 'yes']}\n", ["halt", "yes"]),
    ],
)
def test_a_name_in_the_files_that_reads_as_an_order_is_found(
    settings: LaunchSettings,
    mine: Path,
    capsys: pytest.CaptureFixture[str],
    line: str,
    reserved: list[str],
) -> None:
    places = mine / "places.yaml"
    home = Site.load(mine).home.pose
    spot = f"  pose: {{x_m: {home.x_m}, y_m: {home.y_m}, yaw_rad: 0.0}}\n"
    places.write_text(
        f"{places.read_text('utf-8')}- id: thing\n  kind: place\n{line}{spot}", "utf-8"
    )
    site.run(settings, ["check", "mine"])
    said = [line for line in capsys.readouterr().out.split("\n") if "reserved" in line]
    assert len(said) == len(reserved)
    for told, name in zip(said, reserved, strict=True):
        assert f"“{name}”, a name of “thing”" in told


@pytest.mark.parametrize("name", ["home", "two_room"])
def test_no_name_of_the_sites_that_come_along_is_reserved(name: str) -> None:
    assert not reserved_name_findings(SITES / name)


def test_a_site_that_is_not_there_is_told_with_those_that_are(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    ended, english, chinese = told_twice(settings, ["check", "nowhere"], capsys)
    assert ended == 3
    assert "nowhere is no site" in english
    assert "home, two_room" in english
    assert "已有站点：home, two_room" in chinese


def test_masks_of_a_site_that_exists_make_a_fence_to_propose(
    settings: LaunchSettings, plan: Path, mine: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (mine / "fence.json").read_bytes()
    assert site.run(settings, ["masks", "mine", "--keepout", closed_mask(plan)]) == 0
    said = capsys.readouterr()
    fence = FenceFile.model_validate_json(said.out)
    assert len(fence.keep_outs) > len(Site.load(mine).fence.record.keep_outs)
    assert "pons fence propose" in said.err
    assert (mine / "fence.json").read_bytes() == before, "nothing is in force yet"
    ended, english, chinese = told_twice(settings, ["masks", "mine"], capsys)
    assert ended == 2
    assert "masks_none: say --keepout MASK.yaml" in english
    assert "请给出 --keepout MASK.yaml" in chinese


def test_our_own_sites_are_well(settings: LaunchSettings) -> None:
    assert site.run(settings, ["check", "home"]) == 0
    assert site.run(settings, ["check", "two_room"]) == 0
    assert site.run(settings, ["list"]) == 0


def test_a_site_is_found_by_path_then_at_home_then_among_ours(settings: LaunchSettings) -> None:
    own = settings.home / "sites" / "two_room"
    assert site_of("two_room", settings.home).parent.name == "sites"
    assert site_of("two_room", settings.home) != own
    own.mkdir(parents=True)
    assert site_of("two_room", settings.home) == own
    assert site_of(str(settings.home), settings.home) == settings.home
    assert site_of("nowhere", settings.home) == Path("nowhere").absolute()


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
