"""A story that failed is told again when nobody else tells one, and again if that did not count."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

TELLER = """#!/bin/sh
case "$*" in
  *scripts.calm*) echo "calm" >> ../told; exit 1 ;;
  *--last-failed*)
    echo "$PWD again" >> ../told
    [ "$(grep -c again ../told)" = 2 ] || exit 75 ;;
  *first*) until [ -e ../other ]; do sleep 0.01; done; echo "first failed" >> ../told; exit 1 ;;
  *)
    touch ../other
    until [ -s ../told ]; do sleep 0.01; done
    sleep 0.3; echo "other ended" >> ../told ;;
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


ALWAYS = """#!/bin/sh
case "$*" in
  *scripts.calm*) exit 0 ;;
  *--last-failed*) echo again >> told; exit {again} ;;
esac
for word in "$@"; do
  case "$word" in
    cache_dir=*)
      mkdir -p "${{word#*=}}/v/cache"
      echo '{{ "a::story": true }}' > "${{word#*=}}/v/cache/lastfailed" ;;
  esac
done
echo first >> told
exit {code}
"""


@pytest.mark.parametrize(
    ("code", "again", "until_s", "noted", "told", "ends_with"),
    [
        (0, 0, None, True, ["first"], 0),
        (9, 0, None, True, ["first"], 9),  # a contact was seen
        (75, 9, None, True, ["first", "again"], 9),
        (1, 1, None, True, ["first", "again"], 1),
        (75, 1, None, True, ["first", "again"], 1),
        (75, 0, None, True, ["first", "again"], 0),
        (75, 75, None, True, ["first", "again", "again", "again"], "not judged"),
        (75, 75, None, False, ["first", "again", "again", "again"], 75),
        (1, 75, None, True, ["first", "again", "again", "again"], 75),  # the first one counted
        (75, 75, "1", True, ["first"], "not judged"),  # no time is left
        (1, 75, "1", True, ["first"], 1),
    ],
)
def test_a_story_is_not_judged_only_where_no_telling_counted(
    code: int, again: int, until_s: str | None, noted: bool, told: list[str],
    ends_with: int | str, repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    fake, note = tmp_path / ".venv" / "bin" / "python", tmp_path / "not_judged"
    fake.parent.mkdir(parents=True)
    fake.write_text(ALWAYS.format(code=code, again=again), "utf-8")
    fake.chmod(0o755)
    for name, value in (("AGAIN_UNTIL", until_s), ("NOT_JUDGED", str(note) if noted else None)):
        monkeypatch.delenv(name, raising=False)
        if value is not None:
            monkeypatch.setenv(name, value)
    script = repository / "scripts" / "stories.sh"
    done = subprocess.run([script], cwd=tmp_path, capture_output=True, check=False, timeout=40)
    assert (tmp_path / "told").read_text("utf-8").split() == told
    assert done.returncode == (0 if ends_with == "not judged" else ends_with)
    assert note.exists() == (ends_with == "not judged")
    if note.exists():
        assert note.read_text("utf-8") == '"a::story"\n'
