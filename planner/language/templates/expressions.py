"""Parse the slot language of sentence templates.

``(a|b)`` one of them, ``[a]`` or not, ``<name>`` words that the file names once, ``{name}`` a slot
that is filled by the words of that name, ``{slot:name}`` likewise under another name, ``@kind``
what the sentence's units are found to be: a place, a person's name, an amount, free words.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import product

from planner.language.folding import CHINESE

TOKEN = re.compile(
    rf"[\ue000-\uf8ff]|[{CHINESE}]|\d+(?:\.\d+)?|[^\W\d_{CHINESE}]+(?:'[^\W\d_{CHINESE}]+)*'?|\S"
)
"""A word, a Chinese character, a number, a mark, or the one character that stands for a name."""
MOST_WORDS = 400
"""Alternatives that are written out into one set; more stay apart."""


class TemplateError(ValueError):
    """Tell what is wrong in a template, and how it is mended."""

    code = "bad_template"

    def __init__(self, problem: str, cure: str, cure_zh: str) -> None:
        super().__init__(f"{problem}; {cure}")
        self.problem, self.cure, self.cure_zh = problem, cure, cure_zh

    @property
    def told_zh(self) -> str:
        """Return the whole in Chinese; the problem names words of the file and stays as it is."""
        return f"{self.problem}；{self.cure_zh}"


@dataclass(frozen=True, slots=True, eq=False)
class LiteralWords:
    """Hold literal words, each a row of tokens, by their length; one of them stands there."""

    by_length: Mapping[int, frozenset[tuple[str, ...]]]

    def __len__(self) -> int:
        """Return how many there are."""
        return sum(map(len, self.by_length.values()))


def words_of(options: Iterable[tuple[str, ...]]) -> LiteralWords:
    """Return literal words."""
    by_length: dict[int, set[tuple[str, ...]]] = {}
    for option in options:
        by_length.setdefault(len(option), set()).add(option)
    return LiteralWords({length: frozenset(rows) for length, rows in by_length.items()})


@dataclass(frozen=True, slots=True)
class UnitKind:
    """Stand for a unit of a kind, or for one or more words that no template names."""

    kind: str
    is_free: bool = False


@dataclass(frozen=True, slots=True)
class Sequel:
    """Hold expressions that follow each other."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class OneOf:
    """Hold expressions of which one stands there; an empty row may stand for nothing."""

    options: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class SlotFilling:
    """Hold what fills a slot."""

    name: str
    filled_by: Expression


Expression = LiteralWords | UnitKind | Sequel | OneOf | SlotFilling
NOTHING = words_of([()])
UNITS = frozenset({"place", "person", "quote", "length", "angle", "duration", "times"})
_PIECE = re.compile(
    r"\s+|(?P<open>[(\[])|(?P<close>[)\]])|(?P<bar>\|)|<(?P<named>[a-z_0-9]+)>"
    r"|\{(?P<slot>[a-z_0-9]+)(?::(?P<by>[a-z_0-9]+))?\}|@(?P<unit>[a-z]+)"
    r"|(?P<text>[^\s()\[\]|<>{}@]+)"
)


@dataclass(slots=True)
class _ExpressionReader:
    text: str
    named: Mapping[str, str]
    free: frozenset[str]
    read: dict[str, Expression]
    within: tuple[str, ...] = ()
    at: int = 0

    def one_of(self, close: str) -> Expression:
        """Read alternatives up to a closing mark; at the end of the text up to there."""
        options: list[Expression] = []
        parts: list[Expression] = []
        while self.at < len(self.text):
            found = _PIECE.match(self.text, self.at)
            if found is None:
                raise self.fail(f"{self.text[self.at]!r} has no meaning here")
            self.at = found.end()
            if found["close"]:
                if found["close"] != close:
                    raise self.fail(f"{found['close']!r} closes nothing")
                return _join([*options, _row(parts)])
            if found["bar"]:
                options.append(_row(parts))
                parts = []
            elif (part := self.part(found)) is not None:
                parts.append(part)
        if close:
            raise self.fail(f"{close!r} is missing")
        return _join([*options, _row(parts)])

    def part(self, found: re.Match[str]) -> Expression | None:
        """Return the expression of one piece; None for a blank."""
        if found["open"]:
            inner = self.one_of(")" if found["open"] == "(" else "]")
            return inner if found["open"] == "(" else _join([inner, NOTHING])
        if found["named"]:
            return self.named_words(found["named"])
        if found["slot"]:
            name = found["slot"]
            return SlotFilling(name, self.named_words(found["by"] or name))
        if found["unit"]:
            kind = found["unit"]
            if kind not in UNITS | self.free:
                raise self.fail(f"@{kind} is not a kind of unit")
            return UnitKind(kind, is_free=kind in self.free)
        return words_of([tuple(TOKEN.findall(found["text"]))]) if found["text"] else None

    def named_words(self, name: str) -> Expression:
        """Return what the file calls by a name."""
        if name not in self.named or name in self.within:
            problem = "holds itself" if name in self.within else "is not named in the file"
            raise self.fail(f"<{name}> {problem}")
        if name not in self.read:
            within = (*self.within, name)
            inner = _ExpressionReader(self.named[name], self.named, self.free, self.read, within)
            self.read[name] = inner.one_of("")
        return self.read[name]

    def fail(self, problem: str) -> TemplateError:
        """Return the error of this text."""
        return TemplateError(
            f"template {self.text!r}: {problem}",
            f"names: {', '.join(sorted(self.named))}; "
            f"units: @{', @'.join(sorted(UNITS | self.free))}",
            "请检查括号是否成对,以及 <名称>、{槽位}、@单位 是否存在",
        )


def parse_expression(
    text: str, named: Mapping[str, str], free: frozenset[str], read: dict[str, Expression]
) -> Expression:
    """Return the expression of a template.

    Args:
        text: the template.
        named: the templates that ``<name>`` and ``{name}`` stand for.
        free: the kinds of words that no template names.
        read: what of `named` has been read; added to.

    Raises:
        TemplateError: it can't be read.
    """
    return _ExpressionReader(text, named, free, read).one_of("")


def _row(parts: list[Expression]) -> Expression:
    """Join parts; literal words that follow each other become one set where that is small."""
    joined: list[Expression] = []
    for part in parts:
        last = joined[-1] if joined else None
        if not isinstance(part, LiteralWords) or not isinstance(last, LiteralWords):
            joined.append(part)
        elif len(part) * len(last) <= MOST_WORDS:
            pairs = product(_options(last), _options(part))
            joined[-1] = words_of(before + after for before, after in pairs)
        else:
            joined.append(part)
    return joined[0] if len(joined) == 1 else Sequel(tuple(joined)) if joined else NOTHING


def _options(words: LiteralWords) -> list[tuple[str, ...]]:
    return [option for rows in words.by_length.values() for option in rows]


def _join(options: list[Expression]) -> Expression:
    """Return one of the options; literal ones as one set."""
    literal = [option for option in options if isinstance(option, LiteralWords)]
    rest = [option for option in options if not isinstance(option, LiteralWords)]
    both = [words_of(each for words in literal for each in _options(words))] if literal else []
    joined = (*(literal if len(literal) == 1 else both), *rest)
    return joined[0] if len(joined) == 1 else OneOf(joined)
