"""Run all steps in order, each in the environment that it needs; stop at the first that fails."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tools.train import __main__ as training


def test_steps_come_in_order_and_where_they_belong(tmp_path: Path) -> None:
    learn = tmp_path / "python"
    plan = training.TrainingPlan(
        tmp_path, learn, tmp_path / "m.onnx", frames=400, epochs=2, cores=1
    )
    steps = plan.steps()
    names = ["frames"] * 3 + ["training", "export", "score_calibration", "evaluation", "card"]
    assert [command[2] for command in steps] == [f"tools.train.{name}" for name in names]
    own = [name for name, command in zip(names, steps, strict=True) if command[0] == str(learn)]
    assert own == ["training", "export", "score_calibration"]
    assert all(command[0] in (str(learn), sys.executable) for command in steps)


def test_a_missing_environment_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert training.main(["--learn", str(tmp_path / "none")]) == training.REFUSED
    assert "tools/train/README.md" in capsys.readouterr().out


def test_the_first_step_that_fails_ends_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[str] = []

    def run(command: list[str]) -> int:
        tried.append(command[2])
        return 3 if command[2] == "tools.train.training" else 0

    monkeypatch.setattr(training, "_run", run)
    assert training.main(["--learn", sys.executable, "--run", str(tmp_path)]) == 3
    assert tried[-1] == "tools.train.training"
