"""Define the network: a few plain convolutions on three strides. Knows no loss and no file.

Plain 3x3 convolutions with batch norm and ReLU in the trunk, since every runtime folds and fuses
them; the parts at strides 8 and 16 hold most of the weights, those at stride 4 are narrow, because
a channel costs 16 times as much there.
"""

from __future__ import annotations

from math import log
from typing import Any

import torch
from torch import nn

from tools.train.budget import CLASSES, HEIGHT_PX, STRIDES, WIDTH_PX

Tensor = Any
WIDTHS = (16, 24, 48, 96)
"""Channels at strides 2, 4, 8 and 16."""
RARE = 0.001
"""How likely a cell holds a class before anything is learnt."""
MAX_LOG = 4.0
"""A side lies at most e^4 strides from its cell: 218 px at stride 4, 873 px at stride 16."""


def unit(cin: int, cout: int, size: int = 3, step: int = 1, groups: int = 1) -> nn.Sequential:
    """Return convolution, batch norm and ReLU."""
    return nn.Sequential(
        nn.Conv2d(cin, cout, size, step, size // 2, groups=groups, bias=False),
        nn.BatchNorm2d(cout),
        nn.ReLU(inplace=True),
    )


class Pair(nn.Module):
    """Add what two convolutions find to what came."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.found = nn.Sequential(unit(width, width), unit(width, width))

    def forward(self, x: Tensor) -> Tensor:
        return x + self.found(x)


class NetStage(nn.Module):
    """Refine half of the channels step by step and mix all that was found on the way."""

    def __init__(self, cin: int, cout: int, pairs: int) -> None:
        super().__init__()
        half = cout // 2
        self.kept, self.begun = unit(cin, half, 1), unit(cin, half, 1)
        self.pairs = nn.ModuleList(Pair(half) for _ in range(pairs))
        self.mixed = unit(half * (pairs + 2), cout, 1)

    def forward(self, x: Tensor) -> Tensor:
        found = [self.kept(x), self.begun(x)]
        for pair in self.pairs:
            found.append(pair(found[-1]))
        return self.mixed(torch.cat(found, 1))


class Around(nn.Module):
    """Let every cell know what lies around it, up to six cells away."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.less = unit(width, width // 2, 1)
        self.widest = nn.MaxPool2d(5, 1, 2)
        self.mixed = unit(width * 2, width, 1)

    def forward(self, x: Tensor) -> Tensor:
        seen = [self.less(x)]
        for _ in range(3):
            seen.append(self.widest(seen[-1]))
        return self.mixed(torch.cat(seen, 1))


class Head(nn.Module):
    """Say for each cell of one stride what is there and where its four sides are."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.thought = nn.Sequential(unit(width, width, 3, groups=width), unit(width, width, 1))
        self.what = nn.Conv2d(width, len(CLASSES), 1)
        self.where = nn.Conv2d(width, 4, 1)
        nn.init.constant_(self.what.bias, -log((1 - RARE) / RARE))
        nn.init.zeros_(self.where.bias)

    def forward(self, x: Tensor) -> tuple[Tensor, Tensor]:
        thought = self.thought(x)
        return self.what(thought).flatten(2), self.where(thought).flatten(2)


class Net(nn.Module):
    """See a picture (B, 3, 240, 320), RGB from 0 to 1; speak per cell of strides 4, 8 and 16."""

    def __init__(self) -> None:
        super().__init__()
        a, b, c, d = WIDTHS
        self.to4 = nn.Sequential(unit(3, a, 3, 2), unit(a, b, 3, 2))
        self.to8 = nn.Sequential(unit(b, c, 3, 2), NetStage(c, c, 2))
        self.to16 = nn.Sequential(unit(c, d, 3, 2), NetStage(d, d, 2), Around(d))
        self.back8 = NetStage(c + d, c, 1)
        self.less8 = unit(c, b, 1)
        self.back4 = unit(b, b)
        self.heads = nn.ModuleList(Head(width) for width in (b, c, d))
        self.up = nn.Upsample(scale_factor=2, mode="nearest")

    def forward(self, pictures: Tensor) -> tuple[Tensor, Tensor]:
        """Return class logits (B, 14, N) and boxes (B, 4, N): left, top, right, bottom [px]."""
        spoken = [head(x) for head, x in zip(self.heads, self.features(pictures), strict=True)]
        logits = torch.cat([what for what, _ in spoken], 2)
        sides = torch.cat([where for _, where in spoken], 2)
        return logits, sides

    def features(self, pictures: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Return what the heads speak of, at strides 4, 8 and 16."""
        at4 = self.to4(pictures)
        at8 = self.to8(at4)
        at16 = self.to16(at8)
        at8 = self.back8(torch.cat([at8, self.up(at16)], 1))
        return self.back4(at4 + self.up(self.less8(at8))), at8, at16


def cells(wide: int = WIDTH_PX, high: int = HEIGHT_PX) -> tuple[Tensor, Tensor]:
    """Return the middles (2, N) [px] and strides (1, N) [px] of all cells, finest first."""
    middles, strides = [], []
    for stride in STRIDES:
        rows, columns = high // stride, wide // stride
        y, x = torch.meshgrid(torch.arange(rows), torch.arange(columns), indexing="ij")
        middles.append((torch.stack([x, y]).flatten(1) + 0.5) * stride)
        strides.append(torch.full((1, rows * columns), float(stride)))
    return torch.cat(middles, 1), torch.cat(strides, 1)


def corners(sides: Tensor, middles: Tensor, strides: Tensor) -> Tensor:
    """Return boxes (B, 4, N) as left, top, right, bottom [px] from what the heads say of sides."""
    reach = sides.clamp(-MAX_LOG, MAX_LOG).exp() * strides
    return torch.cat([middles - reach[:, :2], middles + reach[:, 2:]], 1)


def gflops(net: nn.Module) -> float:
    """Count two operations for each multiply-add of every convolution, for one picture."""
    counted: list[float] = []

    def count(layer: Any, _given: Any, made: Tensor) -> None:
        weights = layer.weight
        counted.append(2.0 * weights.shape[1] * weights[0, 0].numel() * made[0].numel())

    hooks = [
        layer.register_forward_hook(count)
        for layer in net.modules()
        if isinstance(layer, nn.Conv2d)
    ]
    was = net.training
    with torch.no_grad():
        net.eval()(torch.zeros(1, 3, HEIGHT_PX, WIDTH_PX))
    net.train(was)
    for hook in hooks:
        hook.remove()
    return sum(counted) / 1e9
