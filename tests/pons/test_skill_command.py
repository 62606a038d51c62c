"""``pons skill`` writes an example that works, and tells what is wrong with line and cure."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from pons.settings import LaunchSettings, load
from pons.skill_command import run


@pytest.fixture
def settings(tmp_path: Path) -> LaunchSettings:
    return replace(load(), home=tmp_path, port=1)  # nobody answers there


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["new", "evening_round"], "do the evening round in the kitchen"),
        (["new", "evening_round", "--python"], "the evening round in the kitchen"),
    ],
)
def test_the_example_is_a_skill_at_once(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert run(settings, words) == 0
    assert run(settings, ["check"]) == 0
    assert run(settings, ["try", *said.split()]) == 0
    assert "go to the kitchen" in capsys.readouterr().out
    assert run(settings, ["try", "--json", said]) == 0
    steps = json.loads(capsys.readouterr().out)
    assert [step["kind"] for step in steps] == ["go_to", "say", "return_home"]
    assert run(settings, words) == 3  # a file that is there stays
    assert "skill_exists" in capsys.readouterr().err


def test_what_is_wrong_is_told_with_its_line_in_one_language(
    settings: LaunchSettings,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    (tmp_path / "skills").mkdir()
    bad = tmp_path / "skills" / "bad.toml"
    bad.write_text('en = "do the round"\nsteps = [\n  {kind = "fly"},\n]\n', "utf-8")
    for named in ([], [str(bad)]):
        assert run(settings, ["check", *named]) == 1
        assert capsys.readouterr().err.startswith("bad.toml:3: skill_step: This is no step")
    assert run(settings, ["new", "evening_round"]) == 0
    assert run(settings, ["try", "do the evening round"]) == 0
    assert not capsys.readouterr().err, "the other file has no part in it"
    assert run(settings, ["try", "do the round"]) == 1
    assert "bad.toml:3" in capsys.readouterr().err
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    assert run(settings, ["check"]) == 1
    assert "bad.toml:3: skill_step: 这不是" in capsys.readouterr().err


def test_words_that_call_nothing_and_names_that_are_none_are_told(
    settings: LaunchSettings, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(settings, ["try", "go to the kitchen"]) == 1
    assert "skill_not_called" in capsys.readouterr().err
    assert run(settings, ["new", "../x"]) == 3
    assert "skill_name" in capsys.readouterr().err
    assert run(settings, ["list"]) == 6
    assert "planner_down" in capsys.readouterr().err
