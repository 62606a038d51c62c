"""Read what a sentence changes about the newest order, as one closed value. Pure, both languages.

Whole sentences only, every word of them accounted for: a row of its language's table, with courtesy
at both ends and a reason behind it. Names of places stand as ``§`` while a row is tried. Which
order is meant, and whether it has such a slot, is for ``planner.plan.apply`` to say.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from planner.language.changes import chinese, english
from planner.language.folding import fold_width, fold_words, has_chinese
from planner.language.motion_guard.mentioned_names import find_places
from planner.language.numbers import angle_rad, chinese_number, metres, times
from planner.language.object_names import resolve
from planner.language.person_names import is_given_name
from planner.language.yes_no import consents
from planner.plan import Change, Edit, Vocabulary

Spot = tuple[str, int, int]
"""A place, and where its name begins and ends."""
MAX_READ = 120
"""Characters; a longer sentence is an order of its own."""
_ENDS = " ,?"
_MARKS = re.compile(r"[,.;:!…~，。；：！、](?!\d)")
_OPEN_END = re.compile(
    r"(?<!see )(?<!check )(?<!look )\b(?:if|whether)\b"
    r"|\b(?:unless|whenever|until|otherwise|or)\b|如果|要是|假如|除非|的话|否则|(?<=[^,])还是"
)
"""With these a sentence is more than one word in a conversation."""
_ASKS = frozenset({Edit.SEEN, Edit.LIKE, Edit.ALSO, Edit.AGAIN, Edit.WHERE})
_PRONOUNS = MappingProxyType(
    {"him": "he", "her": "she", "them": "they", "that": "it", "他": "he", "她": "she", "它": "it"}
)
_ANYTHING = re.compile(r"(?:any|some)thing\b.*|什么|啥|什么东西")
_ANYONE = re.compile(r"(?:any|some)(?:one|body)\b.*|人|谁")
_ARTICLE = re.compile(r"^(?:the|my|our|your|an?|some|any) ")


_Rows = tuple[tuple[Edit, re.Pattern[str], str], ...]


@lru_cache(maxsize=4)
def _rows(in_chinese: bool, with_rest: bool) -> _Rows:
    """Return the rows of a language, compiled when its first sentence comes."""
    rows = chinese.ROWS if in_chinese else english.ROWS
    return tuple(
        (act, re.compile(row), fills)
        for act, row, fills in rows
        if not with_rest or "(?P<rest" in row
    )


def read_rest(text: str) -> str | None:
    """Return the order of its own that a sentence puts after another, or in its place."""
    return next((each.rest for each in read_rows(text, (), with_rest=True)), None)


def lay_out(text: str) -> str:
    """Return a sentence as its rows are written: plain, and Chinese without spaces."""
    return fold_words("".join(text.split()) if has_chinese(text) else text).replace("’", "'")


def read_rows(text: str, spots: tuple[Spot, ...], *, with_rest: bool = False) -> tuple[Change, ...]:
    """Return what a sentence may change, by the rows of its language, the likeliest first.

    Args:
        text: as it was said.
        spots: where the sentence, as it is laid out, names places.
        with_rest: seek only what holds an order of its own, which needs no order before it.
    """
    said, in_chinese = lay_out(text), has_chinese(text)
    if not 0 < len(said) <= MAX_READ:
        return ()
    masked = list(_MARKS.sub(",", said))
    for _, start, end in spots:
        masked[start:end] = "§" * (end - start)
    bare = re.sub(r"[?](?=.*[^ ?,])", ",", "".join(masked))
    if _OPEN_END.search(bare):
        return ()
    wide = fold_width("".join(text.split()) if in_chinese else " ".join(text.split()))
    whole = _MaskedSentence(bare, wide if len(wide) == len(said) else said, spots, in_chinese)
    plain, guessed = whole.cuts()
    rows = _rows(in_chinese, with_rest)
    read = {each: each.read(rows) for each in dict.fromkeys((*plain, *guessed))}
    found = [change for each in plain for change in read[each]]
    guesses = [change for each in guessed for change in read[each] if change.act is Edit.WHERE]
    asks = bare.rstrip(" ,").endswith("?")
    says_yes_or_no = consents(text) is not None and not spots
    return tuple(
        dict.fromkeys(
            each
            for each in (*guesses, *found)
            if (not asks or each.act in _ASKS)
            and (not says_yes_or_no or each.act is Edit.OTHER_SIDE)  # "no, right!"
        )
    )


@dataclass(frozen=True, slots=True)
class _MaskedSentence:
    """Hold a sentence, or the part of it that is read, with its names masked."""

    _bare: str
    _written: str
    _spots: tuple[Spot, ...]
    _zh: bool

    def cuts(self) -> tuple[list[_MaskedSentence], list[_MaskedSentence]]:
        """Return the sentence without courtesy and reason, and without a guess's hedges, too."""
        words = chinese if self._zh else english
        lead = re.compile(rf"{words.LEAD}|[, ]+")
        tail = re.compile(rf"(?:{words.TAIL}|[,? ]+)$")
        hedged = re.compile(rf"{words.LEAD}|{words.HEDGE}[ ,]*|[, ]+")
        behind = re.compile(rf"(?:{words.TAIL}|[, ]*{words.HEDGE}|[,? ]+)$")
        reason = re.compile(rf"(?P<rest>.+?){words.REASON}")
        wholes = [self]
        if (cut := reason.fullmatch(self._bare.rstrip(_ENDS))) is not None:
            wholes.append(self._part(0, cut.end("rest")))
        plain = [part for each in wholes for part in (each.strip(lead, tail), each)]
        return plain, [each.strip(hedged, behind) for each in wholes]

    def _part(self, start: int, end: int) -> _MaskedSentence:
        spots = tuple(
            (place, first - start, last - start)
            for place, first, last in self._spots
            if start <= first and last <= end
        )
        return _MaskedSentence(self._bare[start:end], self._written[start:end], spots, self._zh)

    def strip(self, lead: re.Pattern[str], tail: re.Pattern[str]) -> _MaskedSentence:
        """Take courtesy off both ends."""
        start, end = 0, len(self._bare)
        while (found := lead.match(self._bare, start, end)) is not None and found.end() > start:
            start = found.end()
        while (found := tail.search(self._bare, start, end)) is not None and found.start() > start:
            end = found.start()
        return self._part(start, end)

    def read(self, rows: _Rows) -> list[Change]:
        """Return the rows that are this sentence, each with its slots filled."""
        said = self._bare.strip(_ENDS)
        at = self._bare.find(said)
        found = []
        for act, row, fills in rows:
            match = row.fullmatch(self._bare, at, at + len(said))
            if match is not None:
                change = self._fill(act, match, fills)
                found += [change] if change is not None else []
        return found

    def _place(self, at: int) -> str | None:
        return next((place for place, first, _ in self._spots if first == at), None)

    def _fill(self, act: Edit, match: re.Match[str], fills: str) -> Change | None:
        """Return a change with the slots of its row; None where a slot's words are none."""
        marks, _, words = fills.partition("words=")
        slots: dict[str, Any] = {"act": act} | ({"words": words} if words else {})
        for mark in marks.split():
            name, _, value = mark.partition("=")
            slots |= {"way": -1.0} if name == "back" else {name: value or True}
        for name in match.re.groupindex:
            start, end = match.span(name)
            if start < 0 or name == "unit":
                continue
            base, said = name.rstrip("0123456789"), match[name]
            if base in _PLACES:
                found: dict[str, Any] | None = {_PLACES[base]: self._place(start)}
            elif base in ("rest", "words"):
                found = {base: self._written[start:end].strip(" ,")}
            elif base == "person":
                found = {base: self._written[start:end]} if is_given_name(said) else None
            elif base == "amount":
                found = _amount(said.strip() or "a", match["unit"])
            else:
                found = _SLOTS[base](said)
            if found is None:
                return None
            slots |= found
        if slots.pop("denies", False):
            slots["denied"] = slots["place"]
        return Change(**slots)


def _thing(said: str) -> dict[str, Any] | None:
    return {"thing": _ARTICLE.sub("", said)} if resolve(said) is not None else None


def _side(said: str) -> dict[str, Any]:
    ahead = -1.0 if said in ("right", "右", "退", "后退") or said.startswith("back") else 1.0
    return {"side": ahead, "turns": said in ("left", "右", "right", "左")}


def _what_was_seen(words: str) -> dict[str, Any]:
    """Return what is asked to have been seen: a person, a thing, or anything."""
    if _ANYTHING.fullmatch(words):
        return {"words": "anything"}
    return {"words": "person" if _ANYONE.fullmatch(words) else _ARTICLE.sub("", words)}


def _amount(number: str, unit: str) -> dict[str, Any] | None:
    """Return whether an amount is an angle, and how much it is [rad or m]."""
    number = {"half an": "half"}.get(number, number)
    turned = unit.startswith(("degree", "度"))
    much = angle_rad(number, unit) if turned else metres(number, unit)
    return None if much is None else {"turns": turned, "amount": much}


_PLACES = MappingProxyType({"p": "place", "q": "denied", "i": "inner"})
_SLOTS: MappingProxyType[str, Callable[[str], dict[str, Any] | None]] = MappingProxyType(
    {
        "thing": _thing,
        "side": _side,
        "seen": _what_was_seen,
        "denied": lambda _: {"denies": True},
        "missed": lambda _: {"missed": True},
        "because": lambda _: {"tries": True},
        "times": lambda said: {"times": int(chinese_number(said) or 0) or times(said)},
        "who": lambda said: {"who": _PRONOUNS.get(said, said)},
        "kind": lambda said: {"kind": {"数": "count", "清点": "count"}.get(said, said)},
    }
)


@lru_cache(maxsize=64)
def read_changes(text: str, names: Vocabulary) -> tuple[Change, ...]:
    """Return what a sentence may change, the likeliest first; none where it changes nothing.

    Args:
        text: as it was said.
        names: of the site's places.
    """
    written = lay_out(text)
    if len(written) > MAX_READ:  # before names are sought: a text may be of any length
        return ()
    found = find_places(written, names)
    return read_rows(text, tuple((each.id, each.start, each.end) for each in found))
