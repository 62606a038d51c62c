"""Check which brain the planner chooses, and that a wrong model setting refuses to start."""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path

import pytest

from planner.__main__ import REFUSED, main
from planner.brain import FallbackBrain, OfflineBrain
from planner.brain.model_replies import ReplyTurn
from planner.brain_factory import brain_of, collector_of, model_of
from planner.budget import purse_of
from planner.settings import FILE, load_settings
from tests.conftest import ROOT

KEY = "sk-never-shown-12345"


def test_without_a_setting_the_offline_brain_thinks(tmp_path: Path) -> None:
    stray = {"OPENAI_API_KEY": KEY, "OPENAI_BASE_URL": "http://127.0.0.1:1/v1"}
    settings = load_settings(tmp_path, stray)
    purse = purse_of(settings, tmp_path)
    assert model_of(settings, tmp_path, purse) is None
    purse.close()
    assert isinstance(brain_of(None, settings), OfflineBrain)


def test_with_a_setting_the_model_thinks_first(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    named = {"PONS_MODEL_URL": "http://127.0.0.1:1/v1", "PONS_MODEL": "m", "PONS_MODEL_KEY": KEY}
    settings = load_settings(tmp_path, named)
    purse = purse_of(settings, tmp_path)
    model = model_of(settings, tmp_path, purse)
    assert model is not None
    brain = brain_of(model, settings)
    assert isinstance(brain, FallbackBrain)
    assert brain.tag.name == "m"
    asyncio.run(model.close())
    purse.close()
    assert "m at 127.0.0.1" in caplog.text
    assert KEY not in caplog.text


@pytest.mark.parametrize(("more", "kept"), [("", 0), ("keep_replies = 3\n", 3)])
def test_what_a_model_writes_is_kept_where_that_is_set_without_any_key(
    more: str, kept: int, tmp_path: Path
) -> None:
    model = f'[model]\nurl = "http://127.0.0.1:1/v1"\nname = "m"\nkey = "{KEY}"\n{more}'
    voice = '[voice]\nurl = "http://127.0.0.1:1/v1"\nkey = "hear-hear"\n'
    (tmp_path / FILE).write_text(model + voice)
    replies = collector_of(load_settings(tmp_path, {}))
    replies.keep("g1", f"{KEY} hear-hear", model="m", turn=ReplyTurn.PLAN, used=True)
    found = replies.replies_of("g1")
    assert found.kept == kept
    assert [each.text for each in found.replies] == ["[key cut] [key cut]"][:kept]
    (tmp_path / FILE).unlink()
    assert collector_of(load_settings(tmp_path, {})).replies_of("g1").kept == 0


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ('url = "file:///etc/passwd"\nname = "m"', "model_url"),
        ('url = "http://169.254.169.254/v1"\nname = "m"', "model_url"),
        ('url = "http://127.0.0.1/v1"\nname = "m"\nspeed = 3', "settings_malformed"),
        ('url = "https://api.example.com/v1"\nname = "m"', "model_offhost"),
        ('url = "http://127.0.0.1/v1"', "model_incomplete"),
    ],
)
def test_a_wrong_model_refuses_to_start(
    text: str, code: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / FILE).write_text(f'[model]\nkey = "{KEY}"\n{text}\n')
    words = ["--home", str(tmp_path), "--robot", str(ROOT / "robot.toml")]
    words += ["--site", str(ROOT / "sites" / "two_room")]
    assert main(words) == REFUSED
    said = capsys.readouterr().err
    assert code in said
    assert KEY not in said
    assert [path.name for path in tmp_path.iterdir()] == [FILE]
