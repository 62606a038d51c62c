"""Tell an order to stop from every other sentence, before any model is asked.

Pure, and needs the standard library alone, so that `pons say` and the API can use it at once. Two
readings, one after the other:

- ``ORDER``: the whole first clause orders a stop ("please stop", 停下, "stop looking for the
  cup"), whatever the robot does. "cancel", "abort" and "pause" standing alone count: the person
  wants the motion to end, and a stop does that.
- ``POSSIBLE``: a stop word stands somewhere and does not clearly mean something else. While
  anything moves, is about to move or waits, such a sentence stops the robot first and is thought
  about after. Clear other meanings are things of that name ("bus stop", 停车位), denied stops
  ("don't stop", 别停), words to be said or told of others, questions about stops, and plans that
  end with standing somewhere ("go to the kitchen and stop there", 停在厨房). Denials, waiting and
  the like ("don't come closer", "stay there", 等等) count only where the sentence does not begin
  as an order to do something else; warnings (小心) only where no clause of it does.

In doubt it is a stop: a needless one costs a "continue", a missed one somebody's foot.
"""

from __future__ import annotations

import re
import unicodedata
from enum import Enum
from types import ModuleType

from planner.language.folding import fold, has_chinese, unmask
from planner.language.stop import en, zh
from planner.language.stop import en_orders as orders

MAX_READ = 400
"""Characters read at the beginning, and as many at the end: the lane's time is bounded."""


class StopReading(Enum):
    """Name a sentence's meaning for a stop."""

    ORDER = "order"
    POSSIBLE = "possible"
    NONE = "none"


MOST_CALLED = 6
"""Words, or Chinese characters, behind the robot's name: "robot, will you please just stop"."""
_MOST_CUTS = 12
_JOIN = re.compile(r"[.,;:!?，。；！？…~]+ ?| and then | and | then | but |然后|接着")
_AND = " and "
_THING = re.compile(r"(?:the|an?|my|your|his|her|our|their|this|that|those|all|any) |\S+$")
"""Behind "and" it is one more of what is to be stopped: "stop looking for the cup and the ball"."""
"""Between the clauses of a sentence."""
_LEADS = re.compile(r"^(?:(?:and|then|but|so) |然后|接着|再|并)+")
_FIRST = re.compile(r"\S+\s*")
_MARKS = " ,.!:;~…。、"
_HELPERS = (
    "do",
    "did",
    "does",
    "would",
    "should",
    "could",
    "must",
    "need",
    "is",
    "are",
    "has",
    "have",
    "was",
)
_WHOLE = {
    **{f"{verb}{mark}": f"{verb} not" for verb in _HELPERS for mark in ("n't", "nt")},
    **dict.fromkeys(("can't", "cant", "cannot"), "can not"),
    **dict.fromkeys(("won't", "wont"), "will not"),
    **dict.fromkeys(("let's", "lets"), "let us"),
    **{f"{who}'s": f"{who} is" for who in ("that", "it", "he", "she", "there", "what", "who")},
    **{f"{who}s": f"{who} is" for who in ("that", "there", "what")},
    **{f"{who}'re": f"{who} are" for who in ("you", "they", "we")},
    **{f"{who}'ll": f"{who} will" for who in ("you", "i", "it", "he", "she", "they", "we")},
    **dict.fromkeys(("i'm", "im"), "i am"),
    **dict.fromkeys(("dinnae", "dinna", "didnae"), "do not"),
    "cannae": "can not",
    "haud": "hold",
    "u": "you",
}
"""Contractions, with and without their mark, and the words that they stand for."""
_TOKEN = re.compile(r"[a-z]+(?:'[a-z]+)?")
_CLAUSE_END = re.compile(r"[.,;:!?。、…~\n\r\t]+|[—–]+|\s-+\s")
_WRAPPERS = frozenset('"“”‘«»「」『』()[]<>*_#`^')
_GAP = re.compile(r"[^a-z0-9]+")
_SPELT = re.compile(r"s[\W_]*t[\W_]*o[\W_]*p[\W_]*")
_SIGNS = str.maketrans(
    {"🛑": " stop ", "✋": " stop ", "⛔": " stop ", "🤚": " stop ", "’": "'", "´": "'", "`": "'"}
)
_WORD = re.compile(r"[a-z]+")
_STUTTER = re.compile(r"\b([a-z]{1,3})-+\s*(?=\1)")
_PIECE = re.compile(r"[a-z0-9']+|[^a-z0-9'\s]+")
_NOISE = re.compile(r"\b(?:u+h+m*|u+m+|e+r+m*|a+h+|h+m+|like|well|um|eh)\b[ ,]*")
_LETTERS = re.compile(r"\bs[\W_]+t[\W_]+o[\W_]+p\b")
_HYPHEN = re.compile(r"(?<=\w)-(?=\w)")
_GAP_ZH = re.compile(r"(?<![a-z0-9'])\s+|\s+(?![a-z0-9'])")
_LATIN = re.compile(r"[a-z0-9']+|[,.!?;]")
_DASHES = re.compile(r"[-—–]+")
_MARKS_ZH = re.compile(r"[.;:。、…~\n?]+")
_NOISE_ZH = re.compile(r"[呃嗯额]+|(?:那个|这个)(?=[,…。]|呃|嗯|$)")


def read_stop(text: str) -> StopReading:
    """Return a sentence's meaning for a stop, in English or Chinese or both."""
    head = _see(text[:MAX_READ])
    if _is_order(head):
        return StopReading.ORDER
    pieces = [head]
    if len(text) > MAX_READ:
        pieces = [head, _see(text[MAX_READ:][-MAX_READ:])]
    possible = any(map(_may_mean_stop, pieces))
    return StopReading.POSSIBLE if possible else StopReading.NONE


def is_stop(text: str) -> bool:
    """Return whether the whole first clause of a sentence orders a stop."""
    return _is_order(_see(text[:MAX_READ]))


def words_behind_stop(text: str) -> str:
    """Return what a sentence that stops says behind its stop, in the same breath; empty: nothing.

    "Stop following me, go to the kitchen" holds an order that a person may still want. What may
    itself mean a stop is none, nor are thanks.
    """
    plain = " ".join(text[:MAX_READ].split())
    for cut in list(_JOIN.finditer(plain))[:_MOST_CUTS]:
        head = plain[: cut.start()]
        rest = _LEADS.sub("", plain[cut.end() :]).strip(_MARKS + "，！")
        goes_on = cut[0] == _AND and head.count(" ") > 1 and _THING.match(rest)
        if rest and not goes_on and not _is_courtesy(rest):
            stops = read_stop(head) is not StopReading.NONE
            if stops and read_stop(rest) is StopReading.NONE:
                return rest
    return ""


def _is_courtesy(words: str) -> bool:
    plain = " ".join(_GAP.sub(" ", words.lower()).split()) if words.isascii() else words
    pattern = orders.ONLY_COURTESY if words.isascii() else zh.ONLY_COURTESY
    return pattern.fullmatch(plain) is not None


def calls_stop(text: str) -> bool:
    """Return whether speech that runs on calls the robot and tells it to stop, anywhere in it.

    "And then I told him, robot, stop right there": a recogniser writes no commas, and the end of
    the speech is not waited for. Somebody else's robot is no call: "tell the robot stop".
    """
    seen = _see(text[-MAX_READ:])
    for called in (*orders.CALL.finditer(seen), *zh.CALL.finditer(seen)):
        rest = seen[called.end() :].lstrip(_MARKS)
        pieces = list(rest) if has_chinese(rest[:MOST_CALLED]) else _FIRST.findall(rest)
        beginnings = ("".join(pieces[: most + 1]) for most in range(min(len(pieces), MOST_CALLED)))
        if any(map(_is_order, beginnings)):
            return True
    return False


def _see(text: str) -> str:
    """Return the text as a person sees it: folded, nothing unseen, signs and "don't" as words."""
    plain = unmask(fold(text).replace("стоп", " stop ").translate(_SIGNS))
    return _TOKEN.sub(_expand, plain)


def _expand(found: re.Match[str]) -> str:
    return _WHOLE.get(found[0], found[0])


def _is_order(seen: str) -> bool:
    if _SPELT.fullmatch(seen.strip()):  # "s t o p", "S.T.O.P."
        return True
    plain = "".join(map(_drop_mark, seen)) if not seen.isalnum() else seen
    for clause in _CLAUSE_END.split(plain):
        if has_chinese(clause):
            compact = "".join(clause.split())
            if not zh.ONLY_COURTESY.fullmatch(compact):
                return bool(zh.ORDER.fullmatch(compact) or zh.QUIT.fullmatch(compact))
        else:
            words = " ".join(_GAP.sub(" ", clause).split()) if clause.isascii() else clause
            if words and not orders.ONLY_COURTESY.fullmatch(words):
                return bool(orders.ORDER.fullmatch(words) or orders.QUIT.fullmatch(words))
    return False


def _drop_mark(char: str) -> str:
    """Return a space for a wrapper or a symbol, else the character."""
    if char.isalnum():
        return char
    symbol = not char.isascii() and unicodedata.category(char) in {"So", "Sk"}
    return " " if symbol or char in _WRAPPERS else char


def _may_mean_stop(seen: str) -> bool:
    return _in_chinese(seen) if has_chinese(seen) or "ㄊ" in seen else _in_english(seen)


def _in_english(plain: str) -> bool:
    words = _mend(_clauses(_STUTTER.sub("", plain)))
    words = " ".join(_NOISE.sub("", words).split()).removeprefix(", ")
    left = words
    if en.STRONG.search(words):
        if en.ENDS_IN.search(words):
            return False
        left = en.ELSE.sub(" _ ", words)
        if en.STRONG.search(left):
            return True
    if _LETTERS.search(plain):
        return True
    if orders.REFUSES.fullmatch(left):
        return True
    return _means_stop_weakly(en, left, denies=not en.DENIAL_WORDS.isdisjoint(left.split()))


def _in_chinese(plain: str) -> bool:
    compact = _DASHES.sub("", _NOISE_ZH.sub("", _GAP_ZH.sub("", plain)))
    compact = _MARKS_ZH.sub(",", compact)
    for pattern, said in zh.SOUNDS:
        compact = pattern.sub(said, compact)
    left = compact = compact.strip(",")
    if zh.ALONE.search(compact):
        return True
    if zh.STRONG.search(compact):
        if zh.LATER.search(compact):
            return False
        left = zh.ELSE.sub("_", compact)
        if zh.STRONG.search(left):
            return True
    if zh.REFUSES.fullmatch(left):
        return True
    latin = _LATIN.findall(left) if _WORD.search(left) else ()
    return bool(latin and _in_english(" ".join(latin))) or _means_stop_weakly(zh, left)


def _means_stop_weakly(language: ModuleType, left: str, *, denies: bool = True) -> bool:
    """Return whether words that stop only in some company stand in theirs."""
    if language.PLAN.search(left):
        return False
    if denies and language.DENIAL.search(left):
        return True
    return bool(language.SOFT.search(left)) and not language.PLAN_WITHIN.search(left)


def _clauses(plain: str) -> str:
    """Return words with single spaces, and one comma for each run of marks between them."""
    plain = _HYPHEN.sub(" ", plain)
    parts = (p if p[0].isalnum() or p[0] == "'" else "," for p in _PIECE.findall(plain))
    return re.sub(r"(?: ,)+", " ,", " ".join(parts)).replace("'", "").strip(" ,")


def _mend(words: str) -> str:
    """Return the words with every stop word that has one wrong letter spelt right."""
    mended = _WORD.sub(lambda found: _SPELLINGS.get(found[0], found[0]), words)
    rest = [w for w in mended.replace(",", " ").split() if not orders.ONLY_COURTESY.fullmatch(w)]
    if len(set(rest)) == 1 and rest[0] in orders.ALONE:
        return _WORD.sub(lambda found: orders.ALONE.get(found[0], found[0]), mended)
    return mended


def _spellings() -> dict[str, str]:
    """Return every spelling with one letter wrong, missing, doubled or swapped, with its word."""
    letters = "abcdefghijklmnopqrstuvwxyz"
    found: dict[str, str] = {}
    for word in orders.MENDED:
        cuts = [(word[:i], word[i:]) for i in range(len(word) + 1)]
        near = {a + b[1:] for a, b in cuts if b} | {a + c + b for a, b in cuts for c in letters}
        near |= {a + c + b[1:] for a, b in cuts if b for c in letters}
        near |= {a + b[1] + b[0] + b[2:] for a, b in cuts if len(b) > 1}
        for spelling in near - orders.OTHER_WORDS - set(orders.MENDED):
            found.setdefault(spelling, word)
    return found


_SPELLINGS = _spellings()
"""Made at the import, so that no sentence waits for it."""
