"""Place a drive's keyframes on a map that stands, though part of that map is wrong by now.

The chain of the drive says how keyframes lie to each other; where a scan agrees with the map, it is
anchored there. Anchors are loops to a node that is the map itself, so that the graph's kernel holds
off those that moved furniture pulled aside, and a room where nothing fits any more hangs on the
chain between the anchors before and after it. The map's frame never moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from localization.correlative_search import WindowSearch
from localization.global_search import GlobalSearch, is_sure
from localization.mapping.keyframes import pose_after, pose_between
from localization.mapping.pose_graph import PoseEdge, PoseGraph
from localization.quality import ENOUGH_SCORE, scores
from localization.scan_matching import align
from maps.errors import BilingualError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from localization.distance_field import DistanceField
    from localization.mapping.keyframes import Keyframe
    from localization.mapping.scan_tracker import KeyframeLink

    Floats = NDArray[np.float64]
    Bools = NDArray[np.bool_]

ENOUGH_SHARE = 0.5
"""Of the keyframes, that agree with the map; below it the drive was through another home."""
STARTS = 3
"""Places tried, where the drive may have begun, before it is given up."""
SEARCHED = 60
"""Keyframes, spread over the drive, from which it is looked for."""
DOUBTED_SCORE = 0.8
BETTER = 0.05
OFF_M, OFF_PER_M, OFF_RAD = 0.15, 0.1, 0.2
"""How far an anchor may lie from where the chain expects it, since the anchor before."""
SIGMA_M, SIGMA_RAD = 0.02, 0.006
LOOSE_M, LOOSE_RAD = 1.0, 0.5
"""The first keyframe hangs on the map by its anchors; this holds the system solvable."""
MOST_ANCHORS = 300
"""A step of the graph takes the cube of their number: 0.1 s here."""
HELD_KEYFRAMES = 12
"""From an anchor, 6 m: farther off the chain may have drifted by half a cell."""


class DriveElsewhere(BilingualError):
    """Report a drive that is nowhere on the map."""


@dataclass(frozen=True, slots=True)
class AnchoredDrive:
    """Hold a drive's keyframes in the frame of a map that was there before it."""

    keyframes: tuple[Keyframe, ...]
    """Those that the map holds, in the order of their making."""
    dropped: int
    """Keyframes too far from any place that agrees with the map."""
    share: float
    """Of all keyframes, that agree with the map."""


@dataclass(frozen=True, slots=True)
class _PlacedChain:
    """Hold where keyframes are by chain and map, and which of them the map anchors."""

    poses: Floats
    agree: Bools
    anchored: Bools


def place_on_map(
    links: Sequence[KeyframeLink], field: DistanceField, lidar_m: tuple[float, float]
) -> AnchoredDrive:
    """Return a drive's keyframes where they are in a map's frame.

    Args:
        links: the chain of keyframes, in any frame.
        field: of the map.
        lidar_m: where the lidar is in ``base``.

    Raises:
        DriveElsewhere: no keyframe is found for sure, or too few then agree with the map.
    """
    best: _PlacedChain | None = None
    for index, pose in _find_starts(links, field, lidar_m):
        walk = _walk(links, field, lidar_m, index, pose)
        if best is None or walk.agree.sum() > best.agree.sum():
            best = walk
        if best.agree.mean() >= ENOUGH_SHARE:
            break
    if best is None:
        text = "none of its scans is found on the map for sure"
        raise DriveElsewhere(text, "没有一次扫描能在地图上确定位置")
    share = float(best.agree.mean())
    if not share >= ENOUGH_SHARE:
        text = f"{share:.0%} of its scans agree with the map, expected half"
        raise DriveElsewhere(text, f"只有 {share:.0%} 的扫描与地图吻合，应有一半")
    poses = _settle(links, best)
    anchors = np.flatnonzero(best.anchored)
    numbers = np.arange(len(links))
    away = np.abs(numbers[:, None] - anchors[None, :]).min(axis=1, initial=len(links))
    held = np.flatnonzero(away <= HELD_KEYFRAMES).tolist()
    kept = tuple(links[number].keyframe.move_to(poses[number]) for number in held)
    return AnchoredDrive(kept, len(links) - len(kept), share)


def _find_starts(
    links: Sequence[KeyframeLink], field: DistanceField, lidar_m: tuple[float, float]
) -> Iterator[tuple[int, Floats]]:
    """Yield keyframes that are found on the whole map for sure, each with its pose."""
    search, found = GlobalSearch(field), 0
    for index in np.unique(np.linspace(0, len(links) - 1, SEARCHED).round()).astype(int).tolist():
        candidates = search.everywhere(links[index].keyframe.points_m, lidar_m)
        if is_sure(candidates):
            yield index, np.array(candidates[0].pose)
            found += 1
            if found == STARTS:
                return


def _walk(
    links: Sequence[KeyframeLink],
    field: DistanceField,
    lidar_m: tuple[float, float],
    start: int,
    pose: Floats,
) -> _PlacedChain:
    """Follow the chain both ways from a keyframe whose pose is known, by map where that agrees."""
    count = len(links)
    walk = _PlacedChain(np.zeros((count, 3)), np.zeros(count, np.bool_), np.zeros(count, np.bool_))
    window = WindowSearch.of_field(field)
    relations = [link.relation if link.relation is not None else np.zeros(3) for link in links]
    for order in (range(start, count), range(start - 1, -1, -1)):
        before, blind_m = pose if order.step > 0 else walk.poses[start], 0.0
        for number in order:
            if number == start:
                step = np.zeros(3)
            elif order.step > 0:
                step = relations[number]
            else:
                step = pose_between(relations[number + 1], np.zeros(3))
            blind_m += float(np.hypot(step[0], step[1]))
            predicted = pose_after(before, step)
            points_m = links[number].keyframe.points_m
            found, score, is_free = _align(field, window, points_m, lidar_m, predicted)
            off = pose_between(predicted, found)
            near = np.hypot(off[0], off[1]) <= OFF_M + OFF_PER_M * blind_m
            if near and abs(off[2]) <= OFF_RAD and score >= ENOUGH_SCORE:
                walk.agree[number], walk.anchored[number] = True, not is_free
                predicted, blind_m = found, 0.0
            walk.poses[number] = before = predicted
    return walk


def _align(
    field: DistanceField,
    window: WindowSearch,
    points_m: Floats,
    lidar_m: tuple[float, float],
    predicted: Floats,
) -> tuple[Floats, float, bool]:
    """Return where a scan fits the map near a pose, its score there, and if an axis is free."""
    # Welsch's loss first: moved furniture in a quarter of the view pulls Cauchy's minimum off.
    tried = [align(field, points_m, predicted[None], redescending=True)]
    rated = [float(scores(field, points_m, lidar_m, tried[0].poses)[0])]
    if not rated[0] >= DOUBTED_SCORE:
        start = window.best(points_m, predicted)
        tried.append(align(field, points_m, start[None]))
        rated.append(float(scores(field, points_m, lidar_m, tried[1].poses)[0]) - BETTER)
    best = int(np.argmax(rated))
    score = rated[best] + (BETTER if best else 0.0)
    return tried[best].poses[0], score, bool(tried[best].free_axis.any())


def _settle(links: Sequence[KeyframeLink], walk: _PlacedChain) -> Floats:
    """Return where chain and anchors agree best, shape (n, 3). Node 0 of the graph is the map."""
    graph = PoseGraph()
    graph.add_first(np.zeros(3))
    graph.add_next(walk.poses[0], LOOSE_M, LOOSE_RAD)
    for number, link in enumerate(links[1:], 1):
        relation = pose_between(walk.poses[number - 1], walk.poses[number])
        graph.add_next(link.relation if link.relation is not None else relation,
                       link.sigma_m, link.sigma_rad)  # fmt: skip
    anchors = np.flatnonzero(walk.anchored)
    chosen = np.unique(np.linspace(0, len(anchors) - 1, MOST_ANCHORS).round().astype(np.int64))
    for number in anchors[chosen].tolist() if len(anchors) else []:
        graph.add_loop(PoseEdge(0, number + 1, walk.poses[number], SIGMA_M, SIGMA_RAD))
    graph.optimize()
    return graph.poses[1:]
