"""Draw frames: ``python -m tools.train.frames --kind train --count 20000 --out DIR``.

Two processes draw shard by shard; an interrupted run goes on where it stopped. Runs in the
project's own environment. The same seeds and code give the same pictures.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import signal
import sys
import time
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from sim.camera import Appearance, Renderer, spoil
from sim.camera.scene import instances
from tools.train.boxes import boxes, hulls, whole_box
from tools.train.budget import FRAMES_A_HOME, HEIGHT_PX, HOMES_A_SHARD, WIDTH_PX
from tools.train.homes import Kind, drawn_home
from tools.train.store import OtherRecipe, StoredFrame, claim, missing, write
from tools.train.views import Views, camera

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from sim.site import Home
    from tools.train.boxes import Box, Hull
    from wire import CameraConfig, Pose2

CODE = ("sim/camera", "sim/site", "tools/train/homes.py", "tools/train/furnish.py",
        "tools/train/scatter.py", "tools/train/views.py", "tools/train/boxes.py",
        "tools/train/frames.py")  # fmt: skip
INTERRUPTED = 130


def main(arguments: list[str] | None = None) -> int:
    """Draw what is missing; return 0, 2 when refused, 130 when interrupted."""
    given = _options(arguments)
    try:
        claim(given.out, recipe(given.kind))
    except OtherRecipe as error:
        print(f"tools.train.frames: {error}", file=sys.stderr)
        return 2
    left = missing(given.out, shards(given.kind, given.count))
    began_s = time.monotonic()
    # Two processes of one thread each are quicker than one of two.
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    draw = partial(draw_shard, given.out, given.kind)
    try:
        with get_context("spawn").Pool(given.workers, _begin) as pool:
            for done, index in enumerate(pool.imap_unordered(draw, left), 1):
                _say(index, done, len(left), time.monotonic() - began_s)
    except KeyboardInterrupt:
        print("\ntrain.frames: interrupted; whole shards are kept")
        return INTERRUPTED
    _note(given.out, time.monotonic() - began_s, len(left))
    return 0


def shards(kind: Kind, count: int) -> int:
    """Return how many shards hold so many frames."""
    return -(-count // (FRAMES_A_HOME[kind] * HOMES_A_SHARD))


def recipe(kind: Kind) -> dict[str, Any]:
    """Return what a folder's frames depend on, the code that draws them included."""
    root = Path(__file__).resolve().parents[2]
    digest = hashlib.sha256()
    for name in CODE:
        path = root / name
        for file in sorted(path.glob("*.py")) if path.is_dir() else [path]:
            digest.update(file.read_bytes())
    return {
        "kind": kind,
        "frames_a_home": FRAMES_A_HOME[kind],
        "homes_a_shard": HOMES_A_SHARD,
        "size": [WIDTH_PX, HEIGHT_PX],
        "code": digest.hexdigest(),
    }


def draw_shard(folder: Path, kind: Kind, index: int) -> int:
    """Draw the homes of one shard and write it."""
    frames: list[StoredFrame] = []
    for seed in range(index * HOMES_A_SHARD, (index + 1) * HOMES_A_SHARD):
        frames += home_frames(drawn_home(kind, seed), f"{kind} {seed}", FRAMES_A_HOME[kind])
    write(folder, index, frames)
    return index


def home_frames(home: Home, name: str, count: int) -> list[StoredFrame]:
    """Draw one home, in one light and from one camera, from many places."""
    random = Random(f"frames {name}")
    rng = np.random.default_rng(random.getrandbits(64))
    mounted, look = camera(random), Appearance.random(random.getrandbits(32))
    renderer, views = Renderer(home, mounted, look), Views(home)
    bounds = hulls(instances(home, look))
    frames: list[StoredFrame] = []
    for _ in range(count):
        base_in_map = views.draw_pose(random)
        clean = renderer.render(base_in_map)
        things = boxes(clean.ids, renderer.labels, partial(_whole, bounds, mounted, base_in_map))
        color = spoil(clean, rng, look.noise).color
        frames.append(StoredFrame(_jpeg(color, random.randint(60, 95)), things))
    return frames


def _whole(
    bounds: Mapping[str, Hull], mounted: CameraConfig, base_in_map: Pose2, thing: str
) -> Box | None:
    return whole_box(bounds[thing], mounted, base_in_map)


def _jpeg(color: NDArray[np.uint8], quality: int) -> bytes:
    _, data = cv2.imencode(".jpg", color[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    return data.tobytes()


def _begin() -> None:
    """Leave Ctrl-C to the process that waits."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)


def _say(index: int, done: int, count: int, took_s: float) -> None:
    left_min = (count - done) * took_s / done / 60
    text = f"shard {index}: {done}/{count}, {took_s / done:.1f} s each, {left_min:.1f} min left"
    print(text, end="\x1b[K\r" if sys.stdout.isatty() else "\n", flush=True)


def _note(folder: Path, took_s: float, shards: int) -> None:
    """Add to the seconds that drawing took, for the card."""
    path = folder / "drawn.json"
    before = json.loads(path.read_text("utf-8"))["seconds"] if path.exists() else 0.0
    facts = {"seconds": round(before + took_s, 1), "shards_last": shards}
    path.write_text(json.dumps(facts) + "\n", "utf-8")


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tools.train.frames", description=__doc__)
    parser.add_argument("--kind", choices=("train", "unseen", "bare"), required=True)
    parser.add_argument("--count", type=int, required=True, help="rounded up to whole shards")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--workers", type=int, default=2)
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
