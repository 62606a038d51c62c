"""Tell which of the orders that a question offers a person's answer names. Pure.

"Go to the kitchen or the study" offers two orders; "the study, please", 书房吧, "the second one"
name one of them. Law: every word of the answer is read, but for articles and courtesy; what may
name two, or adds anything, names none and is left to a brain.
"""

from __future__ import annotations

import re
from itertools import takewhile
from typing import TYPE_CHECKING

from planner.language.folding import fold, has_chinese

if TYPE_CHECKING:
    from collections.abc import Sequence

_READ = 80
"""Characters; a longer answer says more than a choice."""
_MARKS = re.compile(r"[\s,.!?;:。、，！？；：…~\"“”「」]+")
_LEAD = re.compile(
    r"(?:(?:um|uh|er|erm|well|oh|ok|okay|please|just|then|i mean|i meant|i said|let's say|go"
    r"|to|into|in|at|the|my|our|that's|it's) )+"
)
_TAIL = re.compile(r"(?: (?:please|thanks|thank you|then|i think|i guess))+$")
_LEAD_ZH = re.compile(r"(?:嗯|呃|哦|那|就|请|去|到|在|是|我说的是|我是说|选|要)+")
_TAIL_ZH = re.compile(r"(?:吧|啊|呀|呢|谢谢|就行|就好|好了)+$")
_ORDINALS = (
    re.compile(r"(?:first|1st|former)(?: one)?|(?:(?:number|option) )?(?:1|one)"
               r"|第[一1]个?|[一1]号?|前者|前面?(?:那个|的)"),
    re.compile(r"(?:second|2nd)(?: one)?|(?:(?:number|option) )?(?:2|two)|第[二2]个?|[二2]号?"),
    re.compile(r"(?:third|3rd)(?: one)?|(?:(?:number|option) )?(?:3|three)|第[三3]个?|[三3]号?"),
)  # fmt: skip
_LAST = re.compile(r"(?:last|latter)(?: one)?|后者|后面?(?:那个|的)|最后(?:一个|那个)")


def choose(offers: Sequence[Sequence[str]], answer: str) -> int | None:
    """Return the index of the offer that an answer names; None where it names none, or two.

    Args:
        offers: each with all its wordings, in the order in which they are told.
        answer: what a person said.
    """
    if len(offers) < 2 or len(answer) > _READ:
        return None
    said = _bare(answer)
    counted = [at for at, one in enumerate(_ORDINALS[: len(offers)]) if one.fullmatch(said)]
    if _LAST.fullmatch(said):
        counted.append(len(offers) - 1)
    if counted:
        return counted[0]
    by_wording = zip(*offers, strict=True)
    named = {at for wordings in by_wording for at in _find_named(wordings, said)}
    return named.pop() if len(named) == 1 else None


def _find_named(wordings: Sequence[str], said: str) -> list[int]:
    """Return the wordings whose own part, that no other one has, is what was said."""
    chinese = has_chinese("".join(wordings))
    cut = [list(fold(each)) if chinese else _MARKS.split(fold(each)) for each in wordings]
    head = _alike(cut)
    tail = _alike([each[head:][::-1] for each in cut])
    gap = "" if chinese else " "
    return [
        at
        for at, each in enumerate(cut)
        for end in (len(each) - tail, len(each))  # 书房 ends as 厨房 does
        if said and said == _bare(gap.join(each[head:end]))
    ]


def _alike(rows: Sequence[Sequence[str]]) -> int:
    """Return with how many of the same pieces all rows begin."""
    return sum(1 for _ in takewhile(lambda pieces: len(set(pieces)) == 1, zip(*rows, strict=False)))


def _bare(text: str) -> str:
    plain = _MARKS.sub(" ", fold(text)).strip()
    if has_chinese(plain):
        plain = plain.replace(" ", "")
        return _TAIL_ZH.sub("", _LEAD_ZH.sub("", plain, count=1) or plain)
    found = _LEAD.match(plain)
    return _TAIL.sub("", plain[found.end() :] if found is not None else plain)
