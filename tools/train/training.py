"""Fit the network to frames: ``python -m tools.train.training --frames DIR --out DIR``.

Goes on where an interrupted run stopped; Ctrl-C keeps what was learnt. Runs in the environment of
tools/train/requirements.txt. The same frames, schedule, threads and PyTorch give the same weights.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

import torch

from tools.train.batches import Batch, Feeder
from tools.train.budget import MAX_GFLOPS, Schedule
from tools.train.learner import Learner
from tools.train.model import gflops
from tools.train.store import read_all

if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130
SAVE_EACH, SAY_EACH = 200, 10
"""Steps between two checkpoints, and between two lines of progress."""


def main(arguments: list[str] | None = None) -> int:
    """Fit; return 0 when done, 2 when refused, 130 when interrupted."""
    given = _options(arguments)
    torch.set_num_threads(given.threads)
    torch.use_deterministic_algorithms(mode=True)
    schedule = replace(Schedule(), epochs=given.epochs)
    torch.manual_seed(schedule.seed)
    try:
        frames = read_all(given.frames)
        feeder = Feeder(frames, schedule)
        learner = Learner(feeder, schedule)
        learner.resume(given.out)
    except ValueError as error:
        print(f"tools.train.training: {error}", file=sys.stderr)
        return 2
    cost = gflops(learner.net)
    if not cost <= MAX_GFLOPS:
        print(
            f"tools.train.training: {cost:.3f} GFLOPs, the budget is {MAX_GFLOPS}", file=sys.stderr
        )
        return 2
    print(f"{len(frames)} frames, {feeder.steps} steps, {cost:.3f} GFLOPs a picture", flush=True)
    done = run(learner, feeder, given.out)
    facts = {
        **asdict(schedule),
        "frames": len(frames),
        "seconds": round(learner.seconds),
        "gflops": round(cost, 4),
        "threads": given.threads,
        "torch": torch.__version__,
        "steps": learner.step,
    }
    (given.out / "fit.json").write_text(json.dumps(facts, indent=1) + "\n", "utf-8")
    return 0 if done else INTERRUPTED


def run(learner: Learner, feeder: Feeder, out: Path) -> bool:
    """Learn step by step, the next batch being made meanwhile; say whether all was done."""
    stopped: list[int] = []

    def stop(signum: int, _frame: FrameType | None) -> None:
        stopped.append(signum)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    out.mkdir(parents=True, exist_ok=True)
    began_s, began = time.monotonic(), learner.step
    with ThreadPoolExecutor(1) as pool:
        coming = pool.submit(feeder.batch, learner.step) if learner.step < feeder.steps else None
        while coming is not None and not stopped:
            batch: Batch = coming.result()
            after = learner.step + 1
            coming = pool.submit(feeder.batch, after) if after < feeder.steps else None
            losses = learner.learn(batch)
            if learner.step % SAVE_EACH == 0:
                learner.save(out)
            if learner.step % SAY_EACH == 0:
                _say(learner, feeder, losses, (time.monotonic() - began_s) / (after - began))
    learner.save(out)
    print(f"\n{'stopped' if stopped else 'done'} at step {learner.step} of {feeder.steps}")
    return learner.step >= feeder.steps


def _say(learner: Learner, feeder: Feeder, losses: tuple[float, float], each_s: float) -> None:
    left_min = (feeder.steps - learner.step) * each_s / 60
    epoch = learner.step / feeder.steps_an_epoch
    text = (
        f"epoch {epoch:6.2f}  score loss {losses[0]:.3f}  box loss {losses[1]:.3f}  "
        f"{each_s * 1e3:.0f} ms/step  {left_min:.0f} min left"
    )
    print(text, end="\x1b[K\r" if sys.stdout.isatty() else "\n", flush=True)


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tools.train.training", description=__doc__)
    parser.add_argument("--frames", type=Path, required=True, help="a folder of tools.train.frames")
    parser.add_argument("--out", type=Path, required=True, help="where the checkpoint goes")
    parser.add_argument("--epochs", type=int, default=Schedule().epochs)
    parser.add_argument("--threads", type=int, default=2)
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
