"""A unit test that failed in stolen time is run again; one that failed in ours is not."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

TELLER = """#!/bin/sh
case "$*" in
  *scripts.calm*) exit 0 ;;
  *--last-failed*) echo again >> told; exit {again} ;;
  *) echo first >> told; exit {code} ;;
esac
"""


@pytest.mark.parametrize(
    ("code", "again", "told", "ends_with"),
    [
        (0, 0, ["first"], 0),
        (1, 0, ["first"], 1),
        (75, 0, ["first", "again"], 0),
        (75, 1, ["first", "again"], 1),
        (75, 75, ["first", "again", "again", "again"], 75),
    ],
)
def test_only_what_failed_in_stolen_time_is_run_again(
    code: int, again: int, told: list[str], ends_with: int, repository: Path, tmp_path: Path
) -> None:
    fake = tmp_path / ".venv" / "bin" / "python"
    fake.parent.mkdir(parents=True)
    fake.write_text(TELLER.format(code=code, again=again), "utf-8")
    fake.chmod(0o755)
    script = repository / "scripts" / "units.sh"
    done = subprocess.run([script], cwd=tmp_path, capture_output=True, check=False, timeout=40)
    assert (tmp_path / "told").read_text("utf-8").split() == told
    assert done.returncode == ends_with
