"""Find the places that the clauses of a person's words lead to: named, described, or meant by them.

A place may be named, told by what stands in it ("the one with the bed", "the oven"), or be one of a
group ("every room"); and an order that names none leans on the only place that other clauses name.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.mentioned_names import find_places, places_named
from planner.language.room_names import sorts_of_room

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.language.motion_guard.clauses import SaidClause
    from planner.plan import Vocabulary

GAP = " | "
"""Parts clauses that are searched as one text."""
_ALL_ROOMS = re.compile(
    r"\b(?:every|each|all|other|whole|entire|rest of)\b[a-z' ]{0,12}\b"
    r"(?:rooms?|house|home|flat|apartment|places?)\b|\beverywhere\b|\bwhole place\b"
    r"|\b(?:around|round|through) the (?:house|home|flat|apartment)\b"
    r"|(?:所有|每个|每间|各个|各|全部)的?(?:房间|屋子|屋)|全屋|整个(?:家|屋|房)|到处|四处|全家"
)
_ROUNDS = re.compile(r"\bpatrol|\brounds?\b|\btour\b|巡")
_HERE = re.compile(r"\b(?:here|this room|around|the room)\b|这里|这儿|这个房间|这间|周围|四周|屋里")
_THERE = re.compile(r"\b(?:there|it|that|one|in)\b|那里|那儿|那边|那间|过去|进去|它|的话$|再$|就$")
_LEANS = re.compile(
    r"\b(?:to|towards?|at|into|in|near|beside|behind|by|round|around|after|with|approach|visit|find"
    r"|see|meet|follow|join) (?:the )?(?:\w+ )?(?:it|that|this|ones?|him|her|them)\b|\bthere\b"
    r"|\bdo (?:it|that|this|the same)\b"
    r"|[去到近找看跟陪接往朝过][^,，。]{0,3}[它他她]|那[里儿边个]|过去|再[去来][^,，。]?[一几两]?[次遍趟]"
    r"|[去到近][^,，。]{1,4}的那?[个只把]?$"
)
_WHOM = re.compile(r"\W*(?:him|her|them)\b|[问叫一下声]{0,3}[他她]")


def leans_back(clauses: Iterable[SaidClause]) -> bool:
    """Tell whether clauses lead to what was spoken of before them, or to whom: "go up to it"."""
    return any(
        _LEANS.search(c.text) or _WHOM.match(c.speech) for c in clauses if not c.stays or c.speech
    )


_OWN_WAY = re.compile(
    r"(?:i|we)(?:'m|'re|'ll| am| are| will| need| have to| must| might| may| want to| got)\b"
    r"|我们?(?:先|要|去|得|马上|一会|正|自己)"
)
_GOES_BACK = re.compile(
    r"(?:(?:otherwise|else|then|please|and|just|now) )*(?:come|go|drive|head|return|get|be)? ?"
    r"(?:straight |right )?(?:back|home)(?: here| home| to me)?"
    r"|(?:否则|不然|要不然|就|再|请|你|那|都)*(?:回[来去家]|返回|回到?家)[吧了啊哦]?"
)
"""Leads home or back, and nowhere that other clauses name."""
_USED = {
    "kitchen": re.compile(
        r"\b(?:oven|stove|hob|cooker|kettle|dishwasher|washing.up)\b|灶|烤箱|炉子|水壶|洗碗"
    ),
    "bathroom": re.compile(r"\b(?:shower|bath ?tub|washbasin)\b|洗澡|淋浴|浴缸|马桶"),
}
"""What stands in one sort of room alone."""
_HOLDS = re.compile(r"\b(?:room|one|place) (?:that )?(?:with|has|having|where)\b[^,.;|]{0,24}$")
_HOLDS_ZH = re.compile(r"(?:有|摆着?|放着?)[^,，。;|去到来回就]{0,4}$")
_HOLDING_ZH = re.compile(r"的(?:那|房|屋|间|地方)")
_HELD_ZH = re.compile(r"(?:在的|所在的?)那?[个间]?")


def join_clauses(clauses: Iterable[SaidClause]) -> str:
    """Return the texts of clauses as one, parted."""
    return GAP.join(each.text for each in clauses)


class MeantPlaces:
    """Count the places that clauses of one person's words lead to."""

    def __init__(
        self,
        every: tuple[SaidClause, ...],
        room: str | None,
        vocabulary: Vocabulary,
        before: tuple[str, ...] = (),
    ) -> None:
        """Take all clauses of the words, where the robot is, the names of places, and what was
        spoken of before, newest first.
        """
        self._every, self._room, self._vocabulary = every, room, vocabulary
        self._before = before

    def count_named(self, usable: list[SaidClause]) -> Counter[str]:
        """Return the places that clauses send to, each as often as they do."""
        leads = [c for c in usable if not c.stays]
        away = [c for c in leads if not _GOES_BACK.fullmatch(c.text)]
        said = join_clauses(usable)
        named = Counter(places_named(said, self._vocabulary))
        named.update(dict.fromkeys(self._rooms_of_group(said), 1))
        named.update(self._rooms_described(said))
        if self._room is not None and _HERE.search(join_clauses(leads)):
            named[self._room] += 1
        named.update(self._rooms_by_use(said) if not named else ())
        if not named and away:  # "grandma is in the bedroom, go and see"
            named.update(self._leant_on(usable, said))
        if not named and leans_back(usable):
            named.update(self._spoken_of_before())
        return named

    def _spoken_of_before(self) -> Counter[str]:
        """Return the one place of the newest earlier words that name any."""
        texts = (set(places_named(text, self._vocabulary)) for text in self._before)
        found = next(filter(None, texts), set[str]())
        return Counter(found if len(found) == 1 else ())

    def _leant_on(self, usable: list[SaidClause], said: str) -> Counter[str]:
        """Return the one place of the other clauses, where an order names none."""
        spoken = any(c.hung for c in usable)
        others = [
            c
            for c in self._every
            if c.mood not in (ClauseMood.DENIED, ClauseMood.CALL)
            and not _OWN_WAY.match(c.text)
            and (c.mood is not ClauseMood.CONDITION or _THERE.search(said))
        ]
        places = self._find_one(others, spoken)
        if not places and _THERE.search(said):  # of two places it is the one before it
            at = self._every.index(usable[0])
            places = self._find_one([c for c in others if c in self._every[:at]], spoken)
        return places

    def _find_one(self, clauses: list[SaidClause], spoken: bool) -> Counter[str]:
        """Return the place of clauses where they name one alone; ``spoken``: speech counts."""
        said = GAP.join(f"{c.text}{c.speech if spoken else ''}" for c in clauses)
        found = Counter(places_named(said, self._vocabulary))
        found.update(self._rooms_described(said))
        found.update(self._rooms_by_use(said) if not found else ())
        return Counter(dict.fromkeys(found, 1)) if len(found) == 1 else Counter()

    def _rooms_described(self, said: str) -> Counter[str]:
        """Return the rooms that are named by what stands in them: "the one with the bed"."""
        found: Counter[str] = Counter()
        for place in find_places(said, self._vocabulary):
            room = self._vocabulary.by_id[place.id].room
            if room is not None and (
                _HOLDS.search(said, 0, place.start)
                or _HELD_ZH.match(said, place.end)
                or (_HOLDS_ZH.search(said, 0, place.start) and _HOLDING_ZH.match(said, place.end))
            ):
                found[room] = 1
        return found

    def _rooms_by_use(self, said: str) -> dict[str, int]:
        """Return the rooms that are meant by what only such a room has, where there is one."""
        sorts = {sort for sort, words in _USED.items() if words.search(said)}
        rooms = [e for e in self._vocabulary.entries if e.kind == "room"]
        found = {s: [e.id for e in rooms if s in sorts_of_room(e.spellings)] for s in sorts}
        return {ids[0]: 1 for ids in found.values() if len(ids) == 1}

    def _rooms_of_group(self, said: str) -> frozenset[str]:
        """Return the rooms that "every room" means, without those that are left out."""
        rounds = _ROUNDS.search(said) and not places_named(said, self._vocabulary)
        if not (_ALL_ROOMS.search(said) or rounds):
            return frozenset()
        denied = join_clauses(c for c in self._every if c.mood is ClauseMood.DENIED)
        out = frozenset(places_named(denied, self._vocabulary))
        return frozenset(e.id for e in self._vocabulary.entries if e.kind == "room") - out
