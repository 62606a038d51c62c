"""Hold the safety page to the tables and to the files that it links to."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from bridge.core import safety_page
from bridge.core.modes.mode_table import TRANSITIONS
from bridge.core.safety_page import PATH, safety_md


def test_it_is_printed_written_and_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "safety.md"
    monkeypatch.setattr(safety_page, "PATH", page)
    assert safety_page.main(["--check"]) == 1
    assert "run python -m bridge.core.safety_page" in capsys.readouterr().out
    assert safety_page.main([]) == 0
    assert safety_page.main(["--check"]) == 0
    assert safety_page.main(["--print"]) == 0
    assert capsys.readouterr().out == page.read_text("utf-8")


def test_what_it_links_to_exists() -> None:
    links = re.findall(r"\]\(([^)#:]+)", safety_page.safety_md())
    assert "mutants.md" in links
    assert [link for link in links if not (safety_page.PATH.parent / link).exists()] == []


def test_every_transition_is_documented() -> None:
    page = PATH.read_text("utf-8")
    assert page == safety_md(), "run python -m bridge.core.safety_page"
    for (mode, _), to in TRANSITIONS.items():
        assert f"| {mode.value} |" in page
        assert f"| {to.value} |" in page
