"""The planner takes its share of the processor first; it opens no door to a token that is none."""

from __future__ import annotations

import os
import runpy
import sys
from pathlib import Path

import pytest

from planner.__main__ import _access
from processes import priority
from wire import ConfigError


def test_it_takes_its_share_before_it_opens_anything(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    taken: list[tuple[int, list[Path]]] = []
    monkeypatch.setattr(
        priority, "add_nice", lambda steps: taken.append((steps, list(tmp_path.iterdir())))
    )
    (tmp_path / "settings.toml").write_text("unknown = 1")
    words = ["--home", str(tmp_path), "--robot", "robot.toml", "--site", "nowhere"]
    monkeypatch.setattr(sys, "argv", ["planner", *words])
    monkeypatch.delitem(sys.modules, "planner.__main__", raising=False)  # runpy warns of it
    with pytest.raises(SystemExit, match="2"):
        runpy.run_module("planner", run_name="__main__")
    assert taken == [(-10, [tmp_path / "settings.toml"])]
    assert "planner: " in capfd.readouterr().err


@pytest.mark.parametrize("name", ["PONS_OPERATOR_TOKEN", "PONS_VIEWER_TOKEN"])
@pytest.mark.parametrize("token", [" " * 16, "a" * 15, "a" + " " * 30, " " + "a" * 20, "a b " * 5])
def test_a_token_has_sixteen_characters_that_are_no_blanks(
    monkeypatch: pytest.MonkeyPatch, name: str, token: str
) -> None:
    monkeypatch.setenv("PONS_OPERATOR_TOKEN", "a good and long token")
    monkeypatch.setenv(name, token)
    with pytest.raises(ConfigError, match="token_too_short"):
        _access("127.0.0.1", speaks_tls=False)


def test_no_worker_inherits_the_tokens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PONS_OPERATOR_TOKEN", "a good and long token")
    monkeypatch.setenv("PONS_VIEWER_TOKEN", "another good and long one")
    access = _access("0.0.0.0", speaks_tls=False)  # the very case
    assert (access.operator_token, access.viewer_token) == (
        "a good and long token",
        "another good and long one",
    )
    assert not {"PONS_OPERATOR_TOKEN", "PONS_VIEWER_TOKEN"} & set(os.environ)
