"""A failure counts unless the host took the processors away meanwhile."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from scripts import stolen
from tests.known import known

LINE = "cpu  {busy} 0 0 0 0 0 0 {stolen} 0 0\ncpu0 1 1 1 1 1 1 1 1 0 0\n"


@pytest.mark.parametrize(
    ("ends_with", "taken", "code"),
    [(1, 5, 1), (1, 6, 75), (0, 90, 0), (2, 90, 2), (75, 0, 75), (-9, 90, 137)],
    ids=[
        "failed in its own time",
        "failed in stolen time",
        "passed",
        "refused",
        "passed on",
        "killed",
    ],
)
def test_its_exit_status_stands_but_for_stolen_time(
    ends_with: int, taken: int, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stat = tmp_path / "stat"
    stat.write_text(LINE.format(busy=1000, stolen=500), "ascii")
    after = LINE.format(busy=1000 + 100 - taken, stolen=500 + taken)
    script = f"open({str(stat)!r}, 'w').write({after!r}); import os, sys; "
    script += f"os.kill(os.getpid(), 9) if {ends_with} < 0 else sys.exit({ends_with})"
    monkeypatch.setattr(stolen, "STAT", stat)
    assert stolen.main([sys.executable, "-S", "-c", script]) == code


def test_where_nobody_tells_nothing_was_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert stolen.read_steal("cpu  5 4 3 2\nintr 1\n") == (0, 14)
    monkeypatch.setattr(stolen, "STAT", tmp_path / "none")
    assert stolen.main([sys.executable, "-S", "-c", "raise SystemExit(1)"]) == 1


def test_a_command_that_is_interrupted_ends_by_itself(repository: Path, tmp_path: Path) -> None:
    script = (
        "import sys, time, pathlib\n"
        "try:\n    print('began', flush=True)\n    time.sleep(30)\n"
        "except KeyboardInterrupt:\n    time.sleep(0.6)\n    pathlib.Path(sys.argv[1]).touch()\n"
    )
    words = [sys.executable, "-m", "scripts.stolen", sys.executable, "-u", "-c", script]
    words.append(str(tmp_path / "x"))
    with subprocess.Popen(
        words, cwd=repository, stdout=subprocess.PIPE, start_new_session=True, text=True
    ) as running:
        assert known(running.stdout).readline() == "began\n"
        os.killpg(running.pid, signal.SIGINT)
        assert running.wait(20) == 0
    assert (tmp_path / "x").exists(), "it was killed while it cleaned up"
