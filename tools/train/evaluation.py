"""Score a model on homes that it never saw: ``python -m tools.train.evaluation --model F …``.

Reads what this workshop's own export says, and nothing else; the benches score the same frames
through the planner's detector. Runs in the project's own environment.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import onnxruntime

from tools.train.augment import decode
from tools.train.budget import BARE_FRAMES, CLASSES, MIN_SCORE
from tools.train.score import ScoredThing, TrueThing, false_in_empty, mean_average_precision, scores
from tools.train.store import NoFrames, read_all

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from tools.train.score import Picture
    from tools.train.store import StoredFrame

    Detect = Callable[[bytes], list[ScoredThing]]

KEY = "min_scores"
"""In a file's metadata: the least score of each class that is believed."""


class ScoredModel:
    """Ask an exported model about frames."""

    def __init__(self, path: Path) -> None:
        options = onnxruntime.SessionOptions()
        options.intra_op_num_threads = 1
        options.add_session_config_entry("session.intra_op.allow_spinning", "0")
        self._session = onnxruntime.InferenceSession(
            str(path), options, providers=["CPUExecutionProvider"]
        )
        told = self._session.get_modelmeta().custom_metadata_map.get(KEY)
        self.least = least_of(told)
        self.seconds: list[float] = []
        """How long each picture took, from its bytes to finished boxes."""

    def detect(self, jpeg: bytes) -> list[ScoredThing]:
        """Return what is found, down to a low score."""
        picture = np.ascontiguousarray(decode(jpeg)[None, :, :, ::-1])  # blue green red
        began_s = time.perf_counter()
        rows = self._session.run(None, {"images": picture})[0]
        self.seconds.append(time.perf_counter() - began_s)
        return read_detections(rows[0])


def read_detections(rows: NDArray[np.float32]) -> list[ScoredThing]:
    """Return detections from (n, 6): left, top, right, bottom [px], score, class."""
    return [
        ScoredThing(CLASSES[int(number)], score, (left, top, right, bottom))
        for left, top, right, bottom, score, number in rows.tolist()
    ]


def pictures(frames: Sequence[StoredFrame], detect: Detect) -> list[Picture]:
    """Return what is in each frame beside what is found in it."""
    return [(truth(frame), detect(frame.jpeg)) for frame in frames]


def truth(frame: StoredFrame) -> list[TrueThing]:
    """Return what is in a frame."""
    return [
        TrueThing(CLASSES[int(row[0])], (row[1], row[2], row[3], row[4]), row[5] > 0)
        for row in frame.things.tolist()
    ]


def least_of(told: str | None) -> dict[str, float]:
    """Return from which score each class is believed, as a file's metadata tell."""
    given: list[float] = json.loads(told) if told else [MIN_SCORE] * len(CLASSES)
    return dict(zip(CLASSES, given, strict=True))


def judge_model(
    seen: Sequence[Picture], empty: Sequence[Picture], least: Mapping[str, float]
) -> dict[str, Any]:
    """Return every number that the card states of a model."""
    classes = scores(seen, least)
    count, false = false_in_empty([*seen, *empty], least)
    return {
        "frames": len(seen),
        "map50": mean_average_precision(classes),
        "classes": [asdict(it) for it in classes.values()],
        "empty_frames": count,
        "false_in_empty": false,
        "least": dict(least),
    }


def main(arguments: list[str] | None = None) -> int:
    """Score and print a table; return 0, or 2 without frames."""
    parser = argparse.ArgumentParser(prog="python -m tools.train.evaluation", description=__doc__)
    parser.add_argument("--model", type=Path, required=True)
    parser.add_argument("--unseen", type=Path, required=True, help="frames of unseen homes")
    parser.add_argument("--bare", type=Path, required=True, help="frames of bare homes")
    parser.add_argument("--frames", type=int, default=500)
    parser.add_argument("--out", type=Path, help="a folder for judge.json")
    given = parser.parse_args(arguments)
    try:
        unseen, bare = read_all(given.unseen)[: given.frames], read_all(given.bare)[:BARE_FRAMES]
    except NoFrames as error:
        print(f"tools.train.evaluation: {error}", file=sys.stderr)
        return 2
    model = ScoredModel(given.model)
    seen = pictures(unseen, model.detect)
    result = judge_model(seen, pictures(bare, model.detect), model.least)
    result["ms_p50"] = 1e3 * float(np.median(model.seconds))
    print(table(result))
    if given.out is not None:
        (given.out / "judge.json").write_text(json.dumps(result, indent=1) + "\n", "utf-8")
    return 0


def table(result: dict[str, Any]) -> str:
    """Return the numbers as lines that a person reads."""
    lines = [f"{'class':<8} {'asked':>6} {'AP50':>6} {'recall':>7} {'precision':>10}"]
    lines += [
        f"{it['label']:<8} {it['asked']:>6} {it['average_precision']:>6.3f} {it['recall']:>7.3f} "
        f"{it['precision']:>10.3f}"
        for it in result["classes"]
    ]
    each = result["false_in_empty"] / max(1, result["empty_frames"])
    lines.append(f"mAP50 {result['map50']:.3f} on {result['frames']} frames of unseen homes")
    lines.append(f"{each:.3f} false in each of {result['empty_frames']} empty frames")
    lines.append(f"{result['ms_p50']:.1f} ms a frame on one thread, from bytes to boxes")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
