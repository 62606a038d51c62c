"""Make of the fitted network what is shipped: a picture's bytes in, finished boxes out.

What else would be done beside the model for each picture is done in it, where it costs least:
scaling lies in the first weights, and only the surest cells are ever made boxes of.
"""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import torch
from torch import nn

from tools.train.budget import CANDIDATES, CLASSES, FLOOR, HEIGHT_PX, MOST_BOXES, SAME, WIDTH_PX
from tools.train.model import Head, Net, Tensor, cells, corners
from tools.train.score import Box, overlap

COUNT = len(CLASSES)
APART_PX = 4096.0
"""Boxes of two classes never overlap once shifted by this: none reaches 900 px out of a picture."""


class ShippedNet(nn.Module):
    """See bytes (1, 240, 320, 3), blue green red; speak rows (1, n, 6), the surest first.

    A row is left, top, right, bottom [px], score, class.
    """

    def __init__(self, net: Net) -> None:
        super().__init__()
        self.net = deepcopy(net)
        self.net.to4[0][0] = on_strip(self.net.to4[0][0])
        self.heads = nn.ModuleList(join_heads(head) for head in self.net.heads)
        self.register_buffer("cells", torch.cat(cells())[None])

    def forward(self, pictures: Tensor) -> Tensor:
        return rows(self.raw_rows(pictures), self.cells)

    def raw_rows(self, pictures: Tensor) -> Tensor:
        """Return what every cell says, (1, 14 + 4, N): class logits and sides."""
        strip = pictures.reshape(1, 1, HEIGHT_PX, 3 * WIDTH_PX).to(torch.float32)
        seen = zip(self.heads, self.net.features(strip), strict=True)
        return torch.cat([head(x).flatten(2) for head, x in seen], 2)


def on_strip(conv: nn.Conv2d) -> nn.Conv2d:
    """Return a first convolution (3 x 3, step 2) that reads bytes as they lie in a picture.

    Its three channels stand side by side as one that is three times as wide, so that nothing has
    to be sorted into planes (1.5 % of a run); it takes blue green red from 0 to 255.
    """
    made = nn.Conv2d(1, conv.out_channels, (3, 9), (2, 6), (1, 3), bias=False)
    weight = conv.weight.detach().flip(1) / 255
    made.weight = nn.Parameter(weight.permute(0, 2, 3, 1).reshape(made.weight.shape))
    return made


def join_heads(head: Head) -> nn.Sequential:
    """Return a head that says with one convolution what is there and where."""
    conv = nn.Conv2d(head.what.in_channels, COUNT + 4, 1)
    conv.weight = nn.Parameter(torch.cat([head.what.weight, head.where.weight]).detach())
    conv.bias = nn.Parameter(torch.cat([head.what.bias, head.where.bias]).detach())
    return nn.Sequential(head.thought, conv)


def rows(said: Tensor, where: Tensor) -> Tensor:
    """Return finished boxes (1, n, 6) of what all cells say (1, 18, N); ``where`` they are."""
    surest, at = said[:, :COUNT].amax(1).topk(CANDIDATES, 1)
    said, where = said.index_select(2, at[0]), where.index_select(2, at[0])
    boxes = corners(said[:, COUNT:], where[:, :2], where[:, 2:])
    scores = surest.sigmoid()[:, None]
    classes = said[:, :COUNT].argmax(1, keepdim=True).to(torch.float32)
    apart = (boxes + classes * APART_PX).transpose(1, 2)
    kept = SuppressOverlaps.apply(apart, scores)[:, 2]
    return torch.cat([boxes, scores, classes], 1).transpose(1, 2).index_select(1, kept)


class SuppressOverlaps(torch.autograd.Function):
    """Choose the surest of each heap of boxes: ONNX has an operator for that, PyTorch has none."""

    @staticmethod
    def forward(_ctx: Any, boxes: Tensor, scores: Tensor) -> Tensor:
        """Return (n, 3), of which the last is a box's number, given (1, N, 4) and (1, 1, N)."""
        kept = greedy(list(map(tuple, boxes[0].tolist())), scores[0, 0].tolist())
        return torch.tensor([(0, 0, number) for number in kept], dtype=torch.int64).reshape(-1, 3)

    @staticmethod
    def symbolic(g: Any, boxes: Any, scores: Any) -> Any:
        """Name the operator for the file."""
        limits = (torch.tensor([MOST_BOXES]), torch.tensor([SAME]), torch.tensor([FLOOR]))
        given = [g.op("Constant", value_t=limit) for limit in limits]
        return g.op("NonMaxSuppression", boxes, scores, *given)


def greedy(boxes: list[Box], scores: list[float]) -> list[int]:
    """Return which boxes stay, the surest first: none too like a surer one."""
    kept: list[int] = []
    for number in sorted(range(len(scores)), key=lambda it: -scores[it]):
        if len(kept) == MOST_BOXES or not scores[number] > FLOOR:
            break
        if all(overlap(boxes[number], boxes[other]) <= SAME for other in kept):
            kept.append(number)
    return kept
