"""``pons braking`` shows what counts and forgets it only while no bridge runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.braking_file import path_of, write_learnt
from bridge.core.state_motion import Learnt
from pons import braking
from pons.settings import LaunchSettings
from pons.terminal_text import braking_line, robot_lines
from tests.wire.examples import STATUS
from wire import load_robot
from wire.keys import Party
from wire.sockets import Claim


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    (tmp_path / "robot.toml").write_text('id = "r7"\n')
    return LaunchSettings(tmp_path, tmp_path / "robot.toml", tmp_path, "127.0.0.1", 1)


def keep(settings: LaunchSettings) -> Path:
    robot = load_robot(settings.robot)
    path = path_of(settings.home, robot)
    write_learnt(path, robot, Learnt(lag_more_s=0.04, decel_share=0.8, stops=3))
    return path


def test_it_shows_both_what_is_configured_and_what_counts(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert braking.run(settings, forget=False) == 0
    assert "no stop has been judged" in capsys.readouterr().out
    keep(settings)
    assert braking.run(settings, forget=False) == 0
    shown = capsys.readouterr().out
    assert "lag 0.060 s, deceleration 1.00" in shown
    assert "lag 0.100 s, deceleration 0.80 m/s2, after 3 stops" in shown


def test_it_forgets_only_while_no_bridge_runs(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    path = keep(settings)
    bridge = Claim(settings.home, Party.BRIDGE)
    assert braking.run(settings, forget=True) == 3
    assert "already_running" in capsys.readouterr().err
    assert path.exists()
    bridge.close()
    assert braking.run(settings, forget=True) == 0
    assert not path.exists()


def test_a_wrong_robot_toml_is_named(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    settings.robot.write_text("max_sped = 1\n")
    assert braking.run(settings, forget=False) == 2
    assert "robot_toml_invalid" in capsys.readouterr().err


def test_an_unreadable_file_is_shown(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    keep(settings).write_text("nonsense")
    assert braking.run(settings, forget=False) == 0
    assert "braking_file_unreadable" in capsys.readouterr().out


def test_the_status_line_tells_configured_from_learnt() -> None:
    told: dict[str, object] = {
        "lag_s": 0.06,
        "decel_mps2": 1.0,
        "learnt": False,
        "stops": 2,
        "trouble": None,
    }
    assert braking_line(told) == "braking: configured, lag 0.060 s, deceleration 1.00 m/s2"
    told |= {"learnt": True, "trouble": "braking_file_unreadable"}
    assert "learnt from 2 stops" in braking_line(told)
    assert "braking_file_unreadable" in braking_line(told)


@pytest.mark.parametrize(("locale", "told"), [("C", "The brakes reach"), ("zh_CN.UTF-8", "制动力")])
def test_weak_brakes_are_told_in_the_persons_language_with_what_to_do(
    locale: str, told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", locale)
    said = STATUS.model_dump(mode="json")
    said["limits"]["by"] = "weak_brakes"
    shown = "\n".join(robot_lines({"status": said, "room": None}))
    assert "pons braking forget" in shown
    assert told in shown
    said["limits"]["by"] = "obstacle"
    assert told not in "\n".join(robot_lines({"status": said, "room": None}))


def test_a_hello_that_is_refused_is_shown_with_its_remedy() -> None:
    said = STATUS.model_dump(mode="json")
    said["answers"] = [
        {"id": "p2", "kind": "hello", "accepted": False, "code": "robot_mismatch", "detail": "so"}
    ]
    shown = "\n".join(robot_lines({"status": said, "room": None}))
    assert "refused hello of p2: robot_mismatch: so" in shown
