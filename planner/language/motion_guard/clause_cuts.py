"""Cut a text into clauses: where a mark or a joining word stands, where a denial begins, and where
the order of a condition does. Pure.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.clause_words import CHINESE, ENGLISH, ClauseWords
from planner.language.motion_guard.mentioned_names import find_places

if TYPE_CHECKING:
    from planner.plan import Vocabulary

FINITE = re.compile(
    r"\b(?:is|are|was|were|am|has|had|have|will|would|smells?|feels?|looks?|seems?|needs?|does)\b"
    r"|\w(?:'s|'re|'ll|'ve|'m|n't)\b"
)

_SPLITS = re.compile(f"{ENGLISH.splits.pattern}|{CHINESE.splits.pattern}")
HARD = re.compile(r"[.;!?|。；！？…]")
_QUOTED = re.compile(r"[“\"「『‘][^”\"」』’]*[”\"」』’]?")
_ASKED_IF = re.compile(
    r"(?:see|check|find out|tell \w+|know|look|ask(?: \w+){0,2}|wonder|say|report"
    r"|appreciate it|be \w+|grateful|as)\s*$"
)
_CONSEQUENCE = re.compile(
    r"(?<!to )(?<!you )(?<!i )(?<!we )(?<!they )(?<!can )(?<!never )(?<!don't )(?<!can't )"
    r"(?<!kids )(?<!people )(?<!children )(?<!not )(?<!and )"
    r"\b(?:please|go|come|drive|say|tell|ask|look|check|find|return|turn|follow|wait|stay|head"
    r"|patrol|count|stop|move)\b"
)
_SUBJECT = re.compile(r"\b(?:you|we|they|i|he|she|it) [a-z]+")
_JUST_ZH = re.compile(rf"^(.{{1,16}}?)你?(?:[就便]|(?<!否)则)(?=你|{CHINESE.orders.pattern})")
_SEQUEL_ZH = re.compile(r"(?![看找听][见到])[去到进看做转巡走找数等待拿](?!.*[没不有])")


@dataclass(frozen=True, slots=True)
class ClausePart:
    """Hold where a clause stands in a text, from ``start`` to ``end``."""

    start: int
    end: int
    mark: str
    """What parts it from the one before."""
    upon: bool = False
    """A condition by what follows: 有人来了 before 就."""


def mask_quotes(said: str) -> str:
    """Blot out what is quoted after a word of speech, whatever stands in it."""

    def mask(quoted: re.Match[str]) -> str:
        before = said[: quoted.start()]
        spoken = ENGLISH.speaks.search(before) or CHINESE.speaks.search(before)
        return "|" * len(quoted[0]) if spoken else quoted[0]

    return _QUOTED.sub(mask, said)


def table_of(words: str) -> ClauseWords:
    """Return the rows of the language that words are in; one Chinese character tells."""
    return CHINESE if has_chinese(words) else ENGLISH


def cut(said: str, vocabulary: Vocabulary) -> list[ClausePart]:
    """Cut a text where clauses end, where a denial begins and where a condition's order does."""
    found: list[ClausePart] = []
    at, mark = 0, ""
    for end in [*_SPLITS.finditer(said), None]:
        stop = len(said) if end is None else end.start()
        if end is not None and not end[0] and _ASKED_IF.search(said[at:stop]):
            continue  # "see if …" asks, and hangs on nothing
        if said[at:stop].strip(" '\""):
            found += _cut_part(said, ClausePart(at, stop, mark), vocabulary)
            mark = ""
        if end is not None:
            at, mark = end.end(), mark + end[0]
    return found


def _cut_part(said: str, part: ClausePart, vocabulary: Vocabulary) -> list[ClausePart]:
    words = said[part.start : part.end]
    table = table_of(words)
    at, upon = None, False
    if (
        table is ENGLISH
        and table.hangs.match(words.strip())
        and not table.polite.match(words.strip())
    ):
        finite = FINITE.search(words) or _SUBJECT.search(words)
        verb = _CONSEQUENCE.search(words, finite.end() if finite else 0)
        at = verb.start() if verb is not None else None
    elif table is CHINESE:
        just = _JUST_ZH.match(words)
        left = strip_openers(just[1], table.opens) if just is not None else ""
        actor = table.others.fullmatch(left) and left[0] not in "有没"  # 有人就: where somebody is
        if just is not None and left and not actor:
            at, upon = just.end(1), _SEQUEL_ZH.match(left) is None
    denial = find_denial(words, table) if at is None else None
    if denial is not None and denial > 0 and strip_openers(words[:denial].strip(), table.opens):
        before = strip_openers(words[:denial].strip(), table.opens)
        named = [p for p in find_places(before, vocabulary) if p.start == 0]
        if table is ENGLISH or (table.orders.match(before) and not named):
            at = denial
    if at is None or at == 0:
        return [part]
    middle = part.start + at
    rest = _cut_part(said, ClausePart(middle, part.end, ""), vocabulary)
    return [ClausePart(part.start, middle, part.mark, upon), *rest]


def find_denial(words: str, table: ClauseWords) -> int | None:
    """Return where a denial or an exception begins."""
    bare = table.no_denial.sub(lambda found: "·" * len(found[0]), words)
    starts = [each.start() for row in (table.denies, table.excepts) if (each := row.search(bare))]
    return min(starts, default=None)


def strip_openers(text: str, opener: re.Pattern[str]) -> str:
    """Return a text without what opens it, as often as it does."""
    while (found := opener.match(text)) is not None and found.end():
        text = text[found.end() :].strip()
    return text
