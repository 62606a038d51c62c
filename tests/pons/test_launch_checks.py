"""What keeps ``pons up`` from starting is said before anything starts, in both languages."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from maps import SiteError
from pons.children import children
from pons.launch_checks import CannotStart, change_map, check, in_chinese, site_flaw
from pons.settings import CHECKOUT, LaunchSettings


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    """Return a launch in a copy of two_room that a test may spoil."""
    site = Path(shutil.copytree(CHECKOUT / "sites" / "two_room", tmp_path / "two_room"))
    return LaunchSettings(tmp_path, CHECKOUT / "robot.toml", site, "127.0.0.1", 1)


def test_a_site_that_is_none_is_told_with_those_that_are(
    settings: LaunchSettings, tmp_path: Path
) -> None:
    with pytest.raises(CannotStart, match="site_missing") as refused:
        check(replace(settings, site=tmp_path / "castle"))
    for words in (str(refused.value), refused.value.chinese):
        assert str(tmp_path / "castle") in words
        assert "home, two_room" in words
        assert "pons site import" in words
    assert "不是站点" in refused.value.chinese


def test_a_site_that_loads_has_no_flaw(settings: LaunchSettings) -> None:
    assert site_flaw(settings, "", planner=True) == ""


@pytest.mark.parametrize(
    ("file", "planner", "english", "chinese"),
    [
        ("map.pgm", True, "map_image_missing", "无法读取地图图像"),
        ("map.pgm", False, "map_image_missing", "无法读取地图图像"),
        ("fence.json", True, "site_file_missing", "缺少站点文件"),
        ("places.yaml", True, "site_file_missing", "缺少站点文件"),
    ],
)
def test_a_flaw_is_told_in_both_languages_once(
    settings: LaunchSettings,
    file: str,
    planner: bool,
    english: str,
    chinese: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (settings.site / file).unlink()
    told = site_flaw(settings, "", planner=planner)
    assert f"the site: {english}" in told
    assert f"pons site check {settings.site}" in told
    first = told.split("\n")[1].removeprefix("the site: ")
    again = site_flaw(settings, f"planner: {first}", planner=planner)
    assert "the site:" not in again
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert chinese in site_flaw(settings, "", planner=planner)


def test_places_matter_to_nobody_without_a_planner(settings: LaunchSettings) -> None:
    (settings.site / "places.yaml").unlink()
    assert site_flaw(settings, "", planner=False) == ""


def test_what_is_being_mapped_has_no_site_yet(settings: LaunchSettings) -> None:
    (settings.site / "places.yaml").unlink()
    assert site_flaw(replace(settings, mapping="attic"), "", planner=True) == ""


def test_a_refusal_that_speaks_chinese_is_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    assert in_chinese(CannotStart("full", "满了")) == ""
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert in_chinese(SiteError("disk_full", "full", "满了")) == "\n满了"
    assert in_chinese(CannotStart("full", "满了")) == "\n满了"
    assert in_chinese(CannotStart("full")) == ""
    assert in_chinese(OSError("full")) == ""


@pytest.mark.parametrize("localizes", ["scans", "stand_in"])
def test_saving_a_map_changes_no_simulated_home(
    settings: LaunchSettings, tmp_path: Path, localizes: str
) -> None:
    (described := tmp_path / "robot.toml").write_text(f'[localization]\nkind = "{localizes}"\n')
    shutil.copytree(settings.site, saved := tmp_path / "sites" / "home")
    maps, _ = change_map(replace(settings, robot=described))
    assert (maps.mapping, maps.site) == ("home", settings.site)
    drives, robot = change_map(maps)
    told = {each.name: each.arguments for each in children(drives, robot)}
    site = {name: Path(words[words.index("--site") + 1]) for name, words in told.items()}
    played = settings.site if localizes == "scans" else saved
    assert site == {"sim": played, "camera": played} | dict.fromkeys(
        ("localization", "bridge", "planner"), saved
    )
