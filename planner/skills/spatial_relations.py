"""Judge whether a thing stands to its neighbour as it is told. Pure.

"the bottle on the table", "椅子旁边的箱子": both must be kinds that the eyes know, and they must be
sure of the neighbour. Positions are middles; on and under reach as far as such a neighbour
does and both positions' deviations; what is on it is higher than half of it, what is under it not.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.object_classes import kind_of
from planner.language.questions import Relation
from planner.plan import Bilingual

if TYPE_CHECKING:
    from planner.perception.snapshot import Thing

NEAR_M = 1.0
"""Beyond the half depth of the neighbour: a metre from its side."""
UNSURE_M = 0.2
"""Two places less sure than this together, or than the neighbour is large, tell nothing."""
FURNITURE_M = 0.3
"""What reaches so far stands on the floor, but for a screen and who walks."""
SUPPOSED_M = 0.4
"""What may stand on a table is put on the floor where there is no depth, and is so unsure."""
LOW_M = 0.25
"""A middle so low lies on the floor, however flat its kind is."""


def stands(thing: Thing, relation: Relation, by: Thing) -> bool:
    """Tell whether a thing stands so to its neighbour, as far as is known of both."""
    if thing.id == by.id:
        return False
    kind, apart_m = kind_of(by.label), hypot(thing.x_m - by.x_m, thing.y_m - by.y_m)
    if relation is Relation.NEAR:
        return apart_m <= NEAR_M + kind.behind_m
    over = thing.z_m > kind.height_m / 2
    inside = apart_m <= kind.reach_m + hypot(thing.sigma_m, by.sigma_m)
    return inside and over == (relation is Relation.ON)


def judge_relation(thing: Thing, relation: Relation, by: Thing) -> bool | None:
    """Tell whether a thing stands so; None where that is not known well enough to say no or yes."""
    kind, reach_m = kind_of(thing.label), kind_of(by.label).reach_m
    large = kind.reach_m >= FURNITURE_M and not (kind.perched or kind.mobile)
    if large and relation is Relation.ON:  # a chair at a table is as high as what lies on that
        return False
    spread_m = hypot(thing.sigma_m, by.sigma_m)
    enough_m = NEAR_M / 2 if relation is Relation.NEAR else max(reach_m, UNSURE_M)
    far = hypot(thing.x_m - by.x_m, thing.y_m - by.y_m) > reach_m + NEAR_M + 2.0 * spread_m
    return stands(thing, relation, by) if far or spread_m <= enough_m else None


def on_floor(thing: Thing) -> bool | None:
    """Tell whether a thing lies on the floor; None where its height is only supposed."""
    kind = kind_of(thing.label)
    if kind.perched and not thing.sigma_m <= SUPPOSED_M:
        return None
    return thing.z_m <= max(kind.height_m, LOW_M)


def support_of(thing: Thing, things: tuple[Thing, ...]) -> str | None:
    """Return the class of what a thing stands on, the nearest; None where that is not known.

    Only furniture is stood on. A person is told by the room: two looks at one person lie close.
    """
    if thing.label == "person":
        return None
    on = [by for by in things if judge_relation(thing, Relation.ON, by) is True]
    nearest = min(on, key=lambda by: hypot(thing.x_m - by.x_m, thing.y_m - by.y_m), default=None)
    large = nearest is not None and kind_of(nearest.label).reach_m >= FURNITURE_M
    return nearest.label if nearest is not None and large else None


def name_related(what: Bilingual, relation: Relation, by: Bilingual) -> Bilingual:
    """Return a thing's name with its neighbour's: ``cup on the table``, ``桌子上的杯子``."""
    return say(f"related.{relation.value}", what=what, by=by)
