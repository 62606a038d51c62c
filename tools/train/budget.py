"""Fix what training may cost and how it is judged, before anything is trained. Data only.

Raising a number here is a decision; a run that needs more fails instead of taking it.
"""

from __future__ import annotations

from dataclasses import dataclass

CLASSES = (
    "person",
    "chair",
    "sofa",
    "table",
    "bed",
    "tv",
    "fridge",
    "plant",
    "door",
    "box",
    "cup",
    "ball",
    "bottle",
    "book",
)
"""In the order of the model's outputs; ids are appended, never reordered."""

WIDTH_PX, HEIGHT_PX = 320, 240
"""The simulated camera's own size: no letterbox, and a cup at 3 m is still 6 px wide."""

SMALL_PX = (192, 144)
"""What the first steps learn from; a multiple of the coarsest stride."""
STRIDES = (4, 8, 16)
"""Stride 4 is there for what is 6 to 10 px wide."""

MAX_GFLOPS = 0.4
"""Two operations for each multiply-add of a convolution, for one picture."""
MAX_BYTES = 4_000_000
"""Of the exported file."""
MAX_HOURS = 2.0
"""For drawing, fitting, exporting and scoring together, on two cores."""

FRAMES = 20_000
UNSEEN_FRAMES = 500
BARE_FRAMES = 300
"""Pictures of homes that hold nothing of ours, to count what is seen where nothing is."""
SPARE_FRAMES = 3_000
"""More of them, by which the least scores are settled; nobody is judged on these."""
FRAMES_A_HOME = {"train": 10, "unseen": 5, "bare": 5}
HOMES_A_SHARD = 20

FLOOR = 0.02
"""What is less sure is nothing: the file is silent of it, and precision is judged down to this."""
SAME = 0.5
"""Two boxes of a class that overlap more are one thing: as the planner has it for other models."""
CANDIDATES, MOST_BOXES = 128, 100
"""Of a picture so many of the surest cells are made boxes of, and so many boxes come out. In 500
frames of unseen homes at most 56 cells were 0.4 sure, 117 were 0.05; twice as many cost 1 %."""

GOAL_MAP50 = 0.85
GOAL_FALSE = 0.02
"""Detections in an empty picture, on average, at the shipped least scores."""
MIN_SCORE, MOST_SCORE = 0.4, 0.8
"""The least score of a class lies between: lower nothing is believed, higher little would be seen.
"""
GHOST_SHARE = 1 / 600
"""Of empty frames, in which a class may be seen where nothing is: 14 classes make 0.023 at most,
and less, since few of them have so many ghosts from the lowest score on."""


@dataclass(frozen=True, slots=True)
class Schedule:
    """Say how a network is fitted. The same schedule, frames and threads give the same weights."""

    epochs: int = 16
    """So many fit into the hours above; more are better."""
    small_share: float = 0.55
    """Of the steps: the first see pictures of SMALL_PX, the same shapes for a third of the work."""
    plain_share: float = 0.2
    """Of the steps: the last see frames as they were drawn, mirrored at most, in float32.

    Those before compute in bfloat16, for half the time on some processors; weights, average and
    losses are float32 throughout.
    """
    batch: int = 16
    peak_rate: float = 2e-3
    """Learning rate [1/step] after the warm-up; a cosine leads it to 2 % of that."""
    warm_steps: int = 300
    decay: float = 0.05
    clip: float = 10.0
    """Greatest norm of a gradient."""
    average: float = 0.999
    """How much of the averaged weights a step keeps, once it has run for a while."""
    seed: int = 6
