"""Decide which cells answer for which box: those that already say it best, near its middle.

The rule is task alignment (Feng et al., "TOOD", ICCV 2021, section 3.2): a cell's worth for a box
is score^0.5 times overlap^6 of what it says now; the ten worthiest cells inside a box answer for
it, and their score is asked to grow to the best overlap among them.
"""

from __future__ import annotations

from typing import Any

import torch

from train.budget import CLASSES, STRIDES

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


def within(middles: Tensor, boxes: Tensor, least_px: float) -> Tensor:
    """Say (B, M, N) which middles (2, N) lie in which boxes (B, M, 4), tiny ones widened."""
    centre = (boxes[..., :2] + boxes[..., 2:]) / 2
    half = ((boxes[..., 2:] - boxes[..., :2]) / 2).clamp(min=least_px)
    off = (middles.T[None, None] - centre[:, :, None]).abs()
    return (off <= half[:, :, None]).all(-1)


@torch.no_grad()
def assign(
    scores: Tensor, said: Tensor, middles: Tensor, boxes: Tensor, labels: Tensor, real: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Match cells with boxes.

    Args:
        scores: (B, N, classes), 0 to 1, as said now.
        said: (B, N, 4) boxes as said now [px].
        middles: (2, N) [px].
        boxes: (B, M, 4) true boxes [px], padded.
        labels: (B, M) their classes.
        real: (B, M) false where padded.

    Returns:
        answering (B, N) whether a cell answers for a box; wanted (B, N, classes) the scores asked
        of it; box (B, N) the index of its box.
    """
    m = boxes.shape[1]
    overlaps = overlap(boxes[:, :, None], said[:, None])  # (B, M, N)
    asked = labels[:, :, None].expand(-1, -1, scores.shape[1])
    told = scores.transpose(1, 2).gather(1, asked)
    worth = told.pow(SCORE_POWER) * overlaps.pow(OVERLAP_POWER)
    inside = within(middles, boxes, NEAR_PX) & real[:, :, None]
    worth = torch.where(inside, worth + TINY, torch.zeros_like(worth))
    best, cell = worth.topk(CELLS_A_BOX, 2)
    chosen = torch.zeros_like(worth).scatter_(2, cell, (best > 0).float()) > 0
    # A cell that two boxes want answers for the one that it overlaps more.
    rank = torch.where(chosen, overlaps + TINY, torch.zeros_like(overlaps))
    chosen &= rank == rank.amax(1, keepdim=True)
    owner = (chosen * torch.arange(m)[None, :, None]).amax(1)  # (B, N)
    chosen &= owner[:, None] == torch.arange(m)[None, :, None]
    return (*_wanted(chosen, worth, overlaps, labels, owner), owner)


def _wanted(
    chosen: Tensor, worth: Tensor, overlaps: Tensor, labels: Tensor, owner: Tensor
) -> tuple[Tensor, Tensor]:
    nothing = torch.zeros_like(worth)
    worth = torch.where(chosen, worth, nothing)
    most = worth.amax(2, keepdim=True).clamp(min=TINY)
    reach = torch.where(chosen, overlaps, nothing).amax(2, keepdim=True)
    score = (worth / most * reach).amax(1)  # (B, N)
    answering = chosen.any(1)
    label = labels.gather(1, owner)
    hot = torch.nn.functional.one_hot(label, len(CLASSES)).to(score.dtype)
    return answering, hot * (score * answering)[..., None]
