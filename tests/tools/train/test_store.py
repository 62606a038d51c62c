"""Keep frames and read them back; refuse to mix recipes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tools.train.store import (
    NoFrames,
    OtherRecipe,
    StoredFrame,
    claim,
    missing,
    read,
    read_all,
    shard_path,
    write,
)

ONE = StoredFrame(b"first", np.array([[3, 1, 2, 30, 40, 1], [10, 5, 5, 9, 9, -1]], np.float32))
NONE = StoredFrame(b"", np.zeros((0, 6), np.float32))
TWO = StoredFrame(b"second", np.array([[0, 0, 0, 9, 9, 1]], np.float32))


def test_frames_come_back_as_they_were(tmp_path: Path) -> None:
    write(tmp_path, 0, [ONE, NONE])
    write(tmp_path, 2, [TWO])
    assert [frame.jpeg for frame in read_all(tmp_path)] == [b"first", b"", b"second"]
    for frame, same in zip(read(shard_path(tmp_path, 0)), (ONE, NONE), strict=True):
        assert np.array_equal(frame.things, same.things)
    assert missing(tmp_path, 4) == [1, 3]
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "shard_00000.npz",
        "shard_00002.npz",
    ]


def test_a_folder_holds_one_recipe(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    claim(folder, {"kind": "train", "size": [320, 240]})
    claim(folder, {"size": [320, 240], "kind": "train"})
    with pytest.raises(OtherRecipe, match="another recipe"):
        claim(folder, {"kind": "unseen", "size": [320, 240]})


def test_a_folder_without_frames_is_refused(tmp_path: Path) -> None:
    with pytest.raises(NoFrames, match="holds no frames"):
        read_all(tmp_path / "nowhere")
