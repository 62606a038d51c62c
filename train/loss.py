"""Say how wrong the network is about a batch: scores by cross entropy, boxes by overlap.

What is too small or too hidden to be asked for is neither: cells in it are not judged.
"""

from __future__ import annotations

from math import pi
from typing import Any

import torch
from torch.nn.functional import binary_cross_entropy_with_logits

from train.assign import TINY, assign, overlap, within
from train.model import corners

Tensor = Any
BOX_WEIGHT = 5.0


def loss(
    logits: Tensor, sides: Tensor, grid: tuple[Tensor, Tensor], targets: Tensor
) -> tuple[Tensor, Tensor]:
    """Return the mean loss of scores and that of boxes.

    Args:
        logits: (B, classes, N).
        sides: (B, 4, N) as the heads say them.
        grid: middles (2, N) and strides (1, N) [px].
        targets: (B, M, 6): class, left, top, right, bottom [px], and 1 asked, -1 not judged,
            0 padded.
    """
    middles, strides = grid
    said = corners(sides, middles[None], strides[None]).transpose(1, 2)
    logits = logits.transpose(1, 2)
    boxes, kind = targets[..., 1:5], targets[..., 5]
    labels = targets[..., 0].long()
    answering, wanted, owner = assign(
        logits.detach().sigmoid(), said.detach(), middles, boxes, labels, kind > 0
    )
    spared = (within(middles, boxes, 0.0) & (kind < 0)[:, :, None]).any(1) & ~answering
    whole = wanted.sum().clamp(min=1.0)
    told = binary_cross_entropy_with_logits(logits, wanted, reduction="none")
    score_loss = (told * ~spared[..., None]).sum() / whole
    if not bool(answering.any()):
        return score_loss, sides.sum() * 0.0
    true = boxes.gather(1, owner[..., None].expand(-1, -1, 4))[answering]
    weight = wanted.sum(-1)[answering]
    box_loss = ((1 - complete(said[answering], true)) * weight).sum() / whole
    return score_loss, BOX_WEIGHT * box_loss


def complete(said: Tensor, true: Tensor) -> Tensor:
    """Return complete overlap (K): IoU less the middles' distance and the shapes' difference.

    Source: Zheng et al., "Distance-IoU Loss", AAAI 2020, equations 10 and 11.
    """
    shared = overlap(said, true)
    low, high = torch.minimum(said[:, :2], true[:, :2]), torch.maximum(said[:, 2:], true[:, 2:])
    span = (high - low).pow(2).sum(1) + TINY
    apart = (said[:, :2] + said[:, 2:] - true[:, :2] - true[:, 2:]).pow(2).sum(1) / 4
    tilt = 4 / pi**2 * (_tilt(true) - _tilt(said)).pow(2)
    with torch.no_grad():
        share = tilt / (1 - shared + tilt + TINY)
    return shared - apart / span - share * tilt


def _tilt(box: Tensor) -> Tensor:
    size = (box[:, 2:] - box[:, :2]).clamp(min=TINY)
    return torch.atan(size[:, 0] / size[:, 1])
