"""Settle how sure the model must be of each class: ``python -m tools.train.score_calibration``.

A class is believed from the lowest score at which hardly any frame without anything of ours shows
it. The frames are of bare homes after those that are judged: nobody learnt from them. What comes
out goes into the file's metadata, where the planner's detector reads it. Needs ``onnx``.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import onnx

from tools.train.budget import BARE_FRAMES, CLASSES, GHOST_SHARE, MIN_SCORE, MOST_SCORE
from tools.train.evaluation import KEY, ScoredModel
from tools.train.store import NoFrames, read_all

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tools.train.score import ScoredThing

STEP = 0.01


def main(arguments: list[str] | None = None) -> int:
    """Settle and write; return 0, or 2 without frames."""
    parser = argparse.ArgumentParser(
        prog="python -m tools.train.score_calibration", description=__doc__
    )
    parser.add_argument("--model", type=Path, required=True)
    parser.add_argument("--bare", type=Path, required=True, help="frames of bare homes")
    given = parser.parse_args(arguments)
    try:
        frames = read_all(given.bare)[BARE_FRAMES:]
    except NoFrames as error:
        print(f"tools.train.score_calibration: {error}", file=sys.stderr)
        return 2
    model = ScoredModel(given.model)
    least = settle_scores([model.detect(frame.jpeg) for frame in frames])
    file = onnx.load(given.model)
    facts = {entry.key: entry.value for entry in file.metadata_props}
    onnx.helper.set_model_props(file, {**facts, KEY: str(least)})
    given.model.write_bytes(file.SerializeToString())
    said = ", ".join(f"{name} {score:.2f}" for name, score in zip(CLASSES, least, strict=True))
    print(f"least scores by {len(frames)} bare frames: {said}")
    return 0


def settle_scores(bare: Sequence[Sequence[ScoredThing]]) -> list[float]:
    """Return the least score of each class, given what was found in frames that hold nothing."""
    allowed = int(GHOST_SHARE * len(bare))
    return [_settle_class(sorted(_scores(bare, label), reverse=True), allowed) for label in CLASSES]


def _scores(bare: Sequence[Sequence[ScoredThing]], label: str) -> list[float]:
    return [it.score for found in bare for it in found if it.label == label]


def _settle_class(ghosts: list[float], allowed: int) -> float:
    """Return a score that only so many ghosts reach, a step above the next. The surest first."""
    if len(ghosts) <= allowed:
        return MIN_SCORE
    above = round(int(ghosts[allowed] / STEP + 1.0) * STEP, 2)
    return min(MOST_SCORE, max(MIN_SCORE, above))


if __name__ == "__main__":
    sys.exit(main())
