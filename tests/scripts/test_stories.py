"""A story that failed is told again when nobody else tells one, and again if that did not count."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

TELLER = """#!/bin/sh
case "$*" in
  *scripts.calm*) echo "calm" >> ../told; exit 1 ;;
  *--last-failed*)
    echo "$PWD again" >> ../told
    [ "$(grep -c again ../told)" = 2 ] || exit 75 ;;
  *first*) echo "first failed" >> ../told; exit 1 ;;
  *) until [ -s ../told ]; do sleep 0.01; done; sleep 0.3; echo "other ended" >> ../told ;;
esac
"""


def test_it_waits_for_those_beside_it(repository: Path, tmp_path: Path) -> None:
    fake = tmp_path / "work" / ".venv" / "bin" / "python"
    fake.parent.mkdir(parents=True)
    fake.write_text(TELLER, "utf-8")
    fake.chmod(0o755)
    stories = str(repository / "scripts" / "stories.sh")
    done = subprocess.run(
        [sys.executable, str(repository / "scripts" / "at_once.py"),
         stories, "first", "++", stories, "other"],
        cwd=tmp_path / "work", capture_output=True, text=True, check=False, timeout=40,
    )  # fmt: skip
    told = (tmp_path / "told").read_text("utf-8").splitlines()
    assert told == ["first failed", "other ended", *["calm", f"{tmp_path / 'work'} again"] * 2]
    assert (done.returncode, "alone" in done.stdout) == (0, True), done.stderr
