"""Match units against many templates at once, from left to right, in one pass.

Each template is an automaton without empty moves (Glushkov 1961): a row of arcs, each with those
that may follow it. An arc consumes at least one unit, so a sentence of n units is matched in at
most n rounds over the arcs, whatever it repeats. Of several ways through one template the one with
the fewest free words is kept.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from planner.language.templates.expressions import (
    Expression,
    LiteralWords,
    OneOf,
    Sequel,
    SlotFilling,
    UnitKind,
)

Span = tuple[int, int]


@dataclass(slots=True)
class Arc:
    """Hold what one step through a template consumes, and what may come next."""

    template: int
    slots: tuple[str, ...]
    words: tuple[tuple[int, frozenset[tuple[str, ...]]], ...] = ()
    """By their length."""
    kind: str = ""
    weight: float = 0.0
    """Zero for words that a template names."""
    follow: list[int] = field(default_factory=list)
    is_last: bool = False


@dataclass(frozen=True, slots=True)
class Units:
    """Hold a clause's units: its tokens, and what stands from one to another of them."""

    tokens: tuple[str, ...]
    ends: Mapping[str, Mapping[int, tuple[int, ...]]]
    """By kind and begin: where units of that kind end."""
    free: Mapping[str, tuple[bool, ...]]
    """By free kind: whether a token may be such a word."""


@dataclass(frozen=True, slots=True)
class TemplateMatch:
    """Hold which template a clause fits, its slots' spans in tokens, and its free words."""

    template: int
    slots: Mapping[str, Span]
    free_words: float


Step = tuple[float, int, int, "Step | None"]
"""Free words so far, the arc, where it began, and the step before."""


class Automaton:
    """Hold the arcs of all templates."""

    def __init__(self, expressions: Sequence[Expression], weights: Mapping[str, float]) -> None:
        self._arcs: list[Arc] = []
        self._weights = weights
        self._first: dict[str, list[int]] = defaultdict(list)
        """By the first token of their words."""
        self._open: list[int] = []
        """First arcs that are of a kind, not of words."""
        for template, expression in enumerate(expressions):
            first, last, _ = self._build(expression, template, ())
            for arc in last:
                self._arcs[arc].is_last = True
            for arc in first:
                words = self._arcs[arc].words
                if not words:
                    self._open.append(arc)
                for word in {option[0] for _, options in words for option in options}:
                    self._first[word].append(arc)

    def __len__(self) -> int:
        """Return how many arcs there are."""
        return len(self._arcs)

    def _build(
        self, expression: Expression, template: int, slots: tuple[str, ...]
    ) -> tuple[list[int], list[int], bool]:
        """Add an expression's arcs; return those that begin it, end it, and whether it may lack."""
        match expression:
            case SlotFilling():
                return self._build(expression.filled_by, template, (*slots, expression.name))
            case OneOf():
                built = [self._build(each, template, slots) for each in expression.options]
                return (
                    [arc for first, _, _ in built for arc in first],
                    [arc for _, last, _ in built for arc in last],
                    any(lacks for _, _, lacks in built),
                )
            case Sequel():
                return self._build_row(expression, template, slots)
            case LiteralWords() | UnitKind():
                return self._build_arc(expression, template, slots)

    def _build_row(
        self, row: Sequel, template: int, slots: tuple[str, ...]
    ) -> tuple[list[int], list[int], bool]:
        first: list[int] = []
        last: list[int] = []
        may_lack = True
        for part in row.parts:
            begins, ends, lacks = self._build(part, template, slots)
            for arc in last:
                self._arcs[arc].follow += begins
            first += begins if may_lack else []
            last = [*last, *ends] if lacks else ends
            may_lack &= lacks
        return first, last, may_lack

    def _build_arc(
        self, part: LiteralWords | UnitKind, template: int, slots: tuple[str, ...]
    ) -> tuple[list[int], list[int], bool]:
        number, arc = len(self._arcs), Arc(template, slots)
        lacks = False
        if isinstance(part, LiteralWords):
            lacks = 0 in part.by_length
            arc.words = tuple((n, rows) for n, rows in part.by_length.items() if n)
            if not arc.words:
                return [], [], True
        else:
            arc.kind = part.kind
        self._arcs.append(arc)
        if isinstance(part, LiteralWords) or not part.is_free:
            return [number], [number], lacks
        arc.weight = self._weights[part.kind]
        arc.kind = f"{part.kind}^"  # the first word of several
        rest = Arc(template, slots, kind=part.kind, weight=arc.weight, follow=[number + 1])
        self._arcs.append(rest)
        arc.follow.append(number + 1)
        return [number], [number, number + 1], False

    def match(self, units: Units) -> list[TemplateMatch]:
        """Return the templates that read all units, those with the fewest free words first."""
        count = len(units.tokens)
        reached: list[dict[int, Step]] = [{} for _ in range(count + 1)]
        if count:
            self._advance(
                (*self._first.get(units.tokens[0], ()), *self._open), 0, None, units, reached
            )
        for begin in range(1, count):
            for step in reached[begin].values():
                self._advance(self._arcs[step[1]].follow, begin, step, units, reached)
        best: dict[int, TemplateMatch] = {}
        for number, step in reached[count].items():
            arc = self._arcs[number]
            kept = best.get(arc.template)
            if arc.is_last and (kept is None or step[0] < kept.free_words):
                best[arc.template] = TemplateMatch(arc.template, self._slots(step, count), step[0])
        return sorted(best.values(), key=lambda match: (match.free_words, match.template))

    def _advance(
        self,
        arcs: Sequence[int],
        begin: int,
        before: Step | None,
        units: Units,
        reached: list[dict[int, Step]],
    ) -> None:
        spent = before[0] if before is not None else 0.0
        for number in arcs:
            arc = self._arcs[number]
            cost = spent + arc.weight
            for end in _ends(arc, begin, units):
                kept = reached[end].get(number)
                if kept is None or cost < kept[0]:
                    reached[end][number] = (cost, number, begin, before)

    def _slots(self, step: Step | None, end: int) -> dict[str, Span]:
        spans: dict[str, Span] = {}
        while step is not None:
            _, number, begin, before = step
            for name in self._arcs[number].slots:
                spans[name] = (begin, spans[name][1] if name in spans else end)
            end, step = begin, before
        return spans


def _ends(arc: Arc, begin: int, units: Units) -> Iterator[int]:
    """Yield where an arc may end that begins at a token."""
    if arc.words:
        for length, options in arc.words:
            if units.tokens[begin : begin + length] in options:
                yield begin + length
    elif arc.weight:
        if units.free[arc.kind][begin]:
            yield begin + 1
    else:
        yield from units.ends.get(arc.kind, {}).get(begin, ())
