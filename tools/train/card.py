"""Write the model's card from what was measured: ``python -m tools.train.card --run DIR``.

Every number comes from a file that a step of the training wrote; the words do not change with them.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from tools.train.boxes import LEAST_PIXELS, LEAST_SHARE, LEAST_SIDE_PX
from tools.train.budget import (
    BARE_FRAMES,
    CANDIDATES,
    CLASSES,
    FLOOR,
    FRAMES,
    GOAL_FALSE,
    GOAL_MAP50,
    HEIGHT_PX,
    MAX_BYTES,
    MAX_GFLOPS,
    MAX_HOURS,
    MOST_BOXES,
    SAME,
    SPARE_FRAMES,
    STRIDES,
    UNSEEN_FRAMES,
    WIDTH_PX,
    Schedule,
)

CARD = Path(__file__).with_name("CARD.md")
Facts = dict[str, Any]


def main(arguments: list[str] | None = None) -> int:
    """Write the card; return 0."""
    parser = argparse.ArgumentParser(prog="python -m tools.train.card", description=__doc__)
    parser.add_argument("--run", type=Path, required=True, help="the folder that make train used")
    given = parser.parse_args(arguments)
    fit, drawn = given.run / "fit", given.run / "train"
    facts = {
        "drawn": _read(drawn / "drawn.json"),
        "fit": _read(fit / "fit.json"),
        "export": _read(fit / "export.json"),
        "judge": _read(fit / "judge.json"),
    }
    CARD.write_text(card(facts), "utf-8")
    print(f"wrote {CARD.name}")
    return 0


def _read(path: Path) -> Facts:
    found: Facts = json.loads(path.read_text("utf-8"))
    return found


def card(facts: Facts) -> str:
    """Return the card."""
    return "\n".join(
        [
            _card_text(facts),
            _write_how(facts["fit"], facts["export"]),
            _score(facts["judge"]),
            LIMITS,
        ]
    )


def _card_text(facts: Facts) -> str:
    fit, export = facts["fit"], facts["export"]
    took = f"{(facts['drawn']['seconds'] + fit['seconds']) / 60:.0f} min"
    return f"""# pons_home: the detector that comes with Pons

Written by `python -m tools.train.card` from what the steps of one training measured.

Finds {len(CLASSES)} things of a home in pictures of {WIDTH_PX} x {HEIGHT_PX}:
{", ".join(CLASSES)}.

| | this model | budget |
|---|---|---|
| operations a picture | {fit["gflops"]:.3f} GFLOPs | {MAX_GFLOPS} |
| weights | {export["parameters"]} | |
| file | {export["bytes"] / 1e6:.2f} MB | {MAX_BYTES / 1e6:.0f} MB |
| frames | {fit["frames"]} | {FRAMES} |
| epochs | {fit["epochs"]} | {Schedule().epochs} |
| drawing and fitting | {took}, {fit["threads"]} threads | {MAX_HOURS:.0f} h on 2 cores |
"""


def _write_how(fit: Facts, export: Facts) -> str:
    return f"""## How it was made

Homes are drawn by seed (`tools/train/homes.py`) and seen by the simulator's own camera in a
light, in
colours and with noise of their own; boxes come from what each pixel shows. A thing is asked for
when its box is at least {LEAST_SIDE_PX:.0f} px wide and high, {LEAST_PIXELS} of its pixels are in
sight and they span {LEAST_SHARE:.0%} of the box that it would have unhidden; of what shows less,
nobody is taught or judged.

The network has convolutions only, and heads at strides {", ".join(map(str, STRIDES))}. It was
fitted from nothing by AdamW in {fit["steps"]} steps of {fit["batch"]} frames (seed {fit["seed"]},
PyTorch {fit["torch"]}): the first {fit["small_share"]:.0%} of them in a smaller size, the last
{fit["plain_share"]:.0%} on frames as they were drawn, all others lit, moved and blurred at random.
The file takes a picture's bytes as they are unpacked, blue green red, and gives finished boxes:
those of the {CANDIDATES} surest cells, without any that overlaps a surer one of its class by more
than {SAME}; {MOST_BOXES} at most, none less sure than {FLOOR}.
It was exported with opset {export["opset"]} from commit {export["commit"] or "unknown"};
the file differs from the network by at most {export["worst_difference"]:.0e}. No picture, weight
or label from elsewhere is in it.
"""


def _score(judge: Facts) -> str:
    false = judge["false_in_empty"] / max(1, judge["empty_frames"])
    classes = "\n".join(
        f"| {it['label']} | {it['asked']} | {it['average_precision']:.3f} "
        f"| {judge['least'][it['label']]:.2f} | {it['recall']:.3f} | {it['precision']:.3f} |"
        for it in judge["classes"]
    )
    return f"""## How it scores on homes that it never saw

On {judge["frames"]} frames of unseen homes (the goal is judged on {UNSEEN_FRAMES}), and on
{BARE_FRAMES} frames of homes without anything of ours, {judge["empty_frames"]} empty ones in all:

| | measured | goal |
|---|---|---|
| mAP50 | {judge["map50"]:.3f} | >= {GOAL_MAP50} |
| false detections in an empty frame | {false:.3f} | <= {GOAL_FALSE} |
| from bytes to boxes, one thread | {judge["ms_p50"]:.1f} ms | |

Recall and precision are those at the least score from which a class is believed. It was settled on
{SPARE_FRAMES} other frames without anything of ours (`tools/train/score_calibration.py`) and
stands in the file:

| class | asked for | AP50 | least score | recall | precision |
|---|---|---|---|---|---|
{classes}
"""


LIMITS = """## What it is not for

It has seen drawn homes only. On pictures of a real camera it finds little, and finds it wrongly: a
real robot needs a model that was trained on photographs, named in its settings (docs/vision.md).
It is no part of what keeps the robot from hitting things or people; that is the bridge, by lidar.
"""


if __name__ == "__main__":
    sys.exit(main())
