"""Read which neighbour a thing is told by, and judge whether it stands so. Pure.

"the bottle on the table", "椅子旁边的箱子": both must be kinds that the eyes know, and they must be
sure of the neighbour. Positions are middles; on and under reach as far as such a neighbour
does and both positions' deviations; what is on it is higher than half of it, what is under it not.
"""

from __future__ import annotations

import re
from enum import StrEnum
from math import hypot
from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.folding import fold_words
from planner.language.object_classes import kind_of
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
_EN = re.compile(
    r"(?P<what>.+?) (?:(?P<on>on(?: top of)?)|(?P<under>under(?:neath)?|below|beneath)"
    r"|(?P<near>near|next to|beside|close to|by)) (?P<by>.+)"
)
_ZH = re.compile(
    r"(?P<by>.+?)(?:(?P<on>上面?|上边)|(?P<under>下面?|下边|底下)|(?P<near>旁边?|边上|附近))的(?P<what>.+)"
)


_SEVERAL = re.compile(r"\b(?:all|every|each|any|both|two|three|\d+)\b|所有|全部|每|各|几|两|三")


class Relation(StrEnum):
    """How a thing stands to its neighbour."""

    ON = "on"
    UNDER = "under"
    NEAR = "near"


def parted(words: str) -> tuple[str, Relation, str] | None:
    """Return the thing's words, how it stands, and its neighbour's words; None without any."""
    plain = fold_words(words)
    found = _ZH.fullmatch(plain) or _EN.fullmatch(plain)
    if found is None:
        return None
    how = next(relation for relation in Relation if found[relation.value])
    return found["what"], how, found["by"]


def several(words: str, label: str) -> bool:
    """Tell whether words mean more than one neighbour, of this kind: ``the cups on the tables``."""
    by = (parted(words) or ("", "", ""))[2]
    one, many = (kind_of(label).en, *kind_of(label).also_en), by.endswith("s")
    return _SEVERAL.search(by) is not None or (many and not by.endswith(one))


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


def judged(thing: Thing, relation: Relation, by: Thing) -> bool | None:
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


def told(what: Bilingual, relation: Relation, by: Bilingual) -> Bilingual:
    """Return a thing's name with its neighbour's: ``cup on the table``, ``桌子上的杯子``."""
    return say(f"related.{relation.value}", what=what, by=by)
