"""Measure what the default detector finds in homes that it never saw, and what it sees in nothing.

The frames are drawn as for training, from seeds that training does not use, and kept; the pictures
go through the planner's own detector. Its least score is lowered for the precision curve only.
"""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from planner.perception.detect import ModelOptions, OnnxDetector
from planner.perception.process_client import DEFAULT_MODEL
from tools.bench.report import ReportRow
from tools.train.budget import BARE_FRAMES, GOAL_FALSE, GOAL_MAP50, UNSEEN_FRAMES
from tools.train.evaluation import KEY, judge_model, least_of, pictures
from tools.train.frames import draw_shard, recipe, shards
from tools.train.score import ScoredThing
from tools.train.store import claim, missing, read_all

if TYPE_CHECKING:
    from pathlib import Path
    from typing import Any

    from tools.bench.context import BenchLab
    from tools.train.homes import Kind
    from tools.train.store import StoredFrame

NAME = "detector_map"
TITLE = "default detector on homes that it never saw"
LONG_ONLY = False
LEAST = 0.05
"""As low as the planner's own setting goes."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Score the detector that comes with Pons."""
    if not DEFAULT_MODEL.is_file():
        return [
            ReportRow(
                "mAP50", "", f">= {GOAL_MAP50}", value="not measured", note="no default model"
            )
        ]
    detector = OnnxDetector(ModelOptions(DEFAULT_MODEL), LEAST)

    def detect(jpeg: bytes) -> list[ScoredThing]:
        return [ScoredThing(it.label, it.score, it.box) for it in detector.look(jpeg).detections]

    lab.say("what is found")
    seen = pictures(frames(lab, "unseen", UNSEEN_FRAMES), detect)
    least = least_of(detector.model.session.metadata.get(KEY))
    return rows(judge_model(seen, pictures(frames(lab, "bare", BARE_FRAMES), detect), least))


def frames(lab: BenchLab, kind: Kind, count: int) -> list[StoredFrame]:
    """Return drawn frames: those of an earlier run where the code that draws is the same."""
    wanted = recipe(kind)
    folder: Path = lab.store.path.parent / f"frames_{kind}_{wanted['code'][:12]}"
    for old in lab.store.path.parent.glob(f"frames_{kind}_*"):
        if old != folder:
            shutil.rmtree(old)
    claim(folder, wanted)
    left = missing(folder, shards(kind, count))
    for done, index in enumerate(left):
        lab.say(f"drawing {kind} homes {done}/{len(left)}")
        draw_shard(folder, kind, index)
    return read_all(folder)[:count]


def rows(result: dict[str, Any]) -> list[ReportRow]:
    """Return the table of a verdict."""
    worst = sorted(result["classes"], key=lambda it: it["average_precision"])[:3]
    named = ", ".join(f"{it['label']} {it['average_precision']:.2f}" for it in worst)
    false, empty = result["false_in_empty"], result["empty_frames"]
    return [
        ReportRow(
            "mAP50",
            "",
            f">= {GOAL_MAP50}",
            value=f"{result['map50']:.3f}",
            note=f"{result['frames']} frames; worst: {named}",
        ),
        ReportRow(
            "false in an empty frame",
            "",
            f"<= {GOAL_FALSE}",
            value=f"{false / max(1, empty):.3f}",
            note=f"{false} in {empty}, at the least scores that the file says",
            valid=empty > 0,
        ),
    ]
