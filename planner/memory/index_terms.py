"""Turn words into terms of the full-text index, alike for what is kept and what is asked. Pure.

English words go as they are (FTS5 stems them), Chinese runs as pairs of characters. A word that
names a kind of thing or a colour, in either language, becomes that kind's own term besides: "mug"
finds 杯子, and "couch" what was told about the sofa. What says nothing about a thing is no term.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from planner.language.color_names import color_of
from planner.language.folding import CHINESE, fold, has_chinese
from planner.language.object_classes import KINDS
from planner.language.object_names import canonical

MOST_READ = 400
"""Characters; a longer text is cut."""
MOST_TERMS = 16
"""Terms of a question."""
_RUN = re.compile(rf"([a-z0-9]+(?:[' _-][a-z0-9]+)*)|([{CHINESE}]+)")
_EMPTY_EN = frozenset({
    "a", "about", "an", "and", "any", "are", "at", "be", "been", "by", "can", "could", "did", "do",
    "does", "for", "from", "had", "has", "have", "how", "i", "in", "is", "it", "its", "last", "me",
    "my", "of", "on", "or", "our", "s", "said", "saw", "say", "see", "seen", "some", "tell", "that",
    "the", "their", "them", "there", "they", "this", "to", "told", "us", "was", "we", "were",
    "what", "when", "where", "which", "who", "will", "with", "would", "you", "your",
})  # fmt: skip
_EMPTY_ZH = re.compile(
    r"什么|哪里|哪儿|时候|最后|上次|看到|看见|见过|记得|记住|告诉|知道|关于|放在|里面|上面|旁边"
    r"|[的了吗呢吧啊呀在是我你您他她它们有没过着和与把被就都也还这那个些谁哪里上]"
)
_LONGEST_ZH, _LONGEST_EN = 5, 3


@dataclass(frozen=True, slots=True)
class Terms:
    """Hold the terms of a text: words of it, and kinds and colours that it names."""

    words: tuple[str, ...]
    """Those that no kind stands for."""
    covered: tuple[str, ...]
    """Those that a kind or colour stands for."""
    kinds: tuple[str, ...]
    colors: tuple[str, ...]


def index_text(text: str, label: str = "", color: str | None = None) -> str:
    """Return the terms under which a memory is found: its words, kinds and colours."""
    read = read_terms(f"{text} {label.replace('_', ' ')}")
    kinds = (_kind_term(label),) if label in KINDS else ()
    colors = (_color_term(color),) if color else ()
    every = (*read.words, *read.covered, *read.kinds, *kinds, *read.colors, *colors)
    return " ".join(dict.fromkeys(every))


def match_query(words: str, *, loosely: bool = False) -> str | None:
    """Return the FTS5 query of what is asked for; None where nothing is.

    Args:
        words: a thing, a person, a name, in either language.
        loosely: one word or kind of several is enough, and a colour does not matter.
    """
    read = read_terms(words)
    if loosely:
        terms, gap = (*read.kinds, *read.words), " OR "
    else:
        terms, gap = (*read.kinds, *read.colors, *read.words), " AND "
    quoted = [_quote(term) for term in terms[:MOST_TERMS]]
    return gap.join(quoted) or None


def _quote(term: str) -> str:
    """Return a term as FTS5 reads it; one Chinese character is the beginning of a pair."""
    return f'"{term}"*' if len(term) == 1 and has_chinese(term) else f'"{term}"'


@lru_cache(maxsize=256)
def read_terms(text: str) -> Terms:
    """Return the terms of a text, each once, in its order."""
    words: list[str] = []
    covered: list[str] = []
    named: list[str] = []
    for english, chinese in _RUN.findall(fold(text[:MOST_READ])):
        if english:
            parts = re.split(r"[' _-]", english)
            _read_run(parts, " ", _LONGEST_EN, words, covered, named)
        for run in filter(None, _EMPTY_ZH.split(chinese)) if chinese else ():
            _read_run(list(run), "", _LONGEST_ZH, words, covered, named)
    colors = [term for term in named if term.startswith("zkcolor")]
    kinds = [term for term in named if not term.startswith("zkcolor")]
    return Terms(*(tuple(dict.fromkeys(each)) for each in (words, covered, kinds, colors)))


def _read_run(
    parts: list[str], gap: str, longest: int, words: list[str], covered: list[str], named: list[str]
) -> None:
    """Cut a run into pieces that name a kind or colour, the longest first, and the rest."""
    at, rest = 0, list[str]()
    while at < len(parts):
        for length in range(min(longest, len(parts) - at), 0, -1):
            last = at + length == len(parts)
            term = _term_of(gap.join(parts[at : at + length]), last=last)
            if term is not None:
                if not gap and rest and (color := color_of(rest[-1])) is not None:
                    named.append(_color_term(color))  # 红杯子: a colour of one character
                    covered.append(rest.pop())
                words += _plain_terms(rest, gap)
                covered += _plain_terms(parts[at : at + length], gap)
                named.append(term)
                rest, at = [], at + length
                break
        else:
            rest.append(parts[at])
            at += 1
    if not gap and len(parts) == 1 and (color := color_of("".join(rest))) is not None:
        named.append(_color_term(color))  # 红的杯子: its run ends before 的
        covered.append(rest.pop())
    words += _plain_terms(rest, gap)


def _plain_terms(parts: list[str], gap: str) -> list[str]:
    """Return English words that say something, or pairs of Chinese characters."""
    if gap:
        return [part for part in parts if part not in _EMPTY_EN]
    run = "".join(parts)
    return [run[i : i + 2] for i in range(len(run) - 1)] or ([run] if run else [])


@lru_cache(maxsize=4096)
def _term_of(piece: str, *, last: bool) -> str | None:
    """Return the term of the kind or colour that a piece names.

    One Chinese character names a kind at the end alone: 书 is a book, 书房 a study.
    """
    if len(piece) == 1 and not last:
        return None
    kind = canonical(piece)
    if kind in KINDS:
        return _kind_term(kind)
    color = color_of(piece) if " " not in piece and len(piece) > 1 else None
    return _color_term(color) if color is not None else None


def _kind_term(kind: str) -> str:
    return f"zk{kind.replace('_', '')}"


def _color_term(color: str) -> str:
    return f"zkcolor{color}"
