"""A few failed unit tests are run again, alone; many, or one of the core, are red at once."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

TELLER = """#!/bin/sh
case "$*" in
  *scripts.calm*) exit 0 ;;
  *--last-failed*) echo again >> told; exit {again} ;;
esac
for word in "$@"; do
  case "$word" in
    cache_dir=*)
      mkdir -p "${{word#*=}}/v/cache"
      echo '{failed}' > "${{word#*=}}/v/cache/lastfailed" ;;
  esac
done
echo first >> told
exit {code}
"""
ONE = ("tests/pons/test_stop.py::test_a",)
CORE = ("tests/bridge/core/test_step.py::test_a",)
THREE = (*ONE, "tests/a.py::test_b[x]", "tests/a.py::test_c")
FOUR = (*THREE, "tests/b.py::test_d")


@pytest.mark.parametrize(
    ("code", "failed", "again", "told", "ends_with"),
    [
        (0, (), 0, ["first"], 0),
        (2, ONE, 0, ["first"], 2),  # Ctrl-C
        (5, (), 0, ["first"], 0),  # a room without any
        (1, ONE, 0, ["first", "again"], 0),
        (1, THREE, 1, ["first", "again"], 1),
        (1, FOUR, 0, ["first"], 1),
        (1, CORE, 0, ["first"], 1),
        (75, FOUR, 0, ["first", "again"], 0),
        (75, CORE, 1, ["first", "again"], 1),
        (75, ONE, 75, ["first", "again", "again", "again"], 75),
    ],
)
def test_what_is_run_again_hangs_on_how_much_failed_and_where(
    code: int, failed: tuple[str, ...], again: int, told: list[str], ends_with: int,
    repository: Path, tmp_path: Path,
) -> None:  # fmt: skip
    fake = tmp_path / ".venv" / "bin" / "python"
    fake.parent.mkdir(parents=True)
    noted = "{" + ",\n".join(f'"{each}": true' for each in failed) + "}"
    fake.write_text(TELLER.format(code=code, again=again, failed=noted), "utf-8")
    fake.chmod(0o755)
    script = repository / "scripts" / "units.sh"
    done = subprocess.run(
        [script], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=40
    )
    assert (tmp_path / "told").read_text("utf-8").split() == told
    assert done.returncode == ends_with
    named = [each for each in failed if f"  {each}" in done.stdout]
    assert named == (list(failed) if "again" in told else [])
