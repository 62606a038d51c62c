"""Find free floor at a side of what a place faces, or of a thing: before, beside or behind it.

A place's pose is where one stands to be at it, and looks at it: what stands on the map in that
direction is its body. Law: every spot is one at which a robot may stand by the map and the fence,
within ``REACH_M`` of where it was asked for; where there is none, none is returned. The route
search has the last word, as for every drive. Pure.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, sin

from maps.grid import FREE
from planner.plan import Side
from planner.site.site import Site
from wire.geometry import Pose2

FACE_M = 1.5
"""What a place faces stands no farther off."""
BODY_M = 3.0
"""Longer or deeper than this nothing is walked round."""
REACH_M = 0.25
"""A spot may lie so far from where it was asked for."""
SPACE_M = 0.025
"""Kept free about a robot that stands, besides its own radius, to the nearest edge of a cell."""
USUAL_M = 0.3
"""Between robot and thing, where nobody says how far."""
_STEP_M = 0.05
MOST_SPOTS = 2
DOORWAY_M = 1.0
"""Wide is what a place in a wall without ends is taken for: a door that is shut."""
THING_M = 0.15
"""From a thing's middle to its side, where no map shows it."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class StandingSpot:
    """Hold where to stand, facing it, and the point of the thing that the distance counts from."""

    pose: Pose2
    face: Point


@dataclass(frozen=True, slots=True)
class StandingFloor:
    """Answer where a robot of a radius may stand on a site."""

    site: Site
    radius_m: float

    def face_of(self, anchor: Pose2) -> Point:
        """Return where the body that a pose looks at begins; of none, just before the robot."""
        along = (cos(anchor.yaw_rad), sin(anchor.yaw_rad))
        at_m = self._walk((anchor.x_m, anchor.y_m), along, FACE_M, free=True)
        return _ahead((anchor.x_m, anchor.y_m), along, self.radius_m if at_m is None else at_m)

    def spots(self, anchor: Pose2, side: Side, gap_m: float | None) -> tuple[StandingSpot, ...]:
        """Return where to stand at a side of what a place's pose looks at, the best first.

        Args:
            anchor: the place's pose.
            side: which side, as seen from there.
            gap_m: between robot and body.
        """
        along = (cos(anchor.yaw_rad), sin(anchor.yaw_rad))
        face = self.face_of(anchor)
        off_m = self.radius_m + (USUAL_M if gap_m is None else gap_m)
        if side == "before":
            wanted = [(_ahead(face, along, -off_m), face)]
        elif side == "behind":
            deep_m = self._walk(face, along, BODY_M, free=False)
            back = _ahead(face, along, deep_m) if deep_m is not None else None
            wanted = [(_ahead(back, along, off_m), back)] if back is not None else []
        else:
            return self._free(self._spots_at_ends(face, along, off_m)) or self._free(
                self._spots_at_wall(face, along, off_m)
            )
        return self._free(wanted)

    def about(
        self, thing: Point, seen_from: Pose2, side: Side, gap_m: float | None
    ) -> tuple[StandingSpot, ...]:
        """Return where to stand at a side of a thing that no map shows, as seen from the robot."""
        to = (thing[0] - seen_from.x_m, thing[1] - seen_from.y_m)
        far_m = hypot(*to)
        along = (to[0] / far_m, to[1] / far_m) if far_m > 0.0 else (1.0, 0.0)
        off_m = THING_M + self.radius_m + (USUAL_M if gap_m is None else gap_m)
        ways = {
            "before": [(-along[0], -along[1])],
            "behind": [along],
        }.get(side, [_turn_left(along), _turn_right(along)])
        return self._free([(_ahead(thing, way, off_m), thing) for way in ways])

    def _spots_at_ends(
        self, face: Point, along: Point, off_m: float
    ) -> Iterator[tuple[Point, Point]]:
        """Yield spots next to both ends of a body, each first where its middle may be."""
        inside = _ahead(face, along, 2 * _STEP_M)
        for depth_m in (0.3, 0.1, -0.1, -self.radius_m):
            for way in (_turn_left(along), _turn_right(along)):
                wide_m = self._walk(inside, way, BODY_M, free=False)
                if wide_m is not None:
                    edge = _ahead(face, way, wide_m)
                    yield _ahead(_ahead(edge, way, off_m), along, depth_m), edge

    def _spots_at_wall(
        self, face: Point, along: Point, off_m: float
    ) -> Iterator[tuple[Point, Point]]:
        """Yield spots before a wall at both sides of a shut door in it; of a body with ends, none.

        The map shows a shut door as wall, so its width is taken to be ``DOORWAY_M``.
        """
        ways = (_turn_left(along), _turn_right(along))
        inside = _ahead(face, along, 2 * _STEP_M)
        if any(self._walk(inside, way, BODY_M, free=False) is not None for way in ways):
            return
        for way in ways:
            beside = _ahead(face, way, DOORWAY_M / 2.0 + off_m)
            yield _ahead(beside, along, -off_m), _ahead(face, way, DOORWAY_M / 2.0)

    def _walk(self, start: Point, way: Point, most_m: float, *, free: bool) -> float | None:
        """Return how far one walks until floor is no more free, or free again; None: too far."""
        for number in range(int(most_m / _STEP_M) + 1):
            at = _ahead(start, way, number * _STEP_M)
            if (self.site.grid.at(*at) == FREE) is not free:
                return number * _STEP_M
        return None

    def _free(self, wanted: Iterable[tuple[Point, Point]]) -> tuple[StandingSpot, ...]:
        spots: list[StandingSpot] = []
        for at, face in wanted:
            if len(spots) == MOST_SPOTS:
                break
            stand = next(filter(self.is_free, _around(at)), None)
            if stand is not None:
                yaw_rad = _bearing(stand, face)
                spots.append(StandingSpot(Pose2(stand[0], stand[1], yaw_rad), face))
        return tuple(spots)

    def is_free(self, at: Point) -> bool:
        """Tell whether a robot may stand there, by the map and the fence."""
        grid, far_m = self.site.grid, self.radius_m + SPACE_M
        reach, half_m = int(far_m / grid.resolution_m) + 1, grid.resolution_m / 2.0
        if grid.at(*at) != FREE or not self.site.fence.allows(*at):
            return False
        column, row = grid.cell_of(*at)
        centres = (
            grid.centre_of(column + dx, row + dy)
            for dy in range(-reach, reach + 1)
            for dx in range(-reach, reach + 1)
        )
        return all(
            grid.at(*centre) == FREE
            for centre in centres
            if hypot(*(max(0.0, abs(c - a) - half_m) for c, a in zip(centre, at, strict=True)))
            <= far_m
        )


def _around(at: Point) -> list[Point]:
    """Return the points about one, the nearest first."""
    count = int(REACH_M / _STEP_M)
    offsets = [
        (column * _STEP_M, row * _STEP_M)
        for row in range(-count, count + 1)
        for column in range(-count, count + 1)
    ]
    near = sorted((o for o in offsets if hypot(*o) <= REACH_M), key=lambda o: hypot(*o))
    return [(at[0] + dx, at[1] + dy) for dx, dy in near]


def _ahead(at: Point, way: Point, far_m: float) -> Point:
    return at[0] + far_m * way[0], at[1] + far_m * way[1]


def _turn_left(way: Point) -> Point:
    return -way[1], way[0]


def _turn_right(way: Point) -> Point:
    return way[1], -way[0]


def _bearing(start: Point, end: Point) -> float:
    return atan2(end[1] - start[1], end[0] - start[0])
