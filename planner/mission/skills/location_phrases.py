"""Read where a question wants a thing to be: how it stands to which neighbour. Pure.

"on the table in the kitchen", "厨房的桌子上". A room or place of the site says where to look, and
is no neighbour but for what lies on or under it; "here" is none either.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from planner.language.folding import fold_words
from planner.language.object_names import resolve
from planner.mission.skills.spatial_relations import Relation

if TYPE_CHECKING:
    from planner.mission.state import SiteView

_THE = r"(?:(?:the|this|that|my|our|your) )?"
_EN = re.compile(
    r"(?:(?P<on>on(?: top of)?)|(?P<under>under(?:neath)?|below|beneath)"
    r"|(?P<near>near|next to|beside|close to|by|at|around)"
    r"|(?P<odd>in front of|in|inside|behind|outside)) (?P<by>.+?)"
    r"(?: (?:still|now|right now|there|here|over there|please))*"
)
_ZH = re.compile(
    r"在?(?P<by>.+?)(?:(?P<on>上面?|上边)|(?P<under>下面?|下边|底下)"
    r"|(?P<near>旁边?|边上?|附近|周围|身[边旁])"
    r"|(?P<odd>里面?|里边|内|[背身]?后[面边]?|[面眼]?前[面边方]?|中间))的?"
)
_HERE = re.compile(
    rf"here|there|you|me|us|all|home|sight|view|front(?: of (?:you|me|us))?"
    rf"|{_THE}(?:room|house|home|flat|apartment|place|picture|image|view|moment)"
    r"|[你您我这那]们?(?:里|儿|边|的)?|[面眼身背]|(?:[这那]个?)?(?:房间|屋子?|家|图片?|照片)"
)
_IN_HERE = re.compile(rf" in(?:side)? {_THE}(?:room|house|home|flat|apartment|picture)$")


_BESIDE = "上下里内旁边底后前中附周"
"""How words go on that say where beside a place itself."""


class Where(NamedTuple):
    """Say how a thing is to stand to what."""

    relation: Relation | None
    """None: in, behind or before it, which no position tells."""
    by: str
    """The neighbour's words."""
    said: str
    """All of it, as said."""


def where_of(words: str, facts: SiteView, place: str | None) -> Where | None:
    """Return which neighbour words name; None where there is none, but a place to look in.

    Args:
        words: as they follow or precede the thing in a question.
        facts: the site.
        place: where is looked round; None: from where the robot stands.
    """
    found = _EN.fullmatch(bare := _without_place(words, facts)) or _ZH.fullmatch(bare)
    if found is None or _HERE.fullmatch(found["by"]):
        return None
    relation = next((how for how in Relation if found[how.value]), None)
    room = _rooms(facts).get(re.sub(rf"^{_THE}", "", found["by"]))
    if room or (room is False and place is not None and _looked_at(relation, found["by"])):
        return None
    return Where(relation, found["by"], bare.strip())


def _looked_at(relation: Relation | None, by: str) -> bool:
    """Tell whether who looks round a place sees what is meant: nobody looks into a fridge."""
    return relation is Relation.NEAR or (relation is None and resolve(by) is None)


def _without_place(words: str, facts: SiteView) -> str:
    """Return the words without the room or place that they lie in, where more than that is said."""
    names = "|".join(map(re.escape, sorted(_rooms(facts), key=len, reverse=True)))
    if names:
        words = re.sub(rf" (?:in|inside|at|of) {_THE}(?:{names})$", "", words)
        words = re.sub(rf"^在?(?:{names})(?:里面?|里边|内|中)?的?(?=[^{_BESIDE}].)", "", words)
    return _IN_HERE.sub("", words)


def _rooms(facts: SiteView) -> dict[str, bool]:
    """Return what rooms and places are called, and whether that is a room."""
    return {
        fold_words(name): t.room
        for t in facts.targets.values()
        for name in (t.name.en, t.name.zh, *t.aliases)
    }
