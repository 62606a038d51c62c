"""A run keeps to what it is asked for, and a child tells nothing but its number."""

from __future__ import annotations

import argparse
import json
import os
import signal
from pathlib import Path

import pytest

from scripts import mutants
from scripts.mutants import BROKEN, in_child, in_no_function, parts, report
from scripts.mutation import mutants_of

SOURCE = """\
LIMIT = 2.0
class Record:
    name: str = "x"
    bound: float = 3.0
    def within(self) -> bool:
        return self.bound < LIMIT
def passes(x: float) -> bool:
    return x < 5.0
"""


def test_constants_and_defaults_of_records_stand_outside_functions() -> None:
    outside = {one.what for one, _ in mutants_of(SOURCE)[1] if in_no_function(one)}
    assert {what.split()[0] for what in outside} == {"2.0", "3.0"}


def test_only_what_stands_outside_functions_is_tried_when_asked() -> None:
    assert parts(argparse.Namespace(outside=False)) == (False, True)
    assert parts(argparse.Namespace(outside=True)) == (True,)


def test_a_report_of_the_outside_counts_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "small.py").write_text(SOURCE, encoding="utf-8")
    made = [one for one, _ in mutants_of(SOURCE)[1]]
    rows = [{"key": f"small:{one.key}", "result": "survived"} for one in made if one.line in {1, 8}]
    (tmp_path / "results.jsonl").write_text("\n".join(map(json.dumps, rows)), encoding="utf-8")
    monkeypatch.setattr(mutants, "CORE", tmp_path)
    monkeypatch.setattr(mutants, "RESULTS", tmp_path / "results.jsonl")
    report(argparse.Namespace(names=["small"], outside=True))
    said = capsys.readouterr().out
    assert "| small | 2 | 1 | 0 | 0 | 1 |" in said
    assert "survived small.py:1  2.0 -> 2.2" in said
    assert "small.py:8" not in said


def _broken() -> int:
    raise ValueError


def _for_ever() -> int:
    while True:
        pass


def test_a_child_ends_with_its_number_as_broken_or_by_its_limit() -> None:
    assert os.WEXITSTATUS(in_child(lambda: 7, 60)) == 7
    assert os.WEXITSTATUS(in_child(_broken, 60)) == BROKEN
    assert os.WTERMSIG(in_child(_for_ever, 0)) == signal.SIGXCPU
