"""Say how wrong the network is about a batch: scores by cross entropy, boxes by overlap.

What is too small or too hidden to be asked for is neither: cells in it are not judged.
"""

from __future__ import annotations

from math import pi
from typing import Any

import torch
from torch.nn.functional import binary_cross_entropy_with_logits

from tools.train.assign import TINY, assign, middles_within, overlap
from tools.train.model import corners

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
    scores, now = logits.detach().sigmoid(), said.detach()
    wanted, judged = torch.zeros_like(scores), torch.ones_like(scores[..., :1])
    answers, trues, weights = [], [], []
    for i, rows in enumerate(targets):
        asked = rows[rows[:, 5] > 0]
        answering = torch.zeros(middles.shape[1], dtype=torch.bool)
        if len(asked):
            boxes, labels = asked[:, 1:5], asked[:, 0].long()
            answering, wanted[i], owner = assign(scores[i], now[i], middles, boxes, labels)
            answers.append(said[i][answering])
            trues.append(boxes[owner[answering]])
            weights.append(wanted[i][answering].sum(-1))
        spared = middles_within(middles, rows[rows[:, 5] < 0, 1:5], 0.0).any(0) & ~answering
        judged[i, spared] = 0.0
    whole = wanted.sum().clamp(min=1.0)
    told = binary_cross_entropy_with_logits(logits, wanted, reduction="none")
    score_loss = (told * judged).sum() / whole
    if not answers:
        return score_loss, sides.sum() * 0.0
    close = complete(torch.cat(answers), torch.cat(trues))
    box_loss = ((1 - close) * torch.cat(weights)).sum() / whole
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
