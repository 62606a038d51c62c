"""The planner takes its share of the processor before anything else."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

import rank


def test_it_takes_its_share_before_it_opens_anything(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    taken: list[tuple[int, list[Path]]] = []
    monkeypatch.setattr(rank, "nice", lambda steps: taken.append((steps, list(tmp_path.iterdir()))))
    (tmp_path / "settings.toml").write_text("unknown = 1")
    words = ["--home", str(tmp_path), "--robot", "robot.toml", "--site", "nowhere"]
    monkeypatch.setattr(sys, "argv", ["planner", *words])
    monkeypatch.delitem(sys.modules, "planner.__main__", raising=False)  # runpy warns of it
    with pytest.raises(SystemExit, match="2"):
        runpy.run_module("planner", run_name="__main__")
    assert taken == [(-10, [tmp_path / "settings.toml"])]
    assert "planner: " in capsys.readouterr().err
