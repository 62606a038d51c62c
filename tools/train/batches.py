"""Make batches: which frames, in which order, changed how. The same step gives the same batch.

Knows numpy only, so that what is fed is tested without what learns.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from tools.train.augment import WHOLE, augment
from tools.train.budget import SMALL_PX

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from tools.train.budget import Schedule
    from tools.train.store import StoredFrame

WARM_SHARE = 0.25
"""A short run warms up for no more than this share of its steps."""
LAST_RATE = 0.02


@dataclass(frozen=True, slots=True)
class Batch:
    """Hold pictures (B, height, width, 3), RGB from 0 to 1, and their things (B, M, 6), padded."""

    pictures: NDArray[np.float32]
    targets: NDArray[np.float32]


class Feeder:
    """Give the batch of any step."""

    def __init__(self, frames: Sequence[StoredFrame], schedule: Schedule) -> None:
        if len(frames) < schedule.batch:
            raise ValueError(f"{len(frames)} frames do not fill a batch of {schedule.batch}")
        self._frames = frames
        self._schedule = schedule
        self.steps_an_epoch = len(frames) // schedule.batch
        self.steps = self.steps_an_epoch * schedule.epochs

    def batch(self, step: int) -> Batch:
        """Return what is learnt from at a step."""
        epoch, at = divmod(step, self.steps_an_epoch)
        seed, size = self._schedule.seed, self._schedule.batch
        order = np.random.default_rng([seed, epoch]).permutation(len(self._frames))
        done = step / self.steps
        plain = self.is_plain(step)
        wide, high = SMALL_PX if done < self._schedule.small_share else WHOLE
        seen = []
        for index in order[at * size : (at + 1) * size]:
            random = np.random.default_rng([seed, epoch, int(index), 1])
            seen.append(augment(self._frames[index], random, (wide, high), plain=plain))
        pictures = np.empty((size, high, wide, 3), np.float32)
        for i, (picture, _) in enumerate(seen):
            np.multiply(picture, np.float32(1 / 255), out=pictures[i])
        return Batch(pictures, pad([things for _, things in seen]))

    def is_plain(self, step: int) -> bool:
        """Say whether a step is one of the last, which see frames as they were drawn."""
        return step / self.steps >= 1 - self._schedule.plain_share

    def rate(self, step: int) -> float:
        """Return the learning rate of a step: a ramp, then a cosine."""
        schedule = self._schedule
        warm = min(schedule.warm_steps, max(1, int(WARM_SHARE * self.steps)))
        if step < warm:
            return schedule.peak_rate * (step + 1) / warm
        done = (step - warm) / max(1, self.steps - warm)
        share = LAST_RATE + (1 - LAST_RATE) * (1 + np.cos(np.pi * done)) / 2
        return float(schedule.peak_rate * share)


def pad(things: Sequence[NDArray[np.float32]]) -> NDArray[np.float32]:
    """Return the things of some pictures (B, M, 6) with rows of zeros where one holds fewer."""
    most = max(1, *(len(rows) for rows in things))
    out = np.zeros((len(things), most, 6), np.float32)
    for i, rows in enumerate(things):
        out[i, : len(rows)] = rows
    return out
