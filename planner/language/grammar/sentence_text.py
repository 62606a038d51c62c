"""Take a sentence in as it was written: refuse what is not text, fold it, mend its typos.

Pure text to text. What folding takes away carries no meaning; all else is left for the grammar to
account for, symbols included. A word of command with one wrong letter ("naviagte", "folow") is
mended where it can mean nothing else.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

from rapidfuzz.distance import OSA

from planner.language.catalogue import message, say
from planner.language.folding import CHINESE, count_chinese, fold
from planner.plan import Bilingual, Code, Refuse

MAX_CHARACTERS = 2000
MOST_READ = 340
"""Characters that the grammar reads, blanks in a row as one; a Chinese character counts twice, for
it is a word."""
EXAMPLE = say("grammar.example")

# Control, surrogate, private use: never part of a sentence. Bidirectional overrides show a person
# another sentence than the one that is read.
_OVERRIDES = frozenset("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
_NO_TEXT = frozenset({"Cc", "Cs", "Co"})

MOST_CLAUSES = 30
"""Marks that end a clause; each clause is read in several ways."""
_CLAUSE_MARK = re.compile(r"[,.;:!?，。；：！？、]")


def refuse_bad_text(text: str) -> Refuse | None:
    """Return the refusal of an empty, endless or binary text, or None where it can be read."""
    if len(text) > MAX_CHARACTERS:
        return _no(Code.TEXT_TOO_LONG, length=len(text), limit=MAX_CHARACTERS)
    if not text.strip():
        return _no(Code.EMPTY_GOAL, example=EXAMPLE)
    strange = next((char for char in text if _strange(char)), None)
    if strange is not None:
        return _no(Code.BAD_TEXT, found=f"U+{ord(strange):04X}")
    if not any(char.isalnum() for char in text):
        return _no(Code.BAD_TEXT, found=text.strip()[:10])
    return None


def refuse_long_text(text: str) -> Refuse | None:
    """Return the refusal of a text that the grammar would think about too long, else None.

    Its forms are tried one after the other, some at a price that grows with the square of the
    length. A sentence that a person says at a stretch is far below; a model reads longer ones.
    """
    length = len(text) + count_chinese(text)
    if length <= MOST_READ and len(_CLAUSE_MARK.findall(text)) <= MOST_CLAUSES:
        return None
    ends = [found.end() for found in _CLAUSE_MARK.finditer(text)]
    limit = min(MOST_READ * len(text) // length, *ends[MOST_CLAUSES : MOST_CLAUSES + 1], len(text))
    return _no(Code.TEXT_TOO_LONG, length=len(text), limit=limit)


def _strange(char: str) -> bool:
    if char in "\t\n\r":
        return False
    return char in _OVERRIDES or char == "\ufffd" or unicodedata.category(char) in _NO_TEXT


def _no(code: Code, **facts: str | int | Bilingual) -> Refuse:
    return Refuse(code=code, reason=message(code, **facts))


_CJK = rf"[{CHINESE}。、]"
_CJK_GAP = re.compile(rf"(?<={_CJK})\s+|\s+(?={_CJK})")
_IN_BRACKETS = re.compile(r"\(([^()\d]+)\)")
_HYPHEN = re.compile(r"(?<=[a-z])[-_](?=[a-z])")
_CONTRACTION = re.compile(
    r"\b(?P<can>can'?t)\b|\b(?P<will>won'?t)\b|\b(?P<let>let's)\b"
    r"|\b(?P<denied>do|does|did|is|are|would|could|should|must)n'?t\b"
    r"|\b(?P<asked>what|where|who|how)'?s\b|\b(?P<there>there|here|(?:no|some|any|every)(?:body|one))'s\b"
    r"|(?<=[a-z])(?P<stands>'s) (?=(?:in|at|on|not|there|here|asleep|awake|gone|home|ready)\b)"
    r"|\b(?P<are>they|we|you)'re\b|\bi(?P<i>'d|'m)\b"
)
_WRITTEN_OUT = {
    "can": "can not",
    "will": "will not",
    "let": "let us",
    "denied": "{} not",
    "asked": "{} is",
    "there": "{} is",
    "stands": " is ",
    "are": "{} are",
}


def _write_out(found: re.Match[str]) -> str:
    kind = found.lastgroup or ""
    if kind == "i":
        return "i would" if found["i"] == "'d" else "i am"
    return _WRITTEN_OUT[kind].format(found[kind])


_QUOTES = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "「": '"', "」": '"'})


def normalise(text: str) -> str:
    """Return the sentence in one form of writing; the same words always give the same form."""
    return _normalised(text) if len(text) <= MAX_CHARACTERS else _write_plainly(text)


def _write_plainly(text: str) -> str:
    folded = fold(text).translate(_QUOTES)
    shown = "".join(char for char in folded if unicodedata.category(char) != "Cf")
    plain = _CONTRACTION.sub(_write_out, _HYPHEN.sub(" ", shown))
    whole = " ".join(_CJK_GAP.sub("", plain).split())
    inside = _IN_BRACKETS.fullmatch(whole)
    return inside[1] if inside else whole


_normalised = lru_cache(maxsize=1024)(_write_plainly)
"""A sentence's readers and the names of a site ask for the same texts again and again."""


def squash(name: str) -> str:
    """Return a name without what people write differently: spaces, hyphens, apostrophes, case."""
    return re.sub(r"[\s\-_'’\"]+", "", normalise(name))


_COMMANDS = (
    ("navigate", "drive", "return", "visit", "follow", "locate", "search", "count", "patrol",
     "inspect", "please", "describe", "rotate", "proceed", "travel", "forward", "backward",
     "degrees", "seconds", "minutes", "metres", "meters", "could", "would", "where", "escort",
     "guide", "greet", "introduce", "finally", "afterwards", "charge", "again", "there", "check")
)  # fmt: skip
_WORD = re.compile(r"(?<![a-z'])[a-z]{4,}(?![a-z'])")
_SHORTEST = 5
_ENDINGS = ("s", "d", "r", "er", "ed", "ing", "y", "ly")


def mend(text: str, known: frozenset[str]) -> str:
    """Return a normalised sentence with its words of command spelt right."""
    return _WORD.sub(lambda found: _right(found[0], known), text)


@lru_cache(maxsize=4096)
def _right(word: str, known: frozenset[str]) -> str:
    if word in known or any(word == command + end for command in _COMMANDS for end in _ENDINGS):
        return word
    near = [
        command
        for command in _COMMANDS
        if len(command) >= _SHORTEST
        and word[0] == command[0]
        and OSA.distance(word, command, score_cutoff=1) <= 1
    ]
    return near[0] if len(near) == 1 else word


def words_of(*patterns: re.Pattern[str]) -> frozenset[str]:
    """Return every word that stands in these patterns: they are spelt right."""
    found: set[str] = set()
    for pattern in patterns:
        found.update(re.findall(r"[a-z]{4,}", pattern.pattern))
        found.update(part.replace("?", "") for part in re.findall(r"[a-z?]{4,}", pattern.pattern))
    return frozenset(found)
