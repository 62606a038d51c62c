"""Write a plan as a row of actions, hold a row to the grammar while it grows, and read it back.

An action is a token, or the number of a unit of the sentence: a place, an amount, the first or the
last unit of quoted words. Laws: only what the grammar and the sentence hold is allowed, so that
each finished row is a plan; ``read_actions(write_actions(plan)) == plan``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import TYPE_CHECKING

from planner.language.semantic_parser.amounts import amount_value, write_amount
from planner.language.semantic_parser.plan_grammar import (
    ALL,
    ALONE,
    AMOUNT_UNITS,
    CHOICES,
    CONDITIONS,
    FORMS,
    MAX_DEPTH,
    MAX_NODES,
    NEGATION,
    POINTED_BEFORE,
    STEPS,
    VAGUE,
    WRAPPERS,
    FormSlot,
    LabelledPlan,
    PlanNode,
    SlotKind,
    Value,
    is_optional,
)
from planner.language.semantic_parser.units import keys_of

if TYPE_CHECKING:
    from planner.language.semantic_parser.units import SentenceUnits

Action = str | int
ABSENT, END = "-", "}"
MAX_ACTIONS = 40
"""The longest plan of 20 000 sentences has 30."""
MAX_SPAN = 40
QUOTED = (SlotKind.WORDS, SlotKind.THING)
ONE_PLACE, PLACES = SlotKind.PLACE, (SlotKind.PLACES, SlotKind.ROUND)
TOKENS: tuple[str, ...] = tuple(
    sorted(
        {ABSENT, END, ALL, VAGUE}
        | set(FORMS)
        | set(POINTED_BEFORE.values())
        | {choice for choices in CHOICES.values() for choice in choices}
    )
)
TOKEN_NUMBERS = {token: number for number, token in enumerate(TOKENS)}


@dataclass(frozen=True, slots=True)
class NextActions:
    """Say what may come next: one of these tokens, or a unit from ``first`` on of this kind."""

    tokens: frozenset[str]
    points_at: SlotKind | None = None
    """None: at none. Of words: at any unit."""
    first: int = 0
    is_last: bool = False
    """It is the last unit of words that is pointed at."""


@dataclass(frozen=True, slots=True)
class _Pending:
    """Stand for a part of a plan that is still to be written."""

    part: str
    """``top``, ``row``, ``slot``, ``more`` places, ``last`` of words, ``when`` or ``denied``."""
    depth: int = 0
    slot: FormSlot | None = None
    is_open: bool = False
    """Of a row: it may end here."""
    first: int = 0


@cache
def _forms(part: str, depth: int, room: int) -> frozenset[str]:
    """Return the forms that may begin here: none that holds more than there is room for."""
    if part == "when":
        return frozenset(CONDITIONS) | {NEGATION}
    if part == "denied":
        return frozenset(CONDITIONS)
    steps = frozenset(
        name
        for name, form in STEPS.items()
        if 1 + form.has_condition + bool(form.blocks) <= room
        and (depth < MAX_DEPTH or not (form.blocks or form.has_condition))
    )
    return steps | frozenset(ALONE) | frozenset(WRAPPERS) if part == "top" else steps


@cache
def _of_slot(slot: FormSlot) -> frozenset[str]:
    kind = slot.kind
    tokens = set(CHOICES.get(kind, ()))
    tokens |= {POINTED_BEFORE[kind]} if kind in POINTED_BEFORE else set()
    tokens |= {ALL} if kind is SlotKind.ROUND else set()
    tokens |= {VAGUE} if kind in AMOUNT_UNITS else set()
    return frozenset(tokens | ({ABSENT} if is_optional(slot) else set()))


_SLOTS = {(slot.kind, slot.marker) for form in FORMS.values() for slot in form.slots}
PARTS: tuple[tuple[object, ...], ...] = (
    *product(("top", "row", "when", "denied"), range(3), (False, True)),
    *((part, *slot) for part in ("slot", "more", "last") for slot in sorted(_SLOTS)),
)
"""What may come next in a plan; the network is told which of these it is."""
_PART_NUMBERS = {part: number for number, part in enumerate(PARTS)}


class GrammarWalk:
    """Follow a row of actions through the grammar."""

    def __init__(self) -> None:
        self._pending = [_Pending("top")]
        self._nodes = 0

    @property
    def is_done(self) -> bool:
        """Return whether the plan is whole."""
        return not self._pending

    @property
    def part_number(self) -> int:
        """Return which of ``PARTS`` comes next."""
        now = self._pending[-1]
        if now.slot is not None:
            return _PART_NUMBERS[now.part, now.slot.kind, now.slot.marker]
        return _PART_NUMBERS[now.part, min(now.depth, 2), now.is_open]

    def fork(self) -> GrammarWalk:
        """Return a walk that has come as far and goes on by itself."""
        other = GrammarWalk()
        other._pending, other._nodes = self._pending.copy(), self._nodes
        return other

    def next_actions(self) -> NextActions:
        """Return what may come next."""
        next_ = self._pending[-1]
        if next_.slot is None:
            owed = sum(part.slot is None and not part.is_open for part in self._pending[:-1])
            forms = _forms(next_.part, next_.depth, MAX_NODES - self._nodes - owed)
            return NextActions(forms | ({END} if next_.is_open else frozenset()))
        kind = next_.slot.kind
        if next_.part == "last":
            return NextActions(frozenset(), kind, next_.first, is_last=True)
        if next_.part == "more":
            return NextActions(frozenset({ABSENT}), ONE_PLACE)
        points = None if kind in CHOICES else ONE_PLACE if kind in PLACES else kind
        return NextActions(_of_slot(next_.slot), points)

    def take(self, action: Action) -> None:
        """Take an allowed action."""
        now = self._pending.pop()
        if now.slot is not None:
            self._take_value(now, now.slot, action)
        elif action == NEGATION:
            self._pending.append(_Pending("denied", now.depth))
        elif action != END:
            if now.part == "row" or (now.part == "top" and action in STEPS):
                self._pending.append(_Pending("row", now.depth, is_open=True))
            self._open(str(action), now.depth)

    def _take_value(self, now: _Pending, slot: FormSlot, action: Action) -> None:
        if isinstance(action, int) and slot.kind in QUOTED and now.part == "slot":
            self._pending.append(_Pending("last", slot=slot, first=action))
        elif isinstance(action, int) and slot.kind in PLACES:
            self._pending.append(_Pending("more", slot=slot))

    def _open(self, name: str, depth: int) -> None:
        form = FORMS[name]
        self._nodes += 1
        for number in reversed(range(form.blocks)):
            self._pending.append(_Pending("row", depth + 1, is_open=number > 0))
        if form.has_condition:
            self._pending.append(_Pending("when", depth + 1))
        self._pending += [_Pending("slot", slot=slot) for slot in reversed(form.slots)]


class UnknownWords(ValueError):
    """Tell that a sentence doesn't hold what its plan names."""


def write_actions(plan: LabelledPlan, said: SentenceUnits) -> tuple[Action, ...]:
    """Return the actions that write a plan.

    Raises:
        UnknownWords: the sentence lacks a place, an amount or words of the plan.
    """
    actions: list[Action] = []
    for node in plan:
        _write_node(node, said, actions)
    if plan[0].form in STEPS:
        actions.append(END)
    return tuple(actions)


def _write_node(node: PlanNode, said: SentenceUnits, actions: list[Action]) -> None:
    actions.append(node.form)
    form = FORMS[node.form]
    for slot, value in zip(form.slots, node.slots or ((),) * len(form.slots), strict=True):
        actions += _write_value(slot.kind, value, said)
    for part in node.condition:
        _write_node(part, said, actions)
    for block in node.blocks:
        for inner in block:
            _write_node(inner, said, actions)
        actions.append(END)


def _write_value(kind: SlotKind, value: Value, said: SentenceUnits) -> list[Action]:
    if not value:
        return [ABSENT]
    text = value[0]
    if kind in CHOICES or text in (ALL, VAGUE) or text == POINTED_BEFORE.get(kind):
        return [text]
    if kind in AMOUNT_UNITS:
        return [_find_amount(kind, text, said)]
    if kind in QUOTED:
        return [*find_words(text, said)]
    places: list[Action] = [_find_place(place, said) for place in value]
    return places if kind is ONE_PLACE else [*places, ABSENT]


def _find_amount(kind: SlotKind, text: str, said: SentenceUnits) -> int:
    wanted = amount_value(text)
    for at, unit in enumerate(said.units):
        found, value = unit.amount or (None, 0.0)
        if found is kind and abs(value - wanted) <= 0.02 * wanted:
            return at
    raise UnknownWords(f"the amount isn't in the words: {text}")


def _find_place(place: str, said: SentenceUnits) -> int:
    for at, unit in enumerate(said.units):
        if unit.place == place:
            return at
    raise UnknownWords(f"the place isn't in the words: {place}")


def find_words(text: str, said: SentenceUnits) -> tuple[int, int]:
    """Return the first and the last unit of quoted words."""
    sought = keys_of(text)
    pieces = [(key, at) for at, unit in enumerate(said.units) for key in keys_of(unit.key)]
    keys = tuple(key for key, _ in pieces)
    for first in range(len(keys) - len(sought) + 1) if sought else ():
        if keys[first : first + len(sought)] == sought:
            return pieces[first][1], pieces[first + len(sought) - 1][1]
    raise UnknownWords(f"the quoted words aren't in the words: {text}")


class _ActionReader:
    def __init__(self, actions: Sequence[Action], said: SentenceUnits) -> None:
        self._actions = list(reversed(actions))
        self._said = said

    def row(self) -> LabelledPlan:
        nodes = []
        while self._actions and self._actions[-1] != END:
            nodes.append(self.node())
        if self._actions:
            self._actions.pop()
        return tuple(nodes)

    def node(self) -> PlanNode:
        name = str(self._actions.pop())
        form = FORMS[name]
        slots = tuple(self._value(slot.kind) for slot in form.slots)
        condition: LabelledPlan = ()
        if form.has_condition:
            condition = (self.node(),)
            condition = (*condition, self.node()) if condition[0].form == NEGATION else condition
        return PlanNode(name, slots, condition, tuple(self.row() for _ in range(form.blocks)))

    def _value(self, kind: SlotKind) -> Value:
        action = self._actions.pop()
        if isinstance(action, str):
            return () if action == ABSENT else (action,)
        if kind in QUOTED:
            last = self._actions.pop()
            return (self._said.words_between(action, int(last)).replace('"', "'"),)
        unit = self._said.units[action]
        if kind in AMOUNT_UNITS and unit.amount is not None:
            return (write_amount(*unit.amount),)
        places = [unit.place or ""]
        while kind in PLACES and isinstance(action := self._actions.pop(), int):
            places.append(self._said.units[action].place or "")
        return tuple(dict.fromkeys(places))


def read_actions(actions: Sequence[Action], said: SentenceUnits) -> LabelledPlan:
    """Return the plan of a finished row of actions."""
    return _ActionReader(actions, said).row()
