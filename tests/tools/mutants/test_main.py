"""A run keeps to what it is asked for, and a child tells nothing but its number."""

from __future__ import annotations

import argparse
import json
import os
import signal
from pathlib import Path

import pytest

from tools.mutants import __main__ as mutants
from tools.mutants import line_tests
from tools.mutants.__main__ import (
    BROKEN,
    FIRST,
    UNTESTED,
    in_child,
    in_no_function,
    names_of,
    parts,
    report,
)
from tools.mutants.mutations import mutants_of

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
    monkeypatch.setattr(line_tests, "CORE", tmp_path)
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


def test_a_module_is_named_by_the_last_part_of_its_name_or_the_whole() -> None:
    assert names_of(["limiter", "motion.limiter", "step"]) == ["motion.limiter"] * 2 + ["step"]
    with pytest.raises(SystemExit, match="'unheard_of' names no module"):
        names_of(["unheard_of"])
    every = names_of([])
    assert len(every) == len(set(every))
    assert {line_tests.file_of(name).is_file() for name in every} == {True}
    assert every[0].rpartition(".")[2] == FIRST[0]
    assert not UNTESTED & {name.rpartition(".")[2] for name in every}
