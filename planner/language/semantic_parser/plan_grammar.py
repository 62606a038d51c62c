"""Own the closed grammar of what a sentence may order, and the notation in which people write it.

A plan is one or several nodes; ``go(kitchen); say("dinner is ready", to "Dad")``. Each node is of
a form of the table below: slots in brackets, then a condition, then steps in braces. What stands in
quotes are words of the sentence, letter for letter; a place is one of the site's names; an amount
is written in one way however it was said. Law: ``parse_plan(render_plan(plan)) == plan``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum


class SlotKind(StrEnum):
    """Say what may stand in a slot."""

    PLACE = "place"
    """A place that the sentence names, or ``there``: the place that was spoken of."""
    PLACES = "places"
    """One place or several."""
    ROUND = "round"
    """Several places, or ``all``."""
    WORDS = "words"
    """Words of the sentence in quotes: a thing, a person, a question, what is to be said."""
    THING = "thing"
    """Likewise, or ``it``: the thing or person that was spoken of."""
    LENGTH = "length"
    ANGLE = "angle"
    DURATION = "duration"
    TIMES = "times"
    SIDE = "side"
    TURN = "turn"
    WAY = "way"


CHOICES: dict[SlotKind, tuple[str, ...]] = {
    SlotKind.SIDE: ("before", "beside", "behind", "facing"),
    SlotKind.TURN: ("left", "right", "around", "full"),
    SlotKind.WAY: ("forward", "backward"),
}
AMOUNT_UNITS: dict[SlotKind, tuple[str, ...]] = {
    SlotKind.LENGTH: ("m", "cm", "ft", "in"),
    SlotKind.ANGLE: ("deg",),
    SlotKind.DURATION: ("s", "min", "h"),
    SlotKind.TIMES: ("times",),
}
POINTED_BEFORE: dict[SlotKind, str] = {SlotKind.PLACE: "there", SlotKind.THING: "it"}
ALL, VAGUE = "all", "a bit"


@dataclass(frozen=True, slots=True)
class FormSlot:
    """Name what a form may hold; a slot with a marker is written behind it."""

    kind: SlotKind
    marker: str = ""
    may_lack: bool = False


@dataclass(frozen=True, slots=True)
class Form:
    """Hold what a node of this name is made of."""

    slots: tuple[FormSlot, ...] = ()
    has_condition: bool = False
    blocks: int = 0
    """How many rows of steps it holds; the second is written behind ``else`` and may be empty."""


_PLACE, _THING = FormSlot(SlotKind.PLACE), FormSlot(SlotKind.THING)
_WORDS, _IN = FormSlot(SlotKind.WORDS), FormSlot(SlotKind.PLACE, "in")
_TO, _WHEN = FormSlot(SlotKind.WORDS, "to"), FormSlot(SlotKind.WORDS, "when")
_SOME_WORDS, _SOMETHING = FormSlot(SlotKind.WORDS, "", True), FormSlot(SlotKind.THING, "", True)
_FOR, _SO_OFTEN = FormSlot(SlotKind.DURATION, "for"), FormSlot(SlotKind.TIMES, "", True)

CONDITIONS: dict[str, Form] = {
    "check": Form((_THING, _IN)),
    "find": Form((_THING, _IN)),
    "ask": Form((_WORDS, _TO)),
    "recall": Form((_SOMETHING, _IN, _WHEN)),
    "later": Form((_WORDS,)),
    "earlier": Form((_WORDS,)),
}
"""What may be asked before steps are chosen; ``later`` and ``earlier`` ask the clock."""
STEPS: dict[str, Form] = {
    "go": Form((_PLACE,)),
    "approach": Form((_THING, _IN)),
    "stand": Form(
        (FormSlot(SlotKind.SIDE), FormSlot(SlotKind.PLACE, "at"), FormSlot(SlotKind.THING, "by"))
    ),
    "back": Form(),
    "home": Form(),
    "turn": Form((FormSlot(SlotKind.TURN), FormSlot(SlotKind.ANGLE, "", True))),
    "move": Form((FormSlot(SlotKind.WAY), FormSlot(SlotKind.LENGTH, "", True))),
    "patrol": Form((FormSlot(SlotKind.ROUND), FormSlot(SlotKind.PLACES, "except"))),
    "inspect": Form((FormSlot(SlotKind.ROUND), FormSlot(SlotKind.PLACES, "except"))),
    "explore": Form(),
    "look": Form((_IN,)),
    "count": Form((_THING, _IN)),
    "follow": Form((_SOMETHING, _FOR)),
    "say": Form((_WORDS, _TO)),
    "wait": Form((FormSlot(SlotKind.DURATION, "", True),)),
    "wait_for": Form((_THING,)),
    "wait_word": Form((_WORDS,)),
    "wait_until": Form((_WORDS,)),
    "deeds": Form((_IN, _WHEN)),
    "if": Form(has_condition=True, blocks=2),
    "until": Form(has_condition=True, blocks=1),
    "repeat": Form((_SO_OFTEN, _FOR), blocks=1),
    "try": Form(blocks=2),
} | {name: CONDITIONS[name] for name in ("check", "find", "ask", "recall")}
NEGATION = "not"
WRAPPERS: dict[str, Form] = {
    "at": Form((_WORDS, _SOME_WORDS), blocks=1),
    "after": Form(blocks=1),
    "instead": Form(blocks=1),
    "first": Form(blocks=1),
    "slowly": Form(blocks=1),
}
"""How a row of steps acts: at a time, or on the order that runs."""
ALONE: dict[str, Form] = {
    "none": Form(),
    "refuse": Form(),
    "stop": Form(),
    "cancel": Form(),
    "pause": Form(),
    "resume": Form(),
    "slower": Form(),
    "faster": Form(),
    "again": Form((_SO_OFTEN,)),
    "more": Form(),
    "less": Form(),
    "other": Form(),
    "skip": Form((_PLACE,)),
    "also": Form((_PLACE,)),
    "also_thing": Form((_WORDS,)),
    "change_place": Form((_PLACE,)),
    "change_thing": Form((_WORDS,)),
    "fact": Form((_WORDS,)),
    "forget": Form((_SOME_WORDS,)),
    "name_here": Form((_WORDS,)),
    "here": Form((_PLACE,)),
    "orders": Form((_SOME_WORDS, _WHEN)),
    "order_remove": Form((_SOME_WORDS,)),
    "order_pause": Form((_SOME_WORDS,)),
    "order_resume": Form((_SOME_WORDS,)),
    "order_skip": Form((_SOME_WORDS, _WHEN)),
    "order_move": Form((_SOME_WORDS, _TO)),
}
"""What is a whole plan by itself: it orders nothing, or changes what runs, is kept or is known."""
FORMS: dict[str, Form] = {**ALONE, **WRAPPERS, **CONDITIONS, **STEPS, NEGATION: Form()}
MAX_DEPTH, MAX_NODES = 4, 24

Value = tuple[str, ...]
"""What a slot holds: nothing, one text, or the places of a round."""


@dataclass(frozen=True, slots=True)
class PlanNode:
    """Hold one node of a plan."""

    form: str
    slots: tuple[Value, ...] = ()
    condition: tuple[PlanNode, ...] = ()
    """One node, or ``not`` and one node."""
    blocks: tuple[tuple[PlanNode, ...], ...] = ()


LabelledPlan = tuple[PlanNode, ...]


class NotationError(ValueError):
    """Tell where a text is not a plan of the grammar."""


def is_optional(slot: FormSlot) -> bool:
    """Return whether a slot may be left out."""
    return bool(slot.marker) or slot.may_lack


def render_plan(plan: LabelledPlan) -> str:
    """Return a plan in its notation."""
    return "; ".join(map(_render_node, plan))


def _render_node(node: PlanNode) -> str:
    form = FORMS[node.form]
    inside = ", ".join(
        f"{slot.marker} {_render_value(slot.kind, value)}".strip()
        for slot, value in zip(form.slots, node.slots, strict=True)
        if value
    )
    parts = [f"{node.form}({inside})" if inside else node.form]
    parts += [" ".join(map(_render_node, node.condition))] if node.condition else []
    for number, block in enumerate(node.blocks):
        if block or number == 0:
            parts += (["else"] if number else []) + [f"{{ {render_plan(block)} }}"]
    return " ".join(parts)


def _render_value(kind: SlotKind, value: Value) -> str:
    if kind in (SlotKind.WORDS, SlotKind.THING) and value != (POINTED_BEFORE.get(kind),):
        return f'"{value[0]}"'
    return " + ".join(value)


_TOKEN = re.compile(r"\s*(?:(?P<name>[a-z_]+)|(?P<mark>[(){};])|(?P<odd>\S))")
_VALUE = re.compile(r'\s*(?:"(?P<quoted>[^"\n\t]+)"|(?P<plain>[^"(){};,\n\t]+))\s*')
_AMOUNT = re.compile(r"(?P<number>\d{1,5}(?:\.\d{1,3})?) (?P<unit>[a-z]+)")


class _NotationReader:
    """Read one text from left to right."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._nodes = 0

    def fail(self, expected: str) -> NotationError:
        """Return the error of this position."""
        found = self._text[self._at : self._at + 30].strip() or "the end"
        return NotationError(f"expected {expected}, found: {found}")

    def peek(self) -> str:
        """Return the next name or mark without taking it; empty at the end."""
        found = _TOKEN.match(self._text, self._at)
        return found[0].strip() if found else ""

    def take(self, *wanted: str) -> str:
        """Take the next name or mark, which must be one of these."""
        found = self.peek()
        if found not in wanted:
            raise self.fail(" or ".join(sorted(wanted)))
        match = _TOKEN.match(self._text, self._at)
        self._at = match.end() if match else self._at
        return found

    def row(self, forms: frozenset[str], depth: int) -> LabelledPlan:
        """Read nodes with ``;`` between them."""
        nodes = [self.node(forms, depth)]
        while self.peek() == ";":
            self.take(";")
            nodes.append(self.node(forms, depth))
        return tuple(nodes)

    def node(self, forms: frozenset[str], depth: int) -> PlanNode:
        """Read one node of one of these forms."""
        self._nodes += 1
        if depth > MAX_DEPTH or self._nodes > MAX_NODES:
            raise NotationError(f"a plan holds at most {MAX_NODES} nodes, {MAX_DEPTH} deep")
        name = self.take(*forms)
        form = FORMS[name]
        slots = self._slots(form)
        condition: LabelledPlan = ()
        if form.has_condition:
            denied = (PlanNode(self.take(NEGATION)),) if self.peek() == NEGATION else ()
            condition = (*denied, self.node(frozenset(CONDITIONS), depth + 1))
        blocks = tuple(self._block(number, depth) for number in range(form.blocks))
        return PlanNode(name, slots, condition, blocks)

    def _block(self, number: int, depth: int) -> LabelledPlan:
        if number:
            if self.peek() != "else":
                return ()
            self.take("else")
        self.take("{")
        row = self.row(frozenset(STEPS), depth + 1)
        self.take("}")
        return row

    def _slots(self, form: Form) -> tuple[Value, ...]:
        values: dict[int, Value] = {}
        if self.peek() == "(":
            self.take("(")
            while True:
                index = self._slot_of(form, max(values, default=-1) + 1)
                values[index] = self._value(form.slots[index].kind)
                if self._text[self._at : self._at + 1] != ",":
                    break
                self._at += 1
            self.take(")")
        for index, slot in enumerate(form.slots):
            if index not in values and not is_optional(slot):
                raise self.fail(f"a {slot.kind}")
        return tuple(values.get(index, ()) for index in range(len(form.slots)))

    def _slot_of(self, form: Form, first: int) -> int:
        """Return which slot comes next, its marker taken."""
        left = range(first, len(form.slots))
        for index in (index for index in left if form.slots[index].marker):
            found = re.compile(rf"\s*{form.slots[index].marker} ").match(self._text, self._at)
            if found:
                self._at = found.end()
                return index
        if left and not form.slots[first].marker:
            return first
        raise self.fail("no further slot" if form.slots else "no brackets")

    def _value(self, kind: SlotKind) -> Value:
        found = _VALUE.match(self._text, self._at)
        if found is None:
            raise self.fail(f"a {kind}")
        value = _read_value(kind, found["quoted"], (found["plain"] or "").strip())
        if value is None:
            raise self.fail(f"a {kind}")
        self._at = found.end()
        return value


def _read_value(kind: SlotKind, quoted: str | None, plain: str) -> Value | None:
    """Return a slot's value; None where its kind has none like it."""
    if kind in (SlotKind.WORDS, SlotKind.THING):
        if quoted is not None:
            # Spaces at the ends would point at no other words, and not come back from them.
            return (quoted,) if quoted == quoted.strip() else None
        return (plain,) if plain == POINTED_BEFORE.get(kind) else None
    if quoted is not None:
        return None
    if kind in CHOICES:
        return (plain,) if plain in CHOICES[kind] else None
    if kind in AMOUNT_UNITS:
        amount = _AMOUNT.fullmatch(plain)
        known = plain == VAGUE or (amount is not None and amount["unit"] in AMOUNT_UNITS[kind])
        return (plain,) if known else None
    places = tuple(" ".join(place.split()) for place in plain.split("+"))
    several = kind in (SlotKind.PLACES, SlotKind.ROUND)
    if not all(places) or (len(places) > 1 and (not several or ALL in places)):
        return None
    return places


def parse_plan(text: str) -> LabelledPlan:
    """Return the plan that a text in the notation says.

    Raises:
        NotationError: it is not one of the grammar.
    """
    reader = _NotationReader(text)
    first = reader.peek()
    if first in ALONE or first in WRAPPERS:
        plan: LabelledPlan = (reader.node(frozenset({first}), 0),)
    else:
        plan = reader.row(frozenset(STEPS), 0)
    if reader.peek():
        raise reader.fail("the end")
    return plan
