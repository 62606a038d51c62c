"""``pons key new`` makes a key that the bridge takes, once."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from bridge.operator_key import load_operator_key
from pons.__main__ import main
from pons.key import run
from pons.settings import load


def test_the_key_is_random_private_printable_and_taken_by_the_bridge(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PONS_HOME", str(tmp_path))
    before = os.umask(0)
    try:
        assert main(["key", "new"]) == 0
    finally:
        os.umask(before)
    path = tmp_path / "operator.key"
    key = load_operator_key(tmp_path, virtual=False)
    assert len(bytes.fromhex(key.decode())) == 32
    assert path.stat().st_mode & 0o777 == 0o600
    out = capsys.readouterr().out
    assert str(path) in out
    assert key.decode() not in out
    path.unlink()
    assert main(["key", "new"]) == 0
    assert load_operator_key(tmp_path, virtual=False) != key


def test_a_key_that_is_there_is_never_replaced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = replace(load(), home=tmp_path)
    (tmp_path / "operator.key").write_text("the old one")
    assert run(settings) == 3
    assert capsys.readouterr().err.startswith("operator_key_exists: ")
    (tmp_path / "operator.key").unlink()
    (tmp_path / "operator.key").symlink_to(tmp_path / "elsewhere")
    assert run(settings) == 3
    assert not (tmp_path / "elsewhere").exists()


def test_before_the_first_start_the_home_is_made_for_this_user_alone(tmp_path: Path) -> None:
    home = tmp_path / "home"
    assert run(replace(load(), home=home)) == 0
    assert home.stat().st_mode & 0o777 == 0o700
    assert load_operator_key(home, virtual=False)


def test_a_home_that_is_nowhere_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(replace(load(), home=tmp_path / "none" / "home")) == 3
    assert capsys.readouterr().err.startswith("home_unwritable: ")
