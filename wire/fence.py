"""Define a fence as file and message hold it: outlines in ``map`` for the robot's centre.

A fence crosses processes as text, and the text is what counts: its SHA-256 is what an operator
signs and its first 16 digits are the hash in status. Knows outlines; no map, no robot.
"""

from __future__ import annotations

import hashlib
import json
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field

from wire.base import Record
from wire.bounded_types import Fingerprint
from wire.geometry import Metres

Point = tuple[float, float]
Outline = Annotated[tuple[tuple[Metres, Metres], ...], Field(min_length=3, max_length=1000)]
_Outlines = Annotated[tuple[Outline, ...], Field(max_length=200)]

MIN_AREA_M2 = 1e-6
MAX_TEXT = 24_000
"""Characters of a fence that is sent: with its request it stays under the key's 32 kB."""
MAX_CORNERS = 1_000
"""Of all outlines of a fence that is sent: what a bridge checks in a second while nothing moves."""


class SpeedZone(Record):
    """Bound the speed inside an outline."""

    polygon: Outline
    max_speed_mps: Annotated[float, Field(ge=0.05, le=10.0)]


class FenceFile(Record):
    """Mirror fence.json: inside an allowed outline and inside no keep-out."""

    version: Literal[1]
    map_id: Fingerprint
    allowed: Annotated[_Outlines, Field(min_length=1)]
    keep_outs: _Outlines = ()
    speed_zones: Annotated[tuple[SpeedZone, ...], Field(max_length=200)] = ()

    @property
    def outlines(self) -> tuple[tuple[Point, ...], ...]:
        """Return every outline, those of speed zones last."""
        return (*self.allowed, *self.keep_outs, *(zone.polygon for zone in self.speed_zones))


MIN_MARK_M2 = 0.01
"""A smaller mark is a slip of the finger."""
MAX_MARK_CORNERS = 400
"""Of all marks: what a bridge takes up while it drives."""
MAX_MARKS_TEXT = 12_000
_Drawn = Annotated[tuple[tuple[Metres, Metres], ...], Field(min_length=3, max_length=100)]


class SlowMark(Record):
    """Bound the speed inside an outline that a person drew."""

    polygon: _Drawn
    max_speed_mps: Annotated[float, Field(ge=0.05, le=10.0)]


class MarksFile(Record):
    """Hold what people drew on the map: where to stay out and where to go slowly.

    Marks only take away from the fence: they come into force while the robot drives, and deleted
    they give back what the fence allows and no more.
    """

    version: Literal[1]
    map_id: Fingerprint
    keep_outs: Annotated[tuple[_Drawn, ...], Field(max_length=50)] = ()
    speed_zones: Annotated[tuple[SlowMark, ...], Field(max_length=50)] = ()

    @property
    def outlines(self) -> tuple[tuple[Point, ...], ...]:
        """Return every outline, those of speed zones last."""
        return (*self.keep_outs, *(zone.polygon for zone in self.speed_zones))


def fence_text(fence: FenceFile | MarksFile) -> str:
    """Return the text by which a proposal or marks are reviewed, signed and written."""
    return json.dumps(fence.model_dump(mode="json"), separators=(",", ":")) + "\n"


def text_sha256(text: str) -> str:
    """Return the SHA-256 of a fence's text, which an operator signs."""
    return hashlib.sha256(text.encode()).hexdigest()


def marks_flaw(marks: MarksFile) -> tuple[str, str] | None:
    """Return code and particulars of what is wrong with marks; None where nothing is."""
    corners = sum(len(outline) for outline in marks.outlines)
    if not corners <= MAX_MARK_CORNERS:
        return "marks_too_many", f"{corners} corners in all, at most {MAX_MARK_CORNERS}"
    for outline in marks.outlines:
        crossing = crosses_itself(outline)
        if crossing is not None:
            (ax, ay), (bx, by) = crossing
            text = f"its sides from ({ax}, {ay}) and from ({bx}, {by}) meet"
            return "mark_crosses_itself", f"{text}: {_brief(outline)}"
        if not area_m2(outline) >= MIN_MARK_M2:
            area = f"{area_m2(outline):.4f} m2, at least {MIN_MARK_M2} m2"
            return "mark_too_small", f"{area}: {_brief(outline)}"
    return None


def flaw(fence: FenceFile) -> tuple[str, str] | None:
    """Return code and particulars of an outline's flaw; None where it has none."""
    for outline in fence.outlines:
        if not area_m2(outline) > MIN_AREA_M2:
            return "fence_degenerate", f"an outline has no area: {_brief(outline)}"
        crossing = crosses_itself(outline)
        if crossing is not None:
            (ax, ay), (bx, by) = crossing
            text = f"its sides from ({ax}, {ay}) and from ({bx}, {by}) meet: {_brief(outline)}"
            return "fence_crosses_itself", f"an outline crosses or touches itself; {text}"
    return None


def _brief(outline: tuple[Point, ...]) -> str:
    more = f" and {len(outline) - 4} more corners" if len(outline) > 4 else ""
    return f"{[list(corner) for corner in outline[:4]]}{more}"


def area_m2(outline: tuple[Point, ...]) -> float:
    """Return an outline's area (shoelace formula), whichever way round it runs."""
    following = outline[1:] + outline[:1]
    doubled = sum(xa * yb - xb * ya for (xa, ya), (xb, yb) in zip(outline, following, strict=True))
    return abs(doubled) / 2


def crosses_itself(outline: tuple[Point, ...]) -> tuple[Point, Point] | None:
    """Return where two sides begin that share a point they should not; None for a simple outline.

    Corners given twice in a row count once. Neighbours share their corner and nothing else.
    """
    corners = [a for a, b in pairwise((*outline, outline[0])) if a != b]
    count = len(corners)
    sides = [(corners[i], corners[(i + 1) % count]) for i in range(count)]
    for i, (a, b) in enumerate(sides):
        for j in range(i + 1, count):
            c, d = sides[j]
            if j == i + 1 or (i == 0 and j == count - 1):
                if _folds(a, b, c, d):
                    return a, c
            elif _share(a, b, c, d):
                return a, c
    return None


def _folds(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return whether neighbouring sides run back over each other."""
    if _side(a, b, c) != 0.0 or _side(a, b, d) != 0.0:
        return False
    return (b[0] - a[0]) * (d[0] - c[0]) + (b[1] - a[1]) * (d[1] - c[1]) < 0.0


def _share(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return whether two segments share a point, ends included."""
    if max(a[0], b[0]) < min(c[0], d[0]) or max(c[0], d[0]) < min(a[0], b[0]):
        return False
    if max(a[1], b[1]) < min(c[1], d[1]) or max(c[1], d[1]) < min(a[1], b[1]):
        return False
    return _side(a, b, c) * _side(a, b, d) <= 0.0 and _side(c, d, a) * _side(c, d, b) <= 0.0


def _side(a: Point, b: Point, p: Point) -> float:
    """Return on which side of a line a point is; 0 on it."""
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
