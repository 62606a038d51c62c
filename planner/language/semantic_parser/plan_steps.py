"""Turn a plan of the parser's grammar into steps that a mission walks; None where one has no step.

What leans on an earlier order (``there``, ``it``) and what changes one is the follow-ups' business;
a time in words is read by whoever passes ``read_hour``. An amount that was left vague is small.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, radians
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.language.questions import read_question
from planner.language.semantic_parser.amounts import amount_value
from planner.language.semantic_parser.plan_grammar import (
    ALL,
    FORMS,
    NEGATION,
    VAGUE,
    LabelledPlan,
    PlanNode,
    SlotKind,
)
from planner.plan import (
    Ask,
    Attempt,
    ClockTime,
    ComeBack,
    Count,
    Explore,
    Find,
    Follow,
    GoTo,
    GoToObject,
    If,
    Language,
    Look,
    MoveStraight,
    Patrol,
    PlanRole,
    Recall,
    Repeat,
    ReturnHome,
    Say,
    StandAt,
    Step,
    StepPlan,
    Turn,
    Vocabulary,
    Wait,
    WaitFor,
)

if TYPE_CHECKING:
    from planner.plan.steps import Condition, Span

_ROLES = {"after": PlanRole.AFTER, "instead": PlanRole.INSTEAD} | dict.fromkeys(
    ("first", "slowly"), PlanRole.NEW
)
_TURNS = {"left": pi / 2, "right": -pi / 2, "around": pi, "full": 2 * pi}
_LITTLE = {SlotKind.ANGLE: radians(30.0), SlotKind.LENGTH: 0.2, SlotKind.DURATION: 30.0}
_PERSON = "person"
_AROUND = {Language.EN: "look around", Language.ZH: "看看周围"}
_SPEAKER = frozenset({"me", "us", "我", "俺", "咱", "我们"})


class _NoStep(Exception):
    """A node has no step: it leans on an earlier order, or its time isn't read."""


@dataclass(frozen=True, slots=True)
class StepMaker:
    """Make steps of one site's plans.

    Args:
        vocabulary: of the site.
        language: of the sentence.
        read_hour: returns the HH:MM that words mean, or None.
        read_span: returns the time before that words mean, or None.
    """

    vocabulary: Vocabulary
    language: Language
    read_hour: Callable[[str], str | None]
    read_span: Callable[[str], Span | None] = lambda _: None

    def plan(self, plan: LabelledPlan) -> StepPlan | None:
        """Return the plan as a mission takes it; None where it has no steps."""
        first = plan[0] if plan else PlanNode("none")
        row = first.blocks[0] if first.form in _ROLES else plan
        try:
            steps = self._row(row)
            pace = "slow" if first.form == "slowly" else None
            return StepPlan(steps=steps, does=_ROLES.get(first.form, PlanRole.NEW), pace=pace)
        except (_NoStep, ValidationError):
            return None

    def _row(self, row: LabelledPlan) -> tuple[Step, ...]:
        steps: list[Step] = []
        for node in row:
            made = self._node(node)
            if node.form in ("say", "ask") and node.slots[1] and not steps:
                steps.append(Find(object=node.slots[1][0]))
            steps += made
        return tuple(steps)

    def _node(self, node: PlanNode) -> tuple[Step, ...]:
        if node.blocks:
            return (self._holder(node),)
        maker = _MAKERS.get(node.form)
        if maker is None:
            raise _NoStep
        return maker(self, _Slots(node))

    def _holder(self, node: PlanNode) -> Step:
        rows = tuple(self._row(block) for block in node.blocks)
        slots = _Slots(node)
        if node.form == "try":
            return Attempt(steps=rows[0], on_failure=rows[1])
        if node.form == "repeat":
            times, lasting = slots.amount(0), slots.amount(1)
            limits = {} if lasting is None else {"seconds": lasting}
            return Repeat(steps=rows[0], **limits, **({} if times is None else {"times": times}))
        if not node.condition:
            raise _NoStep
        denied = node.condition[0].form == NEGATION
        when = self._condition(node.condition[-1])
        if node.form == "until":
            if denied:
                raise _NoStep
            return Repeat(steps=rows[0], until=when)
        then, otherwise = reversed(rows) if denied else rows
        return If(when=when, then=then, otherwise=otherwise)

    def _condition(self, node: PlanNode) -> Condition:
        if node.form in ("later", "earlier"):
            hour = self.read_hour(node.slots[0][0])
            if hour is None:
                raise _NoStep
            return ClockTime(after=hour) if node.form == "later" else ClockTime(before=hour)
        steps = self._node(node)
        condition = steps[-1]
        if not isinstance(condition, Look | Find | Ask | Recall):
            raise _NoStep
        return condition

    def question(self, what: str) -> str:
        """Return what a look is asked: whether it is there, or so."""
        if self.language is Language.EN:
            return f"{what}?"
        asked = f"有没有{what}？"  # 老头子？ asks for nothing that eyes could know or not know
        is_thing = any(certain for _, certain, *_ in read_question(asked, {}).asked)
        return asked if is_thing else f"{what}？"

    def words_to(self, slots: _Slots) -> str:
        """Return the words that somebody is told or asked, the name first."""
        words, person = slots.need(0), slots.text(1)
        comma = ", " if self.language is Language.EN else "，"
        return words if person is None else f"{person}{comma}{words}"

    def around(self) -> str:
        """Return what a look round is asked."""
        return _AROUND.get(self.language, _AROUND[Language.EN])

    def rooms(self, slots: _Slots) -> tuple[str, ...]:
        """Return the places of a round, without those left out."""
        named = slots.values(0)
        everywhere = (entry.id for entry in self.vocabulary.entries if entry.kind == "room")
        places = tuple(everywhere) if named == (ALL,) else named
        return tuple(place for place in places if place not in slots.values(1))


@dataclass(frozen=True, slots=True)
class _Slots:
    node: PlanNode

    def values(self, index: int) -> tuple[str, ...]:
        return self.node.slots[index]

    def text(self, index: int) -> str | None:
        """Return what a slot holds; None where it is empty."""
        value = self.node.slots[index]
        kind = FORMS[self.node.form].slots[index].kind
        if value in (("there",), ("it",)) and kind in (SlotKind.PLACE, SlotKind.THING):
            raise _NoStep
        return value[0] if value else None

    def need(self, index: int) -> str:
        text = self.text(index)
        if text is None:
            raise _NoStep
        return text

    def amount(self, index: int) -> float | None:
        """Return an amount in seconds, metres, radians or times; None where it is empty."""
        text = self.text(index)
        kind = FORMS[self.node.form].slots[index].kind
        if text is None or text == VAGUE:
            return None if text is None else _LITTLE.get(kind)
        value = amount_value(text)
        return radians(value) if kind is SlotKind.ANGLE else value


def _go_there(place: str | None) -> tuple[Step, ...]:
    return () if place is None else (GoTo(place=place),)


def _turn(_: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    way, amount = slots.need(0), slots.amount(1)
    whole = _TURNS[way]
    return (Turn(angle_rad=whole if amount is None else amount * (1 if whole > 0 else -1)),)


def _move(_: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    metres = slots.amount(1)
    metres = _LITTLE[SlotKind.LENGTH] if metres is None else metres
    return (MoveStraight(distance_m=metres if slots.need(0) == "forward" else -metres),)


def _look(maker: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    place = slots.text(0)
    return (*_go_there(place), Look(question=maker.around(), place=place))


def _check(maker: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    place = slots.text(1)
    return (*_go_there(place), Look(question=maker.question(slots.need(0)), place=place))


def _count(_: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    place = slots.text(1)
    return (*_go_there(place), Count(object=slots.need(0), place=place))


def _follow(_: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    whom = slots.text(0)
    person = _PERSON if whom is None or whom.casefold() in _SPEAKER else whom
    return (Find(object=person), Follow(object=person, seconds=slots.amount(1)))


def _wait_until(maker: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    return (WaitFor(time=maker.read_hour(slots.need(0))),)


def _span(maker: StepMaker, when: str | None) -> Span | None:
    span = None if when is None else maker.read_span(when)
    if span is None and when is not None:  # of another time the answer would be another one
        raise _NoStep
    return span


def _recall(maker: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    what, place, when = map(slots.text, range(3))
    return (Recall(object=what, place=place, span=_span(maker, when)),)


def _deeds(maker: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    return (Recall(place=slots.text(0), span=_span(maker, slots.text(1)), deeds=True),)


def _stand(_: StepMaker, slots: _Slots) -> tuple[Step, ...]:
    step = {"side": slots.need(0), "place": slots.text(1), "object": slots.text(2)}
    return (StandAt.model_validate(step),)


_MAKERS: dict[str, Callable[[StepMaker, _Slots], tuple[Step, ...]]] = {
    "go": lambda _, slots: (GoTo(place=slots.need(0)),),
    "approach": lambda _, s: (GoToObject(object=s.need(0), place=s.text(1)),),
    "stand": _stand,
    "back": lambda *_: (ComeBack(),),
    "home": lambda *_: (ReturnHome(),),
    "turn": _turn,
    "move": _move,
    "patrol": lambda maker, slots: (Patrol(places=maker.rooms(slots)),),
    "inspect": lambda maker, slots: (Patrol(places=maker.rooms(slots), look=True),),
    "explore": lambda *_: (Explore(),),
    "look": _look,
    "check": _check,
    "count": _count,
    "find": lambda _, slots: (Find(object=slots.need(0), place=slots.text(1)),),
    "follow": _follow,
    "say": lambda maker, slots: (Say(text=maker.words_to(slots)),),
    "ask": lambda maker, slots: (Ask(question=maker.words_to(slots)),),
    "wait": lambda _, s: (Wait(seconds=s.amount(0) or _LITTLE[SlotKind.DURATION]),),
    "wait_for": lambda _, slots: (WaitFor(object=slots.need(0)),),
    "wait_word": lambda _, slots: (WaitFor(word=slots.need(0)),),
    "wait_until": _wait_until,
    "recall": _recall,
    "deeds": _deeds,
}
