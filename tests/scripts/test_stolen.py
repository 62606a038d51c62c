"""A failure counts unless the host took the processors away meanwhile."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest

from scripts import stolen

if TYPE_CHECKING:
    from pathlib import Path

LINE = "cpu  {busy} 0 0 0 0 0 0 {stolen} 0 0\ncpu0 1 1 1 1 1 1 1 1 0 0\n"


@pytest.mark.parametrize(
    ("ends_with", "taken", "code"),
    [(1, 5, 1), (1, 6, 75), (0, 90, 0), (2, 90, 2), (75, 0, 75)],
    ids=["failed in its own time", "failed in stolen time", "passed", "refused", "passed on"],
)
def test_its_exit_status_stands_but_for_stolen_time(
    ends_with: int, taken: int, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stat = tmp_path / "stat"
    stat.write_text(LINE.format(busy=1000, stolen=500), "ascii")
    after = LINE.format(busy=1000 + 100 - taken, stolen=500 + taken)
    script = f"open({str(stat)!r}, 'w').write({after!r}); raise SystemExit({ends_with})"
    monkeypatch.setattr(stolen, "STAT", stat)
    assert stolen.main([sys.executable, "-S", "-c", script]) == code


def test_where_nobody_tells_nothing_was_taken() -> None:
    assert stolen.taken("cpu  5 4 3 2\nintr 1\n") == (0, 14)
