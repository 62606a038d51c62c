"""Fold a sentence about standing orders: to be matched, and as it was written, side by side. Pure."""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner.language.folding import fold_script, fold_width, has_chinese
from planner.language.schedule.english import TIMER

ENDS = " .!,;:。~…，；！、"
"""What may stand about a sentence or its order."""
_MARKS = str.maketrans({"’": "'", "‘": "'", "，": ",", "；": ";", "：": ":", "！": "!", "？": "?"})
_SPACES = re.compile(r"\s+")
_DAYS_ER = re.compile(
    r"(?<!说)([今明后])儿个?(?=[早上中下晚夜]|[一二三四五六七八九十两\d]{1,2}[点:])"
)
"""明儿早上 is 明天早上."""


@dataclass(frozen=True, slots=True)
class FoldedSentence:
    """Hold a sentence twice, character for character alike: to match, and as it was written."""

    folded: str
    written: str

    def part(self, start: int, end: int | None = None) -> FoldedSentence:
        return FoldedSentence(self.folded[start:end], self.written[start:end])

    def strip(self, pattern: re.Pattern[str]) -> FoldedSentence:
        """Take off what a pattern matches at the beginning."""
        found = pattern.match(self.folded)
        return self.part(found.end()) if found is not None else self

    def strip_end(self, pattern: re.Pattern[str]) -> FoldedSentence:
        found = pattern.search(self.folded)
        return self.part(0, found.start()) if found is not None and found.start() > 0 else self

    def bare(self) -> FoldedSentence:
        start = len(self.folded) - len(self.folded.lstrip(ENDS))
        return self.part(start, max(start, len(self.folded.rstrip(ENDS))))


def fold_sentence(text: str) -> FoldedSentence:
    """Return a sentence folded, with its spaces and marks made alike."""
    spaced = _SPACES.sub(" ", fold_width(text).translate(_MARKS)).strip()
    spaced = _DAYS_ER.sub(r"\1天", spaced)
    if has_chinese(spaced):  # spaces between characters mean nothing; between Latin words they do
        spaced = re.sub(r"(?<![A-Za-z0-9]) | (?![A-Za-z0-9])", "", spaced)
    spaced = TIMER.sub(_turn_timer, spaced)
    folded = spaced.lower()
    if len(folded) != len(spaced):  # a few letters grow in lower case
        spaced = folded
    return FoldedSentence(fold_script(folded), spaced)


def _turn_timer(found: re.Match[str]) -> str:
    """Return "set a timer in ten minutes" for "set a timer for ten minutes"."""
    if found["a"]:
        return f"{found['a']} in "
    if found["c"]:
        return f"{found['c']} at "
    return f"{found['b']}timer in {found['lasts'].replace('-', ' ')} for"
