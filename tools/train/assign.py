"""Decide which cells answer for which box: those that already say it best, near its middle.

The rule is task alignment (Feng et al., "TOOD", ICCV 2021, section 3.2): a cell's worth for a box
is score^0.5 times overlap^6 of what it says now; the ten worthiest cells inside a box answer for
it, and their score is asked to grow to the best overlap among them.
"""

from __future__ import annotations

from typing import Any

import torch

from tools.train.budget import CLASSES, STRIDES

Tensor = Any
CELLS_A_BOX = 10
SCORE_POWER, OVERLAP_POWER = 0.5, 6.0
TINY = 1e-9
NEAR_PX = 0.75 * STRIDES[0]
"""A cell so near to a box's middle may answer for it though the box is too small to hold one."""


def overlap(a: Tensor, b: Tensor) -> Tensor:
    """Return intersection over union of boxes (..., 4) that broadcast."""
    low, high = torch.maximum(a[..., :2], b[..., :2]), torch.minimum(a[..., 2:], b[..., 2:])
    shared = (high - low).clamp(min=0).prod(-1)
    return shared / (_area(a) + _area(b) - shared + TINY)


def _area(box: Tensor) -> Tensor:
    return (box[..., 2:] - box[..., :2]).clamp(min=0).prod(-1)


def middles_within(middles: Tensor, boxes: Tensor, least_px: float) -> Tensor:
    """Say (M, N) which middles (2, N) lie in which boxes (M, 4), tiny ones widened."""
    centre = (boxes[:, :2] + boxes[:, 2:]) / 2
    half = ((boxes[:, 2:] - boxes[:, :2]) / 2).clamp(min=least_px)
    off = (middles[None] - centre[:, :, None]).abs()
    return (off <= half[:, :, None]).all(1)


@torch.no_grad()
def assign(
    scores: Tensor, said: Tensor, middles: Tensor, boxes: Tensor, labels: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Match the cells of one picture with its boxes, of which there is at least one.

    Args:
        scores: (N, classes), 0 to 1, as said now.
        said: (N, 4) boxes as said now [px].
        middles: (2, N) [px].
        boxes: (M, 4) true boxes [px].
        labels: (M) their classes.

    Returns:
        answering (N) whether a cell answers for a box; wanted (N, classes) the scores asked of it;
        owner (N) the index of its box.
    """
    count = len(boxes)
    overlaps = overlap(boxes[:, None], said[None])  # (M, N)
    worth = scores.T[labels].pow(SCORE_POWER) * overlaps.pow(OVERLAP_POWER) + TINY
    worth = worth * middles_within(middles, boxes, NEAR_PX)
    best, cell = worth.topk(CELLS_A_BOX, 1)
    chosen = torch.zeros_like(worth).scatter_(1, cell, (best > 0).float()) > 0
    # A cell that two boxes want answers for the one that it overlaps more.
    rank = (overlaps + TINY) * chosen
    chosen &= rank == rank.amax(0, keepdim=True)
    owner = (chosen * torch.arange(count)[:, None]).amax(0)
    chosen &= owner[None] == torch.arange(count)[:, None]
    worth, reach = worth * chosen, (overlaps * chosen).amax(1, keepdim=True)
    most = worth.amax(1, keepdim=True).clamp(min=TINY)
    score = (worth / most * reach).amax(0)
    hot = torch.nn.functional.one_hot(labels[owner], len(CLASSES)).to(score.dtype)
    return chosen.any(0), hot * score[:, None], owner
