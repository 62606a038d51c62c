"""Only the values change; what cannot be changed safely is not touched."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.findings import CalibrationFinding
from pons.calibrate.robot_toml import difference, edit_values, replace
from wire import ConfigError, load_robot

RADIUS = CalibrationFinding("base", "wheel_radius_m", 0.1, 0.0998, "calibrated now: 6 runs")
DEAD = CalibrationFinding("drive", "dead_zone_radps", 0.05, 0.06, "calibrated now: likewise")


def test_comments_order_and_other_keys_stay(repository: Path) -> None:
    before = (repository / "robot.toml").read_text("utf-8")
    after = edit_values(before, [RADIUS, DEAD])
    assert tomllib.loads(after)["base"]["wheel_radius_m"] == 0.0998
    kept = [line for line in after.splitlines() if not line.startswith("# calibrated")]
    changed = [(was, now) for was, now in zip(before.splitlines(), kept, strict=True) if was != now]
    assert len(changed) == 2
    assert changed[1][1].endswith(
        "# the motor turns so much slower than told; added to every command"
    )
    assert "# calibrated now: 6 runs\nwheel_radius_m = 0.0998\n" in after


def test_evidence_is_replaced_not_piled_up(repository: Path) -> None:
    before = (repository / "robot.toml").read_text("utf-8")
    twice = edit_values(edit_values(before, [RADIUS]), [RADIUS])
    assert twice == edit_values(before, [RADIUS])


@pytest.mark.parametrize(
    "text", ["", "[base]\n", '# mine\nid = "r7"\n[drive] # a motor\nlag_s=0.1\n']
)
def test_keys_and_tables_that_are_missing_are_added(text: str) -> None:
    after = tomllib.loads(edit_values(text, [RADIUS, DEAD]))
    assert after["base"]["wheel_radius_m"] == 0.0998
    assert after["drive"]["dead_zone_radps"] == 0.06
    assert ("lag_s" in after["drive"]) is ("lag_s" in text)


@pytest.mark.parametrize(
    "text",
    [
        "base = {wheel_radius_m = 0.1}\n",
        "base.wheel_radius_m = 0.1\n",
        "[base]\n'wheel_radius_m' = 0.1\n",
    ],
)
def test_another_way_of_writing_is_refused_with_the_values(text: str) -> None:
    with pytest.raises(CalibrationRefusal, match=r"base.wheel_radius_m = 0\.0998") as refused:
        edit_values(text, [RADIUS])
    assert refused.value.code == "robot_toml_shape"


def test_the_difference_shows_what_changes() -> None:
    shown = difference(
        Path("robot.toml"),
        "[base]\nwheel_radius_m = 0.1\n",
        edit_values("[base]\nwheel_radius_m = 0.1\n", [RADIUS]),
    )
    assert "-wheel_radius_m = 0.1" in shown
    assert "+wheel_radius_m = 0.0998" in shown


def test_the_old_file_is_kept_and_nothing_else_is_left(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    before = "[base]\nwheel_radius_m = 0.1  # by eye\n"
    path.write_text(before, "utf-8")
    path.chmod(0o640)
    kept = replace(path, before, edit_values(before, [RADIUS]), "20260101T000000Z")
    assert kept.name == "robot.toml.bak-20260101T000000Z"
    assert kept.read_text("utf-8") == before
    assert load_robot(path).base.wheel_radius_m == 0.0998
    assert path.stat().st_mode & 0o777 == 0o640
    assert set(tmp_path.iterdir()) == {path, kept}


def test_a_file_that_would_be_refused_is_never_put_in_place(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    before = "[base]\nwheel_radius_m = 0.1\n"
    path.write_text(before, "utf-8")
    with pytest.raises(ConfigError, match="wheel_radius_m"):
        replace(path, before, "[base]\nwheel_radius_m = 7.0\n", "x")
    assert path.read_text("utf-8") == before
    assert [one.name for one in tmp_path.iterdir()] == ["robot.toml"]


def test_a_file_changed_meanwhile_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("[base]\nwheel_radius_m = 0.2\n", "utf-8")
    with pytest.raises(CalibrationRefusal, match="changed meanwhile"):
        replace(path, "[base]\nwheel_radius_m = 0.1\n", "", "x")
