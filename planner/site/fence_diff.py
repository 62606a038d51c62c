"""Compare a fence with another: square metres gained and lost, and in which rooms.

Cuts both into horizontal strips; along a strip's middle line the spans are exact. Knows outlines
and rooms; no files, no robot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from maps.yaml_records import SiteRecord

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from planner.site.places import Place
    from planner.site.polygon import Polygon
    from wire import FenceFile

STRIPS = 600
LEAST_M2 = 0.01
"""Less in a room is a strip's rounding and is not told."""

Span = tuple[float, float]


class RoomChange(SiteRecord):
    """Give the areas that become allowed and forbidden in one room."""

    room: str
    added_m2: float
    removed_m2: float


class FenceDiff(SiteRecord):
    """Give the areas that become allowed and forbidden for the robot's centre."""

    added_m2: float
    removed_m2: float
    allowed_m2: float
    """After the change."""
    rooms: tuple[RoomChange, ...]
    zones_before: int
    zones_after: int


def fence_diff(before: FenceFile, after: FenceFile, rooms: Sequence[Place]) -> FenceDiff:
    """Compare two fences of one map."""
    names = [(room.id, room.polygon) for room in rooms if room.polygon is not None]
    outlines = (*before.allowed, *after.allowed)
    low = min(y for outline in outlines for _, y in outline)
    high = max(y for outline in outlines for _, y in outline)
    strip_m = (high - low) / STRIPS
    added = removed = allowed = 0.0
    of_room: dict[str, list[float]] = {name: [0.0, 0.0] for name, _ in names}
    for index in range(STRIPS):
        y_m = low + (index + 0.5) * strip_m
        was, now = _free(before, y_m), _free(after, y_m)
        gained, lost = _subtract(now, was), _subtract(was, now)
        allowed += strip_m * _length(now)
        added += strip_m * _length(gained)
        removed += strip_m * _length(lost)
        if gained or lost:
            for name, polygon in names:
                within = _spans(polygon, y_m)
                of_room[name][0] += strip_m * _length(_common(gained, within))
                of_room[name][1] += strip_m * _length(_common(lost, within))
    return FenceDiff(
        added_m2=round(added, 3),
        removed_m2=round(removed, 3),
        allowed_m2=round(allowed, 3),
        rooms=tuple(
            RoomChange(room=name, added_m2=round(more, 3), removed_m2=round(less, 3))
            for name, (more, less) in of_room.items()
            if more >= LEAST_M2 or less >= LEAST_M2
        ),
        zones_before=len(before.speed_zones),
        zones_after=len(after.speed_zones),
    )


def _free(fence: FenceFile, y_m: float) -> list[Span]:
    """Return where along a line the robot's centre may be."""
    inside = _merge(span for outline in fence.allowed for span in _spans(outline, y_m))
    holes = _merge(span for outline in fence.keep_outs for span in _spans(outline, y_m))
    return _subtract(inside, holes)


def _spans(outline: Polygon, y_m: float) -> list[Span]:
    """Return where along a line an outline is inside, by the even-odd rule."""
    cuts = sorted(_cuts(outline, y_m))
    return list(zip(cuts[::2], cuts[1::2], strict=True))


def _cuts(outline: Polygon, y_m: float) -> Iterator[float]:
    xa, ya = outline[-1]
    for xb, yb in outline:
        if (ya > y_m) != (yb > y_m):
            yield xa + (y_m - ya) * (xb - xa) / (yb - ya)
        xa, ya = xb, yb


def _merge(spans: Iterable[Span]) -> list[Span]:
    merged: list[Span] = []
    for begin, end in sorted(spans):
        if merged and begin <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(merged[-1][1], end))
        else:
            merged.append((begin, end))
    return merged


def _subtract(spans: list[Span], holes: list[Span]) -> list[Span]:
    left: list[Span] = []
    for begin, end in spans:
        at = begin
        for hole_begin, hole_end in holes:
            if hole_end <= at or hole_begin >= end:
                continue
            if hole_begin > at:
                left.append((at, hole_begin))
            at = max(at, hole_end)
        if at < end:
            left.append((at, end))
    return left


def _common(a: list[Span], b: list[Span]) -> list[Span]:
    return _subtract(a, _subtract(a, b))


def _length(spans: list[Span]) -> float:
    return sum(end - begin for begin, end in spans)
