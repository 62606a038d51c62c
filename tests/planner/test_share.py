"""The planner takes a larger share of the processor where it may, before anything else."""

from __future__ import annotations

import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from planner import share
from planner.share import AUTOGROUP, NICE

ASK = f"import os; os.setpriority(os.PRIO_PROCESS, 0, {NICE})"
TAKE = """
import os
from planner.share import AUTOGROUP, take_larger_share
take_larger_share()
print(os.nice(0), AUTOGROUP.read_text().split()[-1] if AUTOGROUP.exists() else None)
"""


def test_it_takes_it_for_itself_and_its_session_where_it_may(repository: Path) -> None:
    def said(code: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-c", code],
            cwd=repository,
            capture_output=True,
            text=True,
            check=False,
            start_new_session=True,
        )

    nice = NICE if said(ASK).returncode == 0 else os.nice(0)
    group = (NICE if nice == NICE else 0) if AUTOGROUP.exists() else None
    taken = said(TAKE)
    assert (taken.returncode, taken.stderr) == (0, "")
    assert taken.stdout.split() == [str(nice), str(group)]


def test_the_planner_takes_it_before_it_opens_anything(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    taken: list[list[Path]] = []
    monkeypatch.setattr(share, "take_larger_share", lambda: taken.append(list(tmp_path.iterdir())))
    (tmp_path / "settings.toml").write_text("unknown = 1")
    words = ["--home", str(tmp_path), "--robot", "robot.toml", "--site", "nowhere"]
    monkeypatch.setattr(sys, "argv", ["planner", *words])
    monkeypatch.delitem(sys.modules, "planner.__main__", raising=False)  # runpy warns of it
    with pytest.raises(SystemExit, match="2"):
        runpy.run_module("planner", run_name="__main__")
    assert taken == [[tmp_path / "settings.toml"]]
    assert "planner: " in capsys.readouterr().err
