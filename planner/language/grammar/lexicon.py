"""Find names in a sentence: of places, exactly or by a typo that can mean nothing else; of people.

Names found exactly are replaced by one private character each, so that a grammar can treat "the
dining table" as one word. Spaces and hyphens inside a name do not matter; its borders do.
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass
from functools import lru_cache

from rapidfuzz import process
from rapidfuzz.distance import OSA
from rapidfuzz.fuzz import ratio

from planner.language import person_names
from planner.language.grammar.sentence_text import squash
from planner.plan import Bilingual, Entry, Vocabulary

FIRST_MARK = 0xE000
MARKS = 2048  # no sentence of readable length names more places
MARK = rf"[{chr(FIRST_MARK)}-{chr(FIRST_MARK + MARKS - 1)}]"

FIRST_NAME = 0xE900
NAMES = 256
NAME = rf"[{chr(FIRST_NAME)}-{chr(FIRST_NAME + NAMES - 1)}]"
"""What stands for a person's name."""
_MARKS_SAID = re.compile(f"{MARK}|{NAME}")
"""A person's own text may hold them, and they name nothing there."""

# "home" is a step of its own (return_home), whatever a site calls its home.
_RESERVED = frozenset({"home", "base", "家", "here", "there", "it", "back"})
_PIECE = re.compile(r"[a-z0-9']+|\S")
_OTHER_WORDS = re.compile(r"(?<=起)床|(?<=赖)床")
"""A place's name within a word of its own: 起床 goes to no bed."""
_TYPO_LETTERS = 6  # shorter words have too many neighbours that are words: desk/deck, couch/coach
KEPT_NAMES = 64
"""Unknown names of the newest sentence: it is read up to sixteen times over."""
_NEAR = 66.0  # of 100; below it two names only share letters
_TYPO_ROOM = 3  # no other place may be this near


_DOOR_NAME = re.compile(r".+ door|[^门]+门")
_DOOR = re.compile(
    r"(?<=\b(?:the|our) )door\b(?! (?:of|to|from|in|into|between|bell|handle|mat|frame)\b|')"
    r"|(?<=[看查检]一下|[看查瞧瞅]一眼)门(?=$|[,。?!;]|[有是关开锁好没了])"
    r"|(?<=检查|查看|看看|瞧瞧|瞅瞅)门(?=$|[,。?!;]|[有是关开锁好没了])"
    r"|(?<=[去到在])门(?=那[儿边里]?)"
)
"""The door that nobody says more of: no room's, no cupboard's."""
_MOVES_DOOR = re.compile(
    r"\b(?:close|shut|open|lock|unlock|bolt|slam|answer|hold|knock on|bang on|push|pull|ram|hit"
    r"|kick|paint|clean|fix|repair|get|through|out of|behind|under) (?:the|our) $"
)
"""Said before it, the door is what something is done to, not where."""


@dataclass(frozen=True, slots=True)
class Mention:
    """Remember which places a marked name can mean, and how it was written."""

    ids: tuple[str, ...]
    written: str


@dataclass(frozen=True, slots=True)
class MarkedText:
    """Hold a sentence whose place names are private characters, and the names behind them."""

    text: str
    mentions: tuple[Mention, ...]
    people: tuple[str, ...] = ()  # names of persons, marked by FIRST_NAME and up

    def mention(self, mark: str) -> Mention:
        """Return the mention that a private character stands for."""
        return self.mentions[ord(mark) - FIRST_MARK]

    def restore(self, part: str) -> str:
        """Write a part of the sentence with its names again."""
        named = re.sub(MARK, lambda found: self.mention(found[0]).written, part).strip()
        return re.sub(NAME, lambda found: self.people[ord(found[0]) - FIRST_NAME], named)


class Lexicon:
    """Know every spelling of every place of one vocabulary."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        ids: dict[str, list[str]] = defaultdict(list)
        spaced: dict[str, str] = {}
        for entry in vocabulary.entries:
            for spelling in entry.spellings:
                key = squash(spelling)
                if key and key not in _RESERVED and entry.id not in ids[key]:
                    ids[key].append(entry.id)
                    spaced.setdefault(key, " ".join(spelling.casefold().split()))
        self._ids = {key: tuple(found) for key, found in ids.items() if found}
        self._spaced = spaced
        self._longest = max(map(len, self._ids), default=0)
        doors = {
            entry.id
            for entry in vocabulary.entries
            if any(_DOOR_NAME.fullmatch(spelling.casefold()) for spelling in entry.spellings)
        }
        self._only_door = doors.pop() if len(doors) == 1 else None
        self.near = lru_cache(maxsize=KEPT_NAMES)(self._near)
        """Return the places whose names look most like an unknown one, for a person to choose."""

    def mark(self, text: str) -> MarkedText:
        """Replace each place name of a normalised sentence, the longest first."""
        text = _MARKS_SAID.sub("\ufffd", text)
        pieces = [(found.start(), found.end()) for found in _PIECE.finditer(text)]
        out: list[str] = []
        mentions: list[Mention] = []
        at, copied = 0, 0
        while at < len(pieces):
            after = at if _OTHER_WORDS.match(text, pieces[at][0]) else self._match(text, pieces, at)
            if after > at and len(mentions) < MARKS:
                start, end = pieces[at][0], pieces[after - 1][1]
                key = _join(text, pieces, at, after)
                out += (text[copied:start], chr(FIRST_MARK + len(mentions)))
                mentions.append(Mention(self._ids[key], text[start:end]))
                copied = end
            at = max(after, at + 1)
        marked = "".join(out) + text[copied:]
        if self._only_door is not None and len(mentions) < MARKS:
            marked = _DOOR.sub(lambda found: self._mark_door(found, mentions), marked)
        return MarkedText(marked, tuple(mentions))

    def _mark_door(self, found: re.Match[str], mentions: list[Mention]) -> str:
        """Return the mark of the only place that is a door, for "the door"."""
        before = found.string[: found.start()]
        if self._only_door is None or _MOVES_DOOR.search(before) or len(mentions) >= MARKS:
            return found[0]
        mentions.append(Mention((self._only_door,), found[0]))
        return chr(FIRST_MARK + len(mentions) - 1)

    def _match(self, text: str, pieces: list[tuple[int, int]], at: int) -> int:
        """Return the piece after the longest name that starts here, or `at` where none does."""
        best, key = at, ""
        for after in range(at, len(pieces)):
            key += text[slice(*pieces[after])].replace("'", "")
            if len(key) > self._longest:
                break
            if key in self._ids:
                best = after + 1
        return best

    def typo(self, name: str) -> str | None:
        """Return the one place that a misspelt name can mean, or None where in any doubt.

        One letter wrong, missing, doubled or swapped, inside a word of six letters or more, and no
        other place within three: "kitchn" is the kitchen; "dining room" is no living room, and
        "bedroom 2" no bedroom 1.
        """
        key = squash(name)
        if len(key) > self._longest + 1 or not key.isascii() or not key.isalpha():
            return None
        close = process.extract_iter(
            key, self._ids.keys(), scorer=OSA.distance, score_cutoff=_TYPO_ROOM
        )
        near = {place for spelling, _, _ in close for place in self._ids[spelling]}
        if len(near) != 1:  # of nearly every word of a sentence
            return None
        (only,) = near
        spellings = (spelling for spelling, places in self._ids.items() if only in places)
        slips = any(_one_slip(name, self._spaced[spelling]) for spelling in spellings)
        return only if slips else None

    def own_name(self, entry: Entry) -> Bilingual:
        """Return a place's name, or its id in words where another place has the same name."""
        words = entry.id.replace("_", " ")
        en, zh = entry.name.en, entry.name.zh
        if self._only(en) and self._only(zh):
            return entry.name
        return Bilingual(en=en if self._only(en) else words, zh=zh if self._only(zh) else words)

    def _only(self, name: str) -> bool:
        return len(self._ids.get(squash(name), ())) == 1

    def _near(self, name: str, limit: int = 3) -> tuple[str, ...]:
        key = squash(name[:80])
        scored: dict[str, float] = {}
        letters = set(key)
        alike = process.extract_iter(key, self._ids.keys(), scorer=ratio, score_cutoff=_NEAR)
        close = {spelling: score for spelling, score, _ in alike}
        for spelling, places in self._ids.items():
            # One character of two is already near in Chinese.
            shares = not spelling.isascii() and not letters.isdisjoint(spelling)
            score = max(close.get(spelling, 0.0), _NEAR if shares else 0.0)
            if score:
                for place in places:
                    scored[place] = max(score, scored.get(place, 0.0))
        return tuple(sorted(scored, key=lambda place: -scored[place])[:limit])


def _join(text: str, pieces: list[tuple[int, int]], at: int, after: int) -> str:
    return "".join(text[slice(*piece)] for piece in pieces[at:after]).replace("'", "")


def _one_slip(written: str, name: str) -> bool:
    """Tell whether exactly one inner letter of one long word is wrong."""
    ours, theirs = written.split(), name.split()
    if len(ours) != len(theirs):
        ours, theirs = ["".join(ours)], ["".join(theirs)]
    wrong = [(a, b) for a, b in zip(ours, theirs, strict=True) if a != b]
    if len(wrong) != 1:
        return False
    (a, b) = wrong[0]
    same_ends = a[0] == b[0] and a[-1] == b[-1]
    return len(b) >= _TYPO_LETTERS and same_ends and OSA.distance(a, b) == 1


@lru_cache(maxsize=16)
def _build(vocabulary: Vocabulary) -> Lexicon:
    return Lexicon(vocabulary)


_KEPT: dict[int, tuple[Vocabulary, Lexicon]] = {}
"""By identity: comparing two vocabularies costs more than reading a sentence."""


def lexicon_of(vocabulary: Vocabulary) -> Lexicon:
    """Return the lexicon of a vocabulary, built once."""
    kept = _KEPT.get(id(vocabulary))
    if kept is not None and kept[0] is vocabulary:
        return kept[1]
    lexicon = _build(vocabulary)
    if len(_KEPT) >= 16:
        _KEPT.clear()
    _KEPT[id(vocabulary)] = (vocabulary, lexicon)
    return lexicon


def mark_people(marked: MarkedText, original: str) -> MarkedText:
    """Replace each name of a person by one private character; places are marked already."""
    written: list[str] = []

    def set_aside(found: re.Match[str]) -> str:
        if len(written) >= NAMES:
            return found[0]
        written.append(person_names.write_name(found[0]))
        return chr(FIRST_NAME + len(written) - 1)

    text = person_names.replace_names(marked.text, original, set_aside)
    return MarkedText(text, marked.mentions, tuple(written))


def person_named(words: str, original: str) -> str | None:
    """Return a person's name as it is written, where words of a sentence are nothing else."""
    marked = mark_people(MarkedText(words, ()), original)
    return marked.people[0] if re.fullmatch(NAME, marked.text) else None
