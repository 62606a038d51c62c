"""Decide which box belongs to which remembered thing, and join the two positions. Pure.

A distance counts in standard deviations, after what the thing's own size explains: a bed seen from
its foot and from its side is one bed. Each thing takes one box of a look and each box one thing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from planner.language.color_names import may_be
from planner.language.object_classes import LARGE_M, kind_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.perception.interfaces import MapPoint
    from planner.perception.snapshot import Box, Thing

GATE = 9.0
"""Three standard deviations, squared."""
MOST_APART_M = 1.0
"""Beyond its own size nothing standing is joined, however poor the measurement."""
SMALL_M = 0.25
UNLIKE_SURE, UNLIKE_MAYBE = 2 * GATE, 4.0
"""What another colour adds: a red cup is never a blue one; on a sofa, light may fool."""
NEUTRAL = frozenset({"black", "gray", "white", "brown"})
"""What shadow, glare and the table beneath make of any colour: unlike, but not for sure."""
ALIKE = 1.0
"""What a colour that light may have changed adds."""
OVERLAP, OVERLAP_OTHER, INSIDE = 0.5, 0.85, 0.8
WITHIN = 0.75
"""Of the smaller one's reach: with middles so near, one of two large things is not there."""
DRIFT_MPS = 0.005
"""Nobody watched: how fast a standing thing's place grows unsure, to a quarter of a metre."""
DRIFT_MOST_M = 0.25
WALK_MPS = 1.2
WALK_MOST_M = 1.5
WALK_GAP_S = 5.0
"""Who was out of sight for longer may be somebody else."""
SIGMA_LEAST_M = 0.03
"""Looks from one place share their error: no number of them makes it less."""


@dataclass(frozen=True, slots=True)
class PlacedDetection:
    """Hold one detection with its place on the map."""

    index: int
    """Of the detection in its look."""
    label: str
    score: float
    color: str | None
    box: Box
    spot: MapPoint
    room: str | None = None
    whole: bool = True
    """The picture's edge cuts nothing off it."""


def single(placed: Sequence[PlacedDetection]) -> list[PlacedDetection]:
    """Return the placed, best first, without second boxes on one thing."""
    left: list[PlacedDetection] = []
    for p in sorted(placed, key=_rank):
        if not any(_same_box(kept, p) for kept in left):
            left.append(p)
    return left


def associate(
    things: Sequence[Thing], placed: Sequence[PlacedDetection], now_s: float
) -> tuple[dict[str, PlacedDetection], dict[int, str]]:
    """Return the box of each thing that was seen, and of boxes left over that show one of them."""
    by_label: dict[str, list[Thing]] = {}
    for thing in things:
        by_label.setdefault(thing.label, []).append(thing)
    costs: list[tuple[float, str, int]] = []
    for place, p in enumerate(placed):
        for thing in by_label.get(p.label, ()):
            cost = cost_of(thing, p, now_s)
            if cost is not None:
                costs.append((cost, thing.id, place))
    pairs: dict[str, PlacedDetection] = {}
    taken: set[int] = set()
    for _, thing_id, place in sorted(costs):
        if thing_id not in pairs and place not in taken:
            pairs[thing_id] = placed[place]
            taken.add(place)
    return pairs, _parts(pairs, [p for place, p in enumerate(placed) if place not in taken])


def cost_of(thing: Thing, p: PlacedDetection, now_s: float) -> float | None:
    """Return how unlike a box and a thing are; None where they can't be one."""
    kind = kind_of(p.label)
    unseen_s = max(0.0, now_s - thing.seen_s)
    if kind.mobile and unseen_s > WALK_GAP_S:
        return None
    apart_m = hypot(p.spot.x_m - thing.x_m, p.spot.y_m - thing.y_m)
    excess_m = max(0.0, apart_m - kind.reach_m)
    walked_m = min(WALK_MOST_M, WALK_MPS * unseen_s) if kind.mobile else 0.0
    if not excess_m <= MOST_APART_M + walked_m:
        return None
    spread_m = hypot(_sigma_now_m(thing, now_s), p.spot.sigma_m)
    cost = (excess_m / spread_m) ** 2 + _unlike(thing, p)
    if not cost <= GATE:
        return None
    return cost + 0.5 * (apart_m / (kind.reach_m + spread_m)) ** 2  # the nearer of two alike


def bulky(label: str) -> bool:
    """Tell whether such a thing fills its place on the floor."""
    kind = kind_of(label)
    return kind.reach_m >= LARGE_M and not (kind.perched or kind.mobile)


def one_place(a: Thing, b: Thing) -> bool:
    """Tell whether two bulky things, of two classes, would stand in each other."""
    least_m = min(kind_of(a.label).reach_m, kind_of(b.label).reach_m)
    return a.label != b.label and hypot(a.x_m - b.x_m, a.y_m - b.y_m) <= WITHIN * least_m


def fuse(thing: Thing, spot: MapPoint, now_s: float) -> tuple[float, float, float, float]:
    """Return x, y, z and sigma [m] of a thing's place and one more measurement of it.

    The mean weighted by the inverse variances, which is what a Kalman filter does for a thing that
    stands still.
    """
    before2, new2 = _sigma_now_m(thing, now_s) ** 2, spot.sigma_m**2
    share = before2 / (before2 + new2)
    sigma_m = max(SIGMA_LEAST_M, (before2 * new2 / (before2 + new2)) ** 0.5)
    return (
        thing.x_m + share * (spot.x_m - thing.x_m),
        thing.y_m + share * (spot.y_m - thing.y_m),
        thing.z_m + share * (spot.z_m - thing.z_m),
        sigma_m,
    )


def _sigma_now_m(thing: Thing, now_s: float) -> float:
    """Return how surely a thing is still where it was seen."""
    unseen_s = max(0.0, now_s - thing.seen_s)
    if kind_of(thing.label).mobile:
        return hypot(thing.sigma_m, min(WALK_MOST_M, WALK_MPS * unseen_s))
    return hypot(thing.sigma_m, min(DRIFT_MOST_M, DRIFT_MPS * unseen_s))


def _unlike(thing: Thing, p: PlacedDetection) -> float:
    """Return the colours' part of the cost."""
    kind = kind_of(p.label)
    if kind.mobile or thing.color is None or p.color is None or thing.color == p.color:
        return 0.0
    if may_be(thing.color, p.color):
        return ALIKE
    doubtful = kind.reach_m >= SMALL_M or NEUTRAL & {thing.color, p.color}
    return UNLIKE_MAYBE if doubtful else UNLIKE_SURE


def _parts(pairs: dict[str, PlacedDetection], left: Sequence[PlacedDetection]) -> dict[int, str]:
    """Return the boxes that show another part of a large thing which has its box already."""
    parts: dict[int, str] = {}
    for p in left:
        reach_m = kind_of(p.label).reach_m
        if reach_m < LARGE_M:
            continue
        for thing_id, first in pairs.items():
            apart_m = hypot(p.spot.x_m - first.spot.x_m, p.spot.y_m - first.spot.y_m)
            if first.label == p.label and apart_m <= 0.7 * reach_m:
                parts[p.index] = thing_id
                break
    return parts


def _same_box(better: PlacedDetection, p: PlacedDetection) -> bool:
    """Tell whether two boxes show one thing: they overlap, and lie at one depth."""
    shared = _area((max(better.box[0], p.box[0]), max(better.box[1], p.box[1]),
                    min(better.box[2], p.box[2]), min(better.box[3], p.box[3])))  # fmt: skip
    a, b = _area(better.box), _area(p.box)
    if not shared > 0.0:
        return False
    overlap = shared / (a + b - shared)
    if better.label != p.label:
        return overlap >= OVERLAP_OTHER
    apart_m = hypot(p.spot.x_m - better.spot.x_m, p.spot.y_m - better.spot.y_m)
    one_place = apart_m <= max(kind_of(p.label).reach_m, 0.3)
    return one_place and (overlap >= OVERLAP or shared / min(a, b) >= INSIDE)


def _area(box: Box) -> float:
    return max(0.0, box[2] - box[0]) * max(0.0, box[3] - box[1])


def _rank(p: PlacedDetection) -> tuple[object, ...]:
    spot = p.spot
    return (-p.score, p.label, p.box, spot.sigma_m, spot.x_m, spot.y_m, spot.z_m, p.color or "")
