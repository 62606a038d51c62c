"""Write everyday speech as the plain order that it is, for a second reading where the first failed.

Tables of phrases, one for each language, applied in their order to a normalised sentence whose
places are marked. What is taken away carries no meaning (hesitation, address, courtesy, a reason);
what is put in its place says the same in the grammar's words. The law: a sentence with a word of
denial, exception or choice, or with a condition that is no courtesy, is never written anew, so that
nothing which holds an order back is lost on the way. The result is read as any sentence is, with
all vetoes, and every word of it counts.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from re import Pattern

Phrases = Sequence[tuple[Pattern[str], str]]
MOST_PASSES = 4
"""Over a table: what one phrase leaves may be another one ("um, could you, er, pop over to")."""
_MARKS = re.compile(r"\s*([,;])(?:\s*[,;])+")
_GAPS = re.compile(r"\s+")
_STRETCHED = re.compile(r"([a-z])\1{2,}")


def rewrite(text: str, phrases: Phrases) -> str:
    """Return a marked sentence in plainer words; the same where no phrase stands in it."""
    said = _STRETCHED.sub(r"\1", text)
    for _ in range(MOST_PASSES):
        before = said
        for pattern, plain in phrases:
            said = _tidy(pattern.sub(plain, said))
        if said == before:
            break
    return said


def _tidy(text: str) -> str:
    """Return the text without doubled marks and gaps, and without a mark at its beginning."""
    return _GAPS.sub(" ", _MARKS.sub(r"\1", text)).strip(" ,;")


def table(*rows: tuple[str, str]) -> Phrases:
    """Compile rows of pattern and replacement."""
    return tuple((re.compile(pattern), plain) for pattern, plain in rows)
