"""Tell a verdict in a table; say that there is no model where there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tools.bench.context import BenchLab
from tools.bench.measure import detector_map
from tools.bench.store import Store
from tools.train.evaluation import judge_model, least_of
from tools.train.score import Picture, ScoredThing, TrueThing

if TYPE_CHECKING:
    from pathlib import Path

CUP = TrueThing("cup", (0.0, 0.0, 10.0, 10.0))


def test_the_rows_hold_both_goals() -> None:
    right, ghost = ScoredThing("cup", 0.9, CUP.box), ScoredThing("ball", 0.41, CUP.box)
    empty: list[Picture] = [([], [])] * 3
    verdict = judge_model([([CUP], [right]), ([], [ghost])], empty, least_of(None))
    found, false = detector_map.rows(verdict)
    assert (found.value, found.goal) == ("1.000", ">= 0.85")
    assert (false.value, false.goal, false.valid) == ("0.250", "<= 0.02", True)


def test_a_missing_model_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(detector_map, "DEFAULT_MODEL", tmp_path / "none.onnx")
    (row,) = detector_map.measure(
        BenchLab(Store(tmp_path / "results.jsonl", resume=False), long=False)
    )
    assert row.value == "not measured"
