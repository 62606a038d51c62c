"""Read which place of a round is to come first: "do the study first", 先去书房. Pure.

Whole sentences. By itself, 先去书房 is a drive; whether a round goes there, the missions say.
"""

from __future__ import annotations

import re

from planner.language.folding import fold_words, has_chinese

MAX_READ = 60
_ENDS = " .!,;:。~…，；！"
_PLACE = r"(?P<{}>(?:(?:the|my|our) )?(?:(?!\b(?:and|or|then|if)\b)[a-z' -]){{2,30}}?)"
_FIRST = re.compile(
    r"(?:(?:no|oh|ok|okay|well|actually|wait|please|just|but|robot)[ ,.!]+)*"
    rf"(?:(?:(?:go|drive|head) to|do|check|visit|try|look in|take) {_PLACE.format('a')} first"
    rf"|(?:start|begin) (?:with|in|at) {_PLACE.format('b')}|{_PLACE.format('c')} first)"
    r"(?:[ ,]+(?:please|though|then))*"
)
_FIRST_ZH = re.compile(
    r"(?:[哎哦噢啊诶嗯欸]|不|等等|等一下|你|,)*"
    r"(?:先(?:去|到|看|查|巡|找|检查)(?P<a>[^,，。;别不]{1,8}?)(?:看看|看一下)?"
    r"|(?:先)?从(?P<b>[^,，。;]{1,8}?)(?:那边|那儿)?开始|(?P<c>[^,，。;别不]{1,8}?)(?:先去|先看|先来|优先))"
    r"(?:吧|哈|啊)*"
)


def read_first_place(text: str) -> str | None:
    """Return the words for the place that is to come first; None of another sentence."""
    said = fold_words(text).replace("’", "'").strip(_ENDS)
    if not 0 < len(said) <= MAX_READ or text.rstrip().endswith(("?", "？")):
        return None
    if has_chinese(said):
        said = re.sub(r"[，。；]", ",", "".join(said.split()))
    found = (_FIRST_ZH if has_chinese(said) else _FIRST).fullmatch(said)
    return next((words for words in found.groups() if words), None) if found is not None else None
