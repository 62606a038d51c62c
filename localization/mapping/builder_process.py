"""Run the process that builds a growing map: ``localization.mapping.builder_process FOLDER LIDAR``.

Started by :class:`localization.mapping.builder_client.BuilderClient` alone. It keeps the map in the
folder: ``keyframes.npz``, from which another day goes on and a site is made, and ``growing.map``
for planner and page. A killed builder goes on from there, and is told again what it lacks.
"""

from __future__ import annotations

import json
import os
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch
from localization.mapping.keyframes import KEYFRAMES_FILE, Keyframe
from localization.mapping.map_builder import MapBuilder
from localization.mapping.scan_tracker import KeyframeLink
from maps.growing_map import GrowingMap, write_growing_map
from processes.worker_main import ParentPipes, run_worker
from processes.worker_protocol import WorkerFailure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from processes.worker_protocol import Frame

    Floats = NDArray[np.float64]


class BuilderFailure(WorkerFailure):
    """Why the builder gave no answer."""

    reasons = {  # noqa: RUF012  # ClassVar in its base
        "map_builder_unavailable": ("the map builder does not run", "建图进程没有运行"),
        "map_builder_died": ("the map builder ended during its work", "建图进程在工作中退出"),
        "map_builder_timed_out": ("the map builder took too long", "建图超时"),
        "map_unwritable": ("the growing map can't be written", "无法写入正在绘制的地图"),
    }


def main(parent: ParentPipes, folder: str, lidar: str) -> int:
    """Load what another day left, say ready, and answer until the input ends."""
    place, lidar_m = Path(folder), tuple(json.loads(lidar))
    try:
        builder = load_builder(place, lidar_m)
    except ValueError as error:
        return parent.refuse("map_builder_unavailable", f"{place / KEYFRAMES_FILE}: {error}")
    parent.write({"ready": len(builder.keyframes)})
    return parent.serve(partial(answer, builder, place, lidar_m))


def load_builder(folder: Path, lidar_m: tuple[float, float]) -> MapBuilder:
    """Return the builder of what a folder holds; an empty one where it holds nothing.

    Raises:
        ValueError: what it holds is not whole, or not ours.
    """
    path = folder / KEYFRAMES_FILE
    if not path.is_file():
        return MapBuilder(lidar_m)
    return MapBuilder.of_bytes(path.read_bytes(), lidar_m)


def answer(builder: MapBuilder, folder: Path, lidar_m: tuple[float, float], asked: Frame) -> Frame:
    """Take a keyframe, save all, or find the pose from which a scan was taken."""
    head, body = asked
    if "find" in head:
        return _find(builder, lidar_m, np.frombuffer(body, np.float64).reshape(-1, 2))
    moved = False
    if "index" in head and int(head["index"]) == len(builder.keyframes):
        moved = builder.add(_link(head, np.frombuffer(body, np.float64).reshape(-1, 2)))
    if "save" in head:
        try:
            save(builder, folder)
        except OSError as error:
            raise BuilderFailure("map_unwritable", f"{folder}: {error.strerror}") from error
    told = {"have": len(builder.keyframes), "loops": builder.loops, "moved": moved}
    return told, builder.poses.tobytes() if moved else b""


def save(builder: MapBuilder, folder: Path) -> None:
    """Write keyframes and growing map, each whole.

    Raises:
        OSError: the folder can't be written.
    """
    if not builder.keyframes:
        return
    beside = folder / f".{KEYFRAMES_FILE}.new"
    beside.write_bytes(builder.to_bytes())
    os.replace(beside, folder / KEYFRAMES_FILE)  # noqa: PTH105  # atomic, also over a reader
    count = len(builder.keyframes)
    revision = count + builder.loops
    write_growing_map(folder, GrowingMap(revision, count, builder.loops, builder.draw()))


def _find(builder: MapBuilder, lidar_m: tuple[float, float], points_m: Floats) -> Frame:
    field = DistanceField.of_map(builder.draw())
    found = GlobalSearch(field).everywhere(points_m, lidar_m)
    return {"candidates": [[*one.pose, one.score] for one in found]}, b""


def _link(head: dict[str, object], points_m: Floats) -> KeyframeLink:
    pose, relation = (
        None if head[name] is None else np.array(head[name], np.float64)
        for name in ("pose", "relation")
    )
    if pose is None:
        raise ValueError("a keyframe without a pose")
    keyframe = Keyframe(pose, np.array(points_m), float(str(head["stamp_s"])))
    sigmas = (float(str(head["sigma_m"])), float(str(head["sigma_rad"])))
    return KeyframeLink(keyframe, relation, *sigmas)


if __name__ == "__main__":
    run_worker(main)
