"""Keep frames on disk: shards of JPEGs, as the camera sends them, with what is in each.

A shard is one ``.npz``, written whole or not at all, so that an interrupted run goes on where it
stopped. A folder holds the frames of one recipe; another recipe's are refused, not mixed in.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

RECIPE = "recipe.json"


class NoFrames(ValueError):
    """A folder that should hold frames holds none."""


class OtherRecipe(Exception):
    """The folder holds frames that were drawn in another way."""


@dataclass(frozen=True, slots=True)
class StoredFrame:
    """Hold one frame."""

    jpeg: bytes
    things: NDArray[np.float32]
    """(M, 6): class, left, top, right, bottom [px], 1 asked for or -1 not judged."""


def claim(folder: Path, recipe: Mapping[str, Any]) -> None:
    """Make a folder this recipe's.

    Raises:
        OtherRecipe: it is another's already.
    """
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / RECIPE
    text = json.dumps(recipe, indent=1, sort_keys=True)
    if path.exists() and path.read_text("utf-8") != text:
        raise OtherRecipe(f"{folder} holds frames of another recipe; remove it or name another")
    path.write_text(text, "utf-8")


def shard_path(folder: Path, index: int) -> Path:
    """Return where a shard lies."""
    return folder / f"shard_{index:05d}.npz"


def missing(folder: Path, count: int) -> list[int]:
    """Return which of the first shards are not there yet."""
    return [index for index in range(count) if not shard_path(folder, index).exists()]


def write(folder: Path, index: int, frames: Sequence[StoredFrame]) -> None:
    """Write a shard whole, or leave nothing of it."""
    ends = np.cumsum([len(frame.jpeg) for frame in frames], dtype=np.int64)
    whose = [np.full((len(frame.things), 1), i, np.float32) for i, frame in enumerate(frames)]
    rows = [np.hstack([at, f.things]) for at, f in zip(whose, frames, strict=True)]
    part = folder / f".shard_{index:05d}.part"
    with part.open("wb") as file:
        np.savez(
            file,
            jpeg=np.frombuffer(b"".join(frame.jpeg for frame in frames), np.uint8),
            ends=ends,
            things=np.vstack([*rows, np.zeros((0, 7), np.float32)]).astype(np.float32),
        )
    part.replace(shard_path(folder, index))


def read(path: Path) -> list[StoredFrame]:
    """Read a shard."""
    with np.load(path) as shard:
        jpeg, ends, rows = shard["jpeg"].tobytes(), shard["ends"].tolist(), shard["things"]
    begins = [0, *ends[:-1]]
    return [
        StoredFrame(jpeg[begin:end], rows[rows[:, 0] == i][:, 1:].copy())
        for i, (begin, end) in enumerate(zip(begins, ends, strict=True))
    ]


def read_all(folder: Path) -> list[StoredFrame]:
    """Read every shard of a folder, in order; 20 000 frames take some 200 MB.

    Raises:
        NoFrames: there is none.
    """
    frames = [frame for path in sorted(folder.glob("shard_*.npz")) for frame in read(path)]
    if not frames:
        raise NoFrames(f"{folder} holds no frames; draw some with python -m tools.train.frames")
    return frames
