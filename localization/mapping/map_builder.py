"""Keep the keyframes of a growing map in one piece: chain, loops, and the cells they show.

The slow half of mapping, for a process without a rank: told of each keyframe that the tracker
takes, it says where all of them are now. It holds all that a saved map is made from.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from localization.mapping.keyframes import (
    Keyframe,
    pose_between,
    read_keyframes,
    write_keyframes,
)
from localization.mapping.loop_search import LoopSearch
from localization.mapping.occupancy import draw_grid
from localization.mapping.pose_graph import PoseGraph

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.scan_tracker import KeyframeLink
    from maps import GridMap

    Floats = NDArray[np.float64]

AGREES_M, AGREES_RAD = 0.03, 0.01
"""A loop that closes within these changes nothing: it is kept, and poses stay as they are."""
LOOP_EVERY = 4
"""Keyframes between two that loops are looked for from: 2 m. The cost of a step of the graph grows
with the cube of its loops, and neighbours' loops say the same."""
PLACED_SIGMA_M, PLACED_SIGMA_RAD = 0.02, 0.006
"""Of a keyframe that was placed on the map itself."""


class MapBuilder:
    """Hold a map's keyframes and their graph."""

    def __init__(self, lidar_m: tuple[float, float] = (0.0, 0.0)) -> None:
        self._lidar_m = lidar_m
        self._search = LoopSearch(lidar_m)
        self._graph = PoseGraph()
        self._keyframes: list[Keyframe] = []
        self._looped = 0
        """How many keyframes there were when a loop was found last."""

    @property
    def keyframes(self) -> tuple[Keyframe, ...]:
        """Return the keyframes, in the order of their making, where they are now."""
        return tuple(self._keyframes)

    @property
    def poses(self) -> Floats:
        """Return the keyframes' poses in ``map`` as they are now, shape (n, 3)."""
        return self._graph.poses

    @property
    def loops(self) -> int:
        """Return how many loops were found."""
        return self._graph.loops

    def add(self, link: KeyframeLink) -> bool:
        """Take a keyframe; return whether loops moved the poses of others.

        Raises:
            ValueError: a keyframe that is not the first has no relation to the one before it.
        """
        if not self._keyframes:
            self._graph.add_first(link.keyframe.pose)
        elif link.relation is None:
            raise ValueError("a keyframe after the first needs its relation to the last")
        else:
            self._graph.add_next(link.relation, link.sigma_m, link.sigma_rad)
        self._keyframes.append(link.keyframe.move_to(self._graph.poses[-1]))
        if len(self._keyframes) - self._looped < LOOP_EVERY:
            return False
        edges = self._search.find(self._keyframes, self._graph)
        if not edges:
            return False
        self._looped = len(self._keyframes)
        off = np.abs([self._graph.closing_error(edge) for edge in edges])
        for edge in edges:
            self._graph.add_loop(edge)
        if bool((off[:, :2] <= AGREES_M).all() and (off[:, 2] <= AGREES_RAD).all()):
            return False
        self.settle()
        return True

    def append_placed(self, keyframes: Sequence[Keyframe]) -> None:
        """Hang keyframes that lie in this map's frame already on the end of its chain."""
        for keyframe in keyframes:
            last = self._graph.poses[-1] if self._keyframes else None
            if last is None:
                self._graph.add_first(keyframe.pose)
            else:
                relation = pose_between(last, keyframe.pose)
                self._graph.add_next(relation, PLACED_SIGMA_M, PLACED_SIGMA_RAD)
            self._keyframes.append(keyframe)

    def settle(self) -> None:
        """Move all keyframes to where chain and loops agree best."""
        self._graph.optimize()
        placed = zip(self._keyframes, self._graph.poses, strict=True)
        self._keyframes = [keyframe.move_to(pose) for keyframe, pose in placed]

    def draw(self) -> GridMap:
        """Return the map's cells as known now."""
        return draw_grid(self._keyframes, self._lidar_m)

    def to_bytes(self) -> bytes:
        """Return all of it as a file, from which a later day goes on."""
        return write_keyframes(self._keyframes, self._graph.table())

    @classmethod
    def of_bytes(cls, data: bytes, lidar_m: tuple[float, float]) -> MapBuilder:
        """Return what a file holds.

        Raises:
            ValueError: it is not whole, or not ours.
        """
        keyframes, edges = read_keyframes(data)
        builder = cls(lidar_m)
        builder._keyframes = list(keyframes)
        poses = np.array([keyframe.pose for keyframe in keyframes]).reshape(-1, 3)
        builder._graph = PoseGraph.of_table(poses, edges)
        return builder
