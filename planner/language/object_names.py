"""Turn a person's words into a class and a colour, and a detector's names into classes. Pure.

A phrase is understood as a whole or not at all: what cannot be told by sight ("the bottle of my
sister", "a man in a red shirt") is unknown, never rounded to what it resembles.
"""

from __future__ import annotations

import re
from functools import cache, lru_cache
from typing import TYPE_CHECKING, NamedTuple

from planner.language import color_names
from planner.language.catalogue import CATALOGUE, build, list_names, noun, plural, say
from planner.language.folding import CHINESE, fold, fold_words, is_chinese
from planner.language.object_classes import KINDS
from planner.plan import Bilingual, Language, say_same

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

_IRREGULAR = {
    "person": ("people", "persons"), "man": ("men",), "woman": ("women",), "child": ("children",),
    "lady": ("ladies",), "baby": ("babies",), "gentleman": ("gentlemen",), "knife": ("knives",),
    "mouse": ("mice",), "puppy": ("puppies",), "people": (), "somebody": (), "someone": (),
    "anybody": (), "anyone": (), "scissors": (), "skis": (), "sheep": (), "broccoli": (),
    "luggage": (), "teddy": ("teddies",),
}  # fmt: skip
_FILLER_EN = (
    r"(?:the|a|an|my|our|your|his|her|their|this|that|these|those|some|any|every|each|all|both|of|"
    r"one|two|three|four|five|six|seven|eight|nine|ten|\d{1,3}|another|other|more|many|nearest|"
    r"closest|next|pair|pieces?|big|small|little|large|tall|old|new|empty)"
)
_PLACED_EN = r"(?: (?:on|near|next to|beside|by|under|behind|in front of|at|inside|in) .{1,40})?"
_PLACED_PERSON_EN = _PLACED_EN.replace("|inside|in)", ")")
"""People "in red" wear it: clothes cannot be told, so such a phrase is not cut short."""
_COUNT_ZH = (
    r"(?:这|那|某|每|所有的?|全部的?|任何|一些|几|多少|半|一|二|两|三|四|五|六|七|八|九|十|\d{1,3}(?!\d)|"
    r"我们的|我的|你的|您的|他的|她的|家里的|最近的|附近的|另外?|其他|其它|别的|大的?|小的?|"
    r"个|只|张|把|台|瓶|杯|本|盆|棵|株|扇|位|名|条|件|罐|支|双|辆|架|块|面|口|盏|头|匹|颗|副|部|间|些|款)"
)
_PLACED_ZH = r"(?:.{1,12}(?:上面?|里面?|里|旁边|边上|下面?|底下|附近|前面|后面|中间|那边|这边)的)?"
_WHICH_EN = re.compile(
    r"\b(?:another|other|next|big|small|little|large|tall|old|new|empty)\b"
    r"|\b(?:on|near|beside|by|under|behind|in front of|at|inside|in) "
)
_WHICH_ZH = re.compile(
    r"另|其他|其它|别的|大|小|(?:上面?|里面?|旁边|边上|下面?|底下|前面|后面|中间|那边|这边)的"
)
_ANY_ZH = re.compile(r"家里的|附近的|最近的")
_WORD = re.compile(r"[a-z0-9'-]+")
_RUN_ZH = re.compile(rf"[{CHINESE}]+")
LONGEST_EN, LONGEST_ZH = 3, 8
MAX_READ = 120
"""Characters of a question: each piece is looked up, on the event loop."""


class OwnKind(NamedTuple):
    """Name a class that is in no table, or to which the owner gave names of their own."""

    id: str
    english: tuple[str, ...]
    chinese: tuple[str, ...]

    @property
    def words(self) -> tuple[str, ...]:
        """Return all its names, in either language."""
        return (*self.english, *self.chinese)


class OwnersNames:
    """Hold the names that the owner's detector file gives its classes.

    They come with the detector, long after the start, and hold for the whole process, as the
    catalogue does.
    """

    def __init__(self) -> None:
        self.words: Mapping[str, tuple[str, ...]] = {}

    def of(self, label: str) -> OwnKind:
        """Return the names of a class; of one without any in a language, those of the other."""
        given = self.words.get(label, ())
        english = tuple(_plain(name) for name in given if not _HAN.search(name))
        chinese = tuple(_plain(name) for name in given if _HAN.search(name))
        return OwnKind(label, english or (label.replace("_", " "),), chinese)


OWNERS = OwnersNames()
_HAN = re.compile(rf"[{CHINESE}]")


def name_kinds(words: Mapping[str, Sequence[str]]) -> None:
    """Take the owner's names of classes, by id, in place of all before."""
    OWNERS.words = {label: tuple(names) for label, names in words.items() if names}


def canonical(name: str) -> str:
    """Return the class id of a detector's own name: "Dining Table", "tvmonitor", "couch"."""
    words = " ".join(re.split(r"[\s_\-]+", fold(name))).strip()
    found = _english_names().get(words) or _chinese_names().get(words)
    return found or re.sub(r"[^\w]+", "_", words)[:64].strip("_") or "thing"


def resolve(
    words: str, language: Language | None = None, classes: Collection[str] = ()
) -> tuple[str, str | None] | None:
    """Return the class and the colour that words mean: "red cup", "红色的杯子", "two mugs".

    Args:
        words: a plan's ``object``, in the person's own words.
        language: read first; the other one is tried after it.
        classes: what the detector can find. Where given, anything else means nothing; a name of its
            own that is in no table is understood as it is written.
    """
    readers = (_in_chinese, _in_english)
    for read in readers if language is Language.ZH else reversed(readers):
        found = read(_plain(words), _own_names(classes))
        if found is not None and (not classes or found[0] in classes):
            return found
    return None


def first_named(text: str, classes: Collection[str]) -> tuple[str, str | None] | None:
    """Return the class and colour that a whole sentence names, by the longest name that fits."""
    for words in _pieces(fold(text[:MAX_READ])):
        found = resolve(words, None, classes)
        if found is not None:
            return found
    return None


def _pieces(text: str) -> Iterable[str]:
    """Yield the runs of words of a sentence that may be a name, the longest first."""
    for run in _RUN_ZH.findall(text):
        for length in range(min(LONGEST_ZH, len(run)), 0, -1):
            yield from (run[at : at + length] for at in range(len(run) - length + 1))
    words = _WORD.findall(text)
    for length in range(LONGEST_EN, 0, -1):
        yield from (" ".join(words[at : at + length]) for at in range(len(words) - length + 1))


def prepare(classes: Collection[str]) -> None:
    """Make what reads words in these classes. Takes long once: call it off the event loop."""
    own = _own_names(classes)
    _english_patterns(own)
    _chinese_pattern(own)


def singles_out(words: str, classes: Collection[str] = ()) -> bool:
    """Tell whether words say which one is meant by more than its kind and colour.

    Size, age and where it stands beside other things are not seen here: "the small cup", "the other
    person", "窗边的椅子" mean one among several, and what resolves is any of them.
    """
    text, own = _plain(words), _own_names(classes)
    found = _english_match(text, own)
    if found is not None:
        return _WHICH_EN.search(_besides(found)) is not None
    found = _chinese_match(text, own)
    return found is not None and _WHICH_ZH.search(_ANY_ZH.sub("", _besides(found))) is not None


def name_object(label: str, color: str | None = None) -> Bilingual:
    """Return a thing's name, with its colour where one is given."""
    name = noun(f"noun.{label}") if label in KINDS else _own_name(label)
    return _with_color(name, told_color(label, color))


def tell_words(words: str) -> Bilingual:
    """Return a plan's words for a thing: as they are in their own language, named in the other."""
    found = resolve(words)
    if found is None or singles_out(words):
        return say_same(words)
    named, spoken = name_object(*found), Language.ZH if is_chinese(words) else Language.EN
    return build(lambda language: words if language == spoken else named.of(language))


def told_color(label: str, color: str | None) -> str | None:
    """Return the colour that a thing is told with; a person's is of clothes, and is not told."""
    return None if label == "person" else color


def named_several(label: str, color: str | None = None) -> Bilingual:
    """Return what to call several of a thing."""
    if label in KINDS:
        return _with_color(plural(f"noun.{label}"), told_color(label, color))
    name = _own_name(label)
    *first, last = name.en.split(" ")
    return _with_color(Bilingual(en=" ".join((*first, _regular_plural(last))), zh=name.zh), color)


def _own_name(label: str) -> Bilingual:
    """Return the name of a class that is in no table: the owner's, else the detector's own."""
    kind = OWNERS.of(label)
    return Bilingual(en=kind.english[0], zh=(kind.chinese or kind.english)[0])


def synonyms(label: str, language: Language) -> tuple[str, ...]:
    """Return the words that mean a class: the one that is said, then the others."""
    kind = OWNERS.of(label)
    own = kind.chinese if language is Language.ZH else kind.english
    if label not in KINDS:
        return own or kind.english
    given = own if label in OWNERS.words else ()
    return tuple(dict.fromkeys((*_catalogue_words(label, language), *given)))


def known_words(classes: Collection[str]) -> frozenset[str]:
    """Return people's names for these classes, in both languages."""
    return _known_words(tuple(classes), _own_names(classes))


@lru_cache(maxsize=8)
def _known_words(classes: tuple[str, ...], own: Own) -> frozenset[str]:
    given = (word for kind in own for word in kind.words)
    tables = (
        word
        for label in classes
        if label in KINDS
        for language in Language
        for word in _catalogue_words(label, language)
    )
    return frozenset((*given, *tables))


def _catalogue_words(label: str, language: Language) -> tuple[str, ...]:
    return CATALOGUE.synonyms(f"noun.{label}", language)


def _with_color(name: Bilingual, color: str | None) -> Bilingual:
    if color is None:
        return name
    return say("object.colored", color=color_names.color_name(color), kind=name)


def list_kinds(labels: Iterable[str], limit: int = 20) -> Bilingual:
    """Return class names for a sentence: "person, chair and sofa"."""
    known = list(labels)
    more = len(known) - limit
    names = list_names(map(name_object, known[:limit]))
    names = names if names.en else say("object.none")
    return say("object.and_more", names=names, more=more) if more > 0 else names


def _plain(words: str) -> str:
    return fold_words(words).strip(" .,!?，。！？")


Own = tuple[OwnKind, ...]


def _in_english(text: str, own: Own) -> tuple[str, str | None] | None:
    found = _english_match(text, own)
    return None if found is None else _read_match(found, _english_names(), own)


def _in_chinese(text: str, own: Own) -> tuple[str, str | None] | None:
    found = _chinese_match(text, own)
    return None if found is None else _read_match(found, _chinese_names(), own)


def _english_match(text: str, own: Own) -> re.Match[str] | None:
    plain = re.sub(r"[-_]", " ", text)
    matches = (pattern.fullmatch(plain) for pattern in _english_patterns(own))
    return next((found for found in matches if found is not None), None)


def _chinese_match(text: str, own: Own) -> re.Match[str] | None:
    return _chinese_pattern(own).fullmatch(text.replace(" ", ""))


def _besides(found: re.Match[str]) -> str:
    """Return the words of a phrase besides the thing's name and colour."""
    rest = found.string
    for start, end in sorted((found.span(g) for g in "cdn"), reverse=True):
        rest = rest[:start] + " " + rest[end:] if start >= 0 else rest
    return rest


def _read_match(found: re.Match[str], names: dict[str, str], own: Own) -> tuple[str, str | None]:
    color, name = found["c"] or found["d"], found["n"]
    label = _own_words(own).get(name) or names.get(name) or canonical(name)
    return label, color_names.color_of(color) if color else None


@lru_cache(maxsize=8)
def _own_words(own: Own) -> dict[str, str]:
    """Return the class of each name that the owner gave, with its blanks and without."""
    words = [(word, kind.id) for kind in own for word in kind.words]
    return {spelt: id_ for word, id_ in words for spelt in (word, word.replace(" ", ""))}


@lru_cache(maxsize=8)
def _english_patterns(own: Own) -> tuple[re.Pattern[str], ...]:
    """Return the patterns of things and of people, which differ in their following words."""
    people = [w for w, label in _english_names().items() if label == "person"]
    things = [w for w, label in _english_names().items() if label != "person"]
    own_words = [re.escape(word) for word in _by_length(w for kind in own for w in kind.english)]
    return tuple(
        re.compile(
            rf"(?:{_FILLER_EN} )*(?:(?P<c>{color_names.ENGLISH}) )?(?:{_FILLER_EN} )*"
            rf"(?P<n>{'|'.join(_by_length(names))})"
            rf"(?: (?:that|which) (?:is|are) (?P<d>{color_names.ENGLISH}))?{placed}"
        )
        for names, placed in (((*things, *own_words), _PLACED_EN), (people, _PLACED_PERSON_EN))
    )


@lru_cache(maxsize=8)
def _chinese_pattern(own: Own) -> re.Pattern[str]:
    given = [re.escape(word.replace(" ", "")) for kind in own for word in (kind.id, *kind.words)]
    names = "|".join(_by_length((*_chinese_names(), *given)))
    return re.compile(
        rf"{_PLACED_ZH}{_COUNT_ZH}*(?:(?P<c>{color_names.CHINESE})的?)?{_COUNT_ZH}*"
        rf"(?P<n>{names})(?:们|儿)?(?:是(?P<d>{color_names.CHINESE})的)?"
    )


def _own_names(classes: Collection[str]) -> Own:
    """Return the classes that the tables don't tell all of."""
    return tuple(OWNERS.of(n) for n in classes if n not in KINDS or n in OWNERS.words)


def _by_length(names: Iterable[str]) -> list[str]:
    return sorted(names, key=len, reverse=True)


@cache
def _english_names() -> dict[str, str]:
    """Return every English word of every class, plurals too."""
    return {word: label for label in KINDS for word in _forms(label)}


@cache
def _chinese_names() -> dict[str, str]:
    return {word: label for label in KINDS for word in _catalogue_words(label, Language.ZH)}


def _forms(label: str) -> Iterable[str]:
    for word in (label.replace("_", " "), *_catalogue_words(label, Language.EN)):
        yield word
        *first, last = word.split(" ")
        for many in _IRREGULAR.get(last, (_regular_plural(last),)):
            yield " ".join((*first, many))


def _regular_plural(word: str) -> str:
    return f"{word}es" if word.endswith(("s", "x", "ch", "sh")) else f"{word}s"
