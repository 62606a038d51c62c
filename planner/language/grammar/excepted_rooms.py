"""Write an order for all rooms but some as one for the others: "check every room but the study".

Marked text to marked text, English. Laws: no room that is left out is named in what is made; where
it is named twice, where its exception hangs on something, or where no room is left, nothing is made
and the sentence stays denied.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.grammar.lexicon import MARK

if TYPE_CHECKING:
    from planner.language.grammar.lexicon import Lexicon, MarkedText
    from planner.plan import Vocabulary

_THE = r"(?:(?:the|my|our) )?"
_HOME = r"(?:house|home|flat|apartment|place)"
_ALL = (
    r"(?:all(?: of)?(?: the| our)?(?: other)? rooms|every(?: single)? (?:other )?room"
    r"|each(?: of the)? rooms?|everywhere|every ?where else|the (?:other )?rooms"
    rf"|(?:the |our |my )?(?:whole |entire )?{_HOME})"
)
_ROUND = (
    r"(?:patrol|check(?: out)?|inspect|visit|tour|do|scan|survey|drive (?:round|around|through|to)"
    r"|go (?:round|around|through|to|into)|look (?:in|into|round|around|through)"
    r"|(?:do|make|have|take) (?:a|the|your|one) (?:quick |little |full )?"
    r"(?:round|rounds|lap|tour|sweep|circuit|patrol|look|walk)"
    r" (?:of|in|into|round|around|through|at))"
)
_ROOMS = rf"(?P<left>{_THE}{MARK}(?:(?:,? (?:and|or|nor) |, )(?:in |to |into )?{_THE}{MARK})*)"
_NOT_INTO = (
    r"(?:do not|don't|never|no need to) (?:go|look|drive|come|bother)(?: (?:in|into|to|with|near))+"
)
_EXCEPT = (
    r"(?:but(?: not)?(?: for| in| into| to)*|except(?:ing)?(?: for)?(?: in| to)?|apart from"
    r"|other than|aside from|besides|excluding|without|minus|bar|barring"
    r"|save for|not(?: in| into| to)?|(?:just |only |please |but |and |you can |you may |you )*"
    rf"(?:skip|leave out|omit|miss out|pass over|ignore|avoid|stay out of|keep out of|{_NOT_INTO}))"
)
_WHY = (
    r"(?P<why>[,.;] (?:because |since |as |cos )?(?!you\b)"
    r"(?:someone|somebody|everyone|there|(?:the|my|our) [a-z]+|i|we|he|she|it|they|mum|mom|dad"
    r"|grandma|grandpa|granny)(?:'s|'m|'re| is| are| am)(?! (?:to|not)\b)"
    r"(?: [a-z]+){1,4}(?=[.!]*$))?"
)
"""Why a room is left out; it orders nothing."""
_END = (
    rf"{_WHY}(?=$|[.!;]|,? (?:please|thanks|thank you)\b"
    r"|,? (?:and|then|and then) (?!(?:if|when|unless|until)\b))"
)
_SHAPES = (
    re.compile(
        rf"(?P<verb>\b{_ROUND} )?(?P<all>\b{_ALL})"
        r"(?P<mid>(?: (?!but\b|except|apart\b)[^.,;!?]*?)?),? "
        rf"{_EXCEPT} {_ROOMS}{_END}"
    ),
    re.compile(
        rf"(?P<verb>\b{_ROUND} )?(?P<all>\b{_ALL})(?P<mid>(?: [^.,;!?]*?)?),? "
        rf"(?:but |and |just )?leave {_ROOMS} out{_END}"
    ),
)
_LEADS = re.compile(
    r"^(?:except(?: for)?|apart from|other than|aside from|besides|excluding)"
    rf" {_ROOMS},? (?P<rest>.+)$"
)
_DRIVES = re.compile(r"(?:go|drive) (?:to|into|through)|visit")
"""A round to drive, and not to look."""
_OPEN = re.compile(r"\b(?:if|unless|until|till|when|while|before|after|once|or)\b")


def without_excepted_rooms(
    marked: MarkedText, lexicon: Lexicon, vocabulary: Vocabulary
) -> str | None:
    """Return a sentence as one about the rooms that are left; None where none is excepted."""
    said = marked.text.strip()
    lead = _LEADS.match(said)
    if lead is not None:
        said = f"{lead['rest'].rstrip(' .!')} except {lead['left']}"
    for shape in _SHAPES:
        found = shape.search(said)
        if found is None:
            continue
        marks = re.findall(MARK, found["left"])
        outside = said[: found.start("left")] + said[found.end("left") :]
        ids = [marked.mention(mark).ids for mark in marks]
        rooms = [entry for entry in vocabulary.entries if entry.kind == "room"]
        out = {place for each in ids for place in each}
        named = {place for mark in re.findall(MARK, outside) for place in marked.mention(mark).ids}
        sure = all(len(each) == 1 for each in ids) and out <= {room.id for room in rooms}
        left = [room for room in rooms if room.id not in out]
        if not sure or not left or out & named or _OPEN.search(found[0]):
            return None
        names = [f"the {lexicon.own_name(room).en.lower()}" for room in left]
        joined = ", ".join(names[:-1]) + " and " + names[-1] if len(names) > 1 else names[0]
        drives = found["verb"] and _DRIVES.match(found["verb"])
        round_of = "visit " if drives else "patrol "
        verb = round_of if found["verb"] else ("in " if found["all"] == "everywhere" else "")
        made = f"{verb}{joined}{found['mid']}"
        return marked.restore(said[: found.start()] + made + said[found.end() :])
    return None
