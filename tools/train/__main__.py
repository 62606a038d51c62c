"""Do it all: ``python -m tools.train [--frames N] [--epochs N] [--run DIR]``.

Draws, fits, exports, scores and writes the card, each step a process of its own in the environment
that it needs. What an interrupted run has done is not done again.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from tools.train.budget import BARE_FRAMES, FRAMES, SPARE_FRAMES, UNSEEN_FRAMES, Schedule

ROOT = Path(__file__).resolve().parents[2]
MODEL = ROOT / "planner" / "perception" / "models" / "pons_home.onnx"
REFUSED, INTERRUPTED = 2, 130


@dataclass(frozen=True, slots=True)
class TrainingPlan:
    """Hold what is trained with what."""

    run: Path
    learn: Path
    """The Python that has PyTorch."""
    model: Path
    frames: int
    epochs: int
    cores: int

    def steps(self) -> list[list[str]]:
        """Return the commands in their order."""
        run, draw, learn = self.run, [sys.executable, "-m"], [str(self.learn), "-m"]
        counts = {
            "train": self.frames,
            "unseen": UNSEEN_FRAMES,
            "bare": BARE_FRAMES + SPARE_FRAMES,
        }
        each = [*draw, "tools.train.frames", "--workers", str(self.cores)]
        drawn = [
            [*each, "--kind", kind, "--count", str(count), "--out", str(run / kind)]
            for kind, count in counts.items()
        ]
        fit = [
            *learn,
            "tools.train.training",
            "--frames",
            str(run / "train"),
            "--out",
            str(run / "fit"),
        ]
        fit += ["--epochs", str(self.epochs), "--threads", str(self.cores)]
        export = [
            *learn,
            "tools.train.export",
            "--fit",
            str(run / "fit"),
            "--model",
            str(self.model),
        ]
        settle = [
            *learn,
            "tools.train.score_calibration",
            "--model",
            str(self.model),
            "--bare",
            str(run / "bare"),
        ]
        judge = [
            *draw,
            "tools.train.evaluation",
            "--model",
            str(self.model),
            "--out",
            str(run / "fit"),
        ]
        judge += ["--unseen", str(run / "unseen"), "--bare", str(run / "bare")]
        card = [*draw, "tools.train.card", "--run", str(run)]
        return [*drawn, fit, [*export, "--commit", commit()], settle, judge, card]


def main(arguments: list[str] | None = None) -> int:
    """Run every step; return 0, 2 when refused, 130 when interrupted, or what a step returned."""
    plan = _plan(arguments)
    if not plan.learn.is_file():
        print(f"train: no {plan.learn}: make that environment first (tools/train/README.md)")
        return REFUSED
    began_s = time.monotonic()
    for command in plan.steps():
        print(f"== {' '.join(command[1:])}", flush=True)
        code = _run(command)
        if code != 0:
            return code
        print(f"== {(time.monotonic() - began_s) / 60:.1f} min since the start", flush=True)
    return 0


def _run(command: list[str]) -> int:
    with subprocess.Popen(command, cwd=ROOT) as process:
        try:
            return process.wait()
        except KeyboardInterrupt:
            process.wait()  # it got the same Ctrl-C and keeps what it has
            return INTERRUPTED


def commit() -> str:
    """Return the commit of this checkout; '' outside of one."""
    command = ["git", "rev-parse", "--short", "HEAD"]
    try:
        return subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, check=True
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def _plan(arguments: list[str] | None) -> TrainingPlan:
    home = Path(os.environ.get("PONS_HOME") or ROOT / ".pons").absolute() / "train"
    parser = argparse.ArgumentParser(prog="python -m tools.train", description=__doc__)
    parser.add_argument("--frames", type=int, default=FRAMES)
    parser.add_argument("--epochs", type=int, default=Schedule().epochs)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--run", type=Path, default=home / "run")
    parser.add_argument("--learn", type=Path, default=home / "venv" / "bin" / "python")
    parser.add_argument("--model", type=Path, default=MODEL)
    given = parser.parse_args(arguments)
    return TrainingPlan(
        given.run, given.learn, given.model, given.frames, given.epochs, given.cores
    )


if __name__ == "__main__":
    sys.exit(main())
