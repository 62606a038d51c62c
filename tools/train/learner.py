"""Take one step of learning at a time, average the weights, and survive an interruption."""

from __future__ import annotations

import copy
import time
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import torch
from torch import nn

from tools.train.loss import loss
from tools.train.model import Net, cells

if TYPE_CHECKING:
    from pathlib import Path

    from tools.train.batches import Batch, Feeder
    from tools.train.budget import Schedule

CHECKPOINT = "checkpoint.pt"
WINDOW = 500.0
"""Steps until the average is nearly as slow as it will be."""


class Learner:
    """Hold a network, its average and its optimiser."""

    def __init__(self, feeder: Feeder, schedule: Schedule) -> None:
        self.net = Net().to(memory_format=torch.channels_last)
        self.average = copy.deepcopy(self.net).eval()
        self._feeder, self._schedule = feeder, schedule
        self._optimiser = _optimiser(self.net, schedule)
        self.step = 0
        self.seconds = 0.0

    def learn(self, batch: Batch) -> tuple[float, float]:
        """Take one step; return the losses of scores and of boxes."""
        began_s = time.monotonic()
        for group in self._optimiser.param_groups:
            group["lr"] = self._feeder.rate(self.step)
        pictures = torch.from_numpy(batch.pictures).permute(0, 3, 1, 2)  # channels last, uncopied
        short = not self._feeder.is_plain(self.step)
        with torch.autocast("cpu", torch.bfloat16, enabled=short):
            logits, sides = (said.float() for said in self.net.train()(pictures))
        grid = cells(pictures.shape[3], pictures.shape[2])
        scores, boxes = loss(logits, sides, grid, torch.from_numpy(batch.targets))
        self._optimiser.zero_grad(set_to_none=True)
        (scores + boxes).backward()
        nn.utils.clip_grad_norm_(self.net.parameters(), self._schedule.clip)
        self._optimiser.step()
        self.step += 1
        self._follow()
        self.seconds += time.monotonic() - began_s
        return float(scores.detach()), float(boxes.detach())

    @torch.no_grad()
    def _follow(self) -> None:
        """Let the average follow: quickly at first, since what it began with means nothing."""
        keep = self._schedule.average * (1 - 2.0 ** (-self.step * 10 / WINDOW))
        for mine, new in zip(
            self.average.state_dict().values(), self.net.state_dict().values(), strict=True
        ):
            if mine.dtype.is_floating_point:
                mine.lerp_(new, 1 - keep)
            else:
                mine.copy_(new)

    def save(self, folder: Path) -> None:
        """Write all that going on takes, whole or not at all."""
        part = folder / f".{CHECKPOINT}.part"
        state = {
            "step": self.step,
            "seconds": self.seconds,
            "run": self._run(),
            "net": self.net.state_dict(),
            "average": self.average.state_dict(),
            "optimiser": self._optimiser.state_dict(),
        }
        torch.save(state, part)
        part.replace(folder / CHECKPOINT)

    def resume(self, folder: Path) -> None:
        """Go on where a checkpoint ends, if there is one.

        Raises:
            ValueError: it belongs to another schedule or another number of frames.
        """
        path = folder / CHECKPOINT
        if not path.exists():
            return
        state = torch.load(path, map_location="cpu", weights_only=True)
        if state["run"] != self._run():
            raise ValueError(f"{path} is of another run ({state['run']}); name another --out")
        self.net.load_state_dict(state["net"])
        self.average.load_state_dict(state["average"])
        self._optimiser.load_state_dict(state["optimiser"])
        self.step, self.seconds = state["step"], state["seconds"]

    def _run(self) -> dict[str, Any]:
        return {**asdict(self._schedule), "steps": self._feeder.steps}


def _optimiser(net: nn.Module, schedule: Schedule) -> torch.optim.Optimizer:
    """Return AdamW; only what multiplies decays, norms and biases don't."""
    parameters = [p for p in net.parameters() if p.requires_grad]
    return torch.optim.AdamW(
        [
            {"params": [p for p in parameters if p.ndim > 1], "weight_decay": schedule.decay},
            {"params": [p for p in parameters if p.ndim <= 1], "weight_decay": 0.0},
        ],
        lr=schedule.peak_rate,
    )
