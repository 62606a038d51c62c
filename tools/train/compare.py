"""Compare an exported file with the fitted network, on pictures in which it finds something.

The network sees what it was fitted on, planes of red green blue from 0 to 1, and speaks by its own
heads: so what was folded into the file's weights is judged too.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import onnxruntime
import torch

from tools.train.budget import HEIGHT_PX, WIDTH_PX
from tools.train.model import Net, cells
from tools.train.shipped_graph import rows

TOLERANCE = 1e-4
"""Of scores, and of boxes as shares of the picture's width (0.03 px)."""
PICTURES, ENOUGH = 40, 20
"""So many pictures are seen; with fewer boxes in all of them nothing is shown."""
SHAPES = 12
Array = Any


class ExportRefusal(Exception):
    """The exported file differs from the fitted network, or is too large."""


def compare(net: Net, data: bytes) -> float:
    """Return the largest difference between the file's answer and the network's.

    Raises:
        ExportRefused: it is larger than the tolerance, or too little was found to compare.
    """
    session = onnxruntime.InferenceSession(data, providers=["CPUExecutionProvider"])
    random = np.random.default_rng(0)
    worst, boxes = 0.0, 0
    for _ in range(PICTURES):
        picture = draw_picture(random)
        told = session.run(None, {"images": picture[None, :, :, ::-1].copy()})[0]
        worst = max(worst, difference(told, fitted_rows(net, picture)))
        boxes += told.shape[1]
    if not worst <= TOLERANCE:
        raise ExportRefusal(f"the file differs from the network by {worst:.1e}")
    if boxes < ENOUGH:
        raise ExportRefusal(f"{boxes} boxes in {PICTURES} pictures: too few to compare")
    return worst


def draw_picture(random: np.random.Generator) -> Array:
    """Return a picture (height, width, 3) of bytes, red green blue: oblongs and a little noise."""
    picture = np.empty((HEIGHT_PX, WIDTH_PX, 3), np.float32)
    picture[:] = random.uniform(60, 220, 3)
    for _ in range(SHAPES):
        left, top = random.integers(0, (WIDTH_PX - 20, HEIGHT_PX - 20))
        wide, high = random.integers(8, (WIDTH_PX // 2, HEIGHT_PX // 2))
        picture[top : top + high, left : left + wide] = random.uniform(0, 255, 3)
    picture += random.normal(0.0, 4.0, picture.shape)
    return picture.clip(0, 255).astype(np.uint8)


def fitted_rows(net: Net, picture: Array) -> Array:
    """Return the rows that the network as it was fitted makes of a picture, red green blue."""
    planes = torch.from_numpy(picture).permute(2, 0, 1)[None].to(torch.float32) / 255
    with torch.no_grad():
        return rows(torch.cat(net(planes), 1), torch.cat(cells())[None]).numpy()


def difference(told: Array, true: Array) -> float:
    """Return by how much two answers differ; infinitely where they are not as many boxes."""
    if told.shape != true.shape:
        return float("inf")
    off = np.abs(told - true) / np.array([*(WIDTH_PX,) * 4, 1.0, 1.0], np.float32)
    return float(off.max(initial=0.0))
