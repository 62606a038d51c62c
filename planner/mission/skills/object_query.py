"""Read what a question asks for, and by which neighbour, as far as these eyes can judge. Pure.

"Is the cup on the table?", "桌子上有杯子吗", "what is under the chair?". Where it is to be that no
eye here can tell ("on the shelf", "箱子里") stays in the question's words, so that it can be said.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.object_names import resolve, singles_out
from planner.mission.skills.location_phrases import Where, where_of
from planner.mission.skills.object_matching import mentioned
from planner.mission.skills.object_questions import LEAD_ZH, asked_for, in_chinese, plain
from planner.mission.skills.perception import Wanted
from planner.mission.skills.spatial_relations import Relation, parted

if TYPE_CHECKING:
    from planner.mission.state import SiteView

_OPEN_EN = re.compile(
    r"(?:[a-z, ]{0,30}\b)?(?:what|who)(?: else)?(?: (?:is|are|do|can|you|see|there|things?|lying"
    r"|standing|sitting|lies|stands|sits))* (?P<where>(?:in|on|at|under|below|beneath|near|by"
    r"|beside|inside|behind|around|next to|close to)\b.+)"
)
_OPEN_ZH = re.compile(
    rf"{LEAD_ZH}(?P<where>[^有]{{1,12}}?){LEAD_ZH}[还都]?(?:现在)?"
    r"(?:有|是|[放摆坐站躺停][着了])(?:些|点)?(?:什么|啥|谁|哪些|何).{0,4}"
    r"|谁(?:正?[坐站躺睡])?在(?P<where_2>.{1,12}?)[吗呢啊]?"
)
_HOW_ZH = r"(?:[上下][面边]?|底下|旁边?|边上)"
_LOOSE_ZH = (
    re.compile(
        rf"{LEAD_ZH}(?P<where>[^有]{{1,12}}?{_HOW_ZH})(?:现在|[还都])*"
        r"(?:是不是有|有|[放摆坐站躺停][着了])(?P<what>.+)"
    ),
    re.compile(
        rf".*?(?:看|见|发现)[到见]?[了过]?(?P<where>[^有]{{1,12}}?{_HOW_ZH})的(?P<what>.+?)了?(?:吗|没有|没|么)"
    ),
    re.compile(rf"(?P<what>.+?)在(?P<where>[^在]{{1,12}}?{_HOW_ZH})(?:吗|没有|的.*)?"),
)
FLOOR = Wanted("floor")
"""No detector finds it, and every height tells of it."""
_FLOOR = re.compile(r"(?:the |your )?(?:floor|ground)|地板?|地面")


@dataclass(frozen=True, slots=True)
class Sought:
    """Say what is asked for."""

    what: Wanted | None = None
    """None: all that is there."""
    relation: Relation | None = None
    by: Wanted | None = None
    """What it is to stand so to: a kind that these eyes know, or the floor."""
    unclear: str = ""
    """Where it is to be, in words that no eye here can judge."""


def sought_in(
    question: str, facts: SiteView, place: str | None, classes: tuple[str, ...]
) -> Sought:
    """Return what a question asks for of eyes with these classes.

    Args:
        question: as it was said.
        facts: the site; its rooms and places are where to look.
        place: where is looked round; None: from where the robot stands.
        classes: what the eyes know; empty: not known yet.
    """
    asked = asked_for(question, facts)
    if asked is None:
        return _open(question, facts, place, classes)
    inner = parted(asked.what)
    if inner is not None and not asked.where:  # "do you see the cup on the table"
        return _sought(inner[0], Where(inner[1], inner[2], asked.what), classes)
    return _sought(asked.what, where_of(asked.where, facts, place), classes)


def _open(question: str, facts: SiteView, place: str | None, classes: tuple[str, ...]) -> Sought:
    """Read "what is on the table?"; and of what is not understood, where it names a neighbour."""
    text = plain(question)
    found = (_OPEN_ZH if in_chinese(text) else _OPEN_EN).fullmatch(text)
    if found is not None:
        words = next(found[name] for name in found.groupdict() if found[name])
        return _sought("", where_of(words, facts, place), classes)
    what, words = _apart(text)
    sought = _sought(what, where_of(words, facts, place), classes)
    return sought if sought.by is not None else Sought(mentioned(question, classes))


def _apart(text: str) -> tuple[str, str]:
    """Return what a sentence says before, and what of a neighbour."""
    for pattern in _LOOSE_ZH if in_chinese(text) else ():
        if (found := pattern.fullmatch(text.replace(" ", ""))) is not None:
            return found["what"], found["where"]
    parts = None if in_chinese(text) else parted(text)
    return (parts[0], f"{parts[1].value} {parts[2]}") if parts is not None else (text, "")


def _sought(what: str, where: Where | None, classes: tuple[str, ...]) -> Sought:
    wanted = mentioned(what, classes)
    if where is None:
        return Sought(wanted)
    by = _neighbour(where, classes)
    return (
        Sought(wanted, where.relation, by) if by is not None else Sought(wanted, unclear=where.said)
    )


def _neighbour(where: Where, classes: tuple[str, ...]) -> Wanted | None:
    """Return the kind of thing that a neighbour's words mean, where these eyes can tell it."""
    if where.relation is None:
        return None
    if _FLOOR.fullmatch(where.by):
        return FLOOR if where.relation is Relation.ON else None
    found = None if singles_out(where.by, classes) else resolve(where.by, None, classes)
    return Wanted(*found) if found is not None else None
