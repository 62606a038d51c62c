"""Say what the whole offline planner makes of writers' sentences.

A sentence is right at once where the steps are those of its label, right after one yes where the
one plan laid before the person is, and a wrong motion where something is done at once that moves
and is not meant. Steps are compared by what drives, where, and under which condition; words by
containing each other. A word to the planner itself is right where it is of the label's kind and
names what the label names; a change where it makes the label's steps of what was said before.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter, defaultdict
from dataclasses import replace
from datetime import UTC, datetime
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.commands import (
    CancelCommand,
    Faster,
    ForgetFacts,
    HereCommand,
    PauseCommand,
    Remember,
    ResumeCommand,
    Slower,
    TeachFact,
)
from planner.language.grammar.context import Context
from planner.language.readers import OrderWords, read_order
from planner.language.recall import read_span
from planner.language.schedule import ChangeOrders, CorrectOrder, ListOrders, ScheduleCommand
from planner.language.semantic_parser.changed_order import (
    CHANGES,
    change_order,
    name_pointed,
    put_first,
)
from planner.language.semantic_parser.normal_plan import normalise_plan
from planner.language.semantic_parser.plan_grammar import ALONE, FORMS, SlotKind, parse_plan
from planner.language.semantic_parser.plan_steps import StepMaker
from planner.language.sentence import parse
from planner.language.stop import is_stop
from planner.plan import (
    EVERY_KIND,
    Bilingual,
    Clarify,
    Entry,
    Find,
    Language,
    LastOrder,
    Option,
    Plan,
    StepPlan,
    Vocabulary,
    list_nodes,
)
from tools.train_reader.sentences import fault_of, read_sentences

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from planner.language.semantic_parser.plan_grammar import LabelledPlan, PlanNode
    from planner.plan import Step, StepNode
    from tools.train_reader.sentences import WrittenSentence

_PLACES = (SlotKind.PLACE, SlotKind.PLACES, SlotKind.ROUND)
_MOVES = frozenset(
    {"go_to", "stand_at", "come_back", "return_home", "turn", "move", "patrol", "explore"}
    | {"go_to_object", "find", "count", "follow", "look"}
)
_CONTEXT = Context(runnable=frozenset(EVERY_KIND), now=datetime(2026, 5, 4, 10, 30, tzinfo=UTC))
_INTENTS: dict[str, type[object]] = {
    "pause": PauseCommand,
    "resume": ResumeCommand,
    "slower": Slower,
    "faster": Faster,
    "cancel": CancelCommand,
    "fact": TeachFact,
    "forget": ForgetFacts,
    "name_here": Remember,
    "here": HereCommand,
    "orders": ListOrders,
    "order_move": CorrectOrder,
} | dict.fromkeys(("order_remove", "order_pause", "order_resume", "order_skip"), ChangeOrders)
"""What a label's words are to the planner itself."""


class PlannerVerdict(StrEnum):
    """Say what became of a sentence."""

    AT_ONCE = "right at once"
    AFTER_YES = "right after one yes"
    AFTER_CHOICE = "right after one choice of several"
    OTHER_OFFER = "another order offered"
    ASKED = "asked"
    WRONG_MOTION = "wrong motion"
    WRONG_STILL = "wrong, still"
    QUIET = "orders nothing, and nothing is done"
    STOPS = "stops"


def vocabulary_of(home: Iterable[str]) -> Vocabulary:
    """Return a site with these names."""
    return Vocabulary(
        entries=tuple(
            Entry(id=f"place_{number}", kind="room", name=Bilingual(en=name, zh=name))
            for number, name in enumerate(home)
        )
    )


def _with_ids(plan: LabelledPlan, ids: dict[str, str]) -> LabelledPlan:
    """Return a plan with the ids of its places."""
    return tuple(
        replace(
            node,
            slots=tuple(
                tuple(ids.get(text.casefold(), text) for text in value)
                if slot.kind in _PLACES
                else value
                for slot, value in zip(FORMS[node.form].slots, node.slots, strict=False)
            ),
            condition=_with_ids(node.condition, ids),
            blocks=tuple(_with_ids(block, ids) for block in node.blocks),
        )
        for node in plan
    )


def _meaning(node: StepNode) -> tuple[object, ...]:
    step = node.step
    words = next(
        (getattr(step, name) for name in ("object", "text", "question") if hasattr(step, name)), ""
    )
    place = getattr(step, "place", None) or tuple(sorted(getattr(step, "places", ())))
    amount = [
        round(getattr(step, name), 1)
        for name in ("angle_rad", "distance_m")
        if getattr(step, name, None) is not None
    ]
    kind = "check" if step.kind in ("look", "find") else step.kind
    return kind, place, tuple(amount), str(node.role or ""), str(words or "").casefold()


def _meanings(steps: tuple[Step, ...]) -> Iterator[tuple[object, ...]]:
    """Yield what steps do; a drive to where the next one is done anyway is left out."""
    found = [_meaning(node) for node in list_nodes(steps)]
    for at, each in enumerate(found):
        after = found[at + 1] if at + 1 < len(found) else None
        if each[0] == "go_to" and after is not None and after[1] == each[1]:
            continue
        yield each


def _is_same(made: StepPlan, meant: StepPlan) -> bool:
    pairs = list(_meanings(made.steps)), list(_meanings(meant.steps))
    if len(pairs[0]) != len(pairs[1]):
        return False
    for one, other in zip(*pairs, strict=True):
        words, wanted = (str(each[-1]).strip("?？ ") for each in (one, other))
        if one[:-1] != other[:-1] or (words not in wanted and wanted not in words):
            return False
    return True


def _moves(made: StepPlan) -> bool:
    return any(node.step.kind in _MOVES for node in list_nodes(made.steps))


def _read(text: str, vocabulary: Vocabulary, context: Context) -> Plan:
    return read_order(OrderWords(parse(text), vocabulary, context)).plan


def _said_before(row: WrittenSentence, vocabulary: Vocabulary) -> LastOrder | None:
    """Return the order before, of a situation that tells one."""
    _, found, rest = row.situation.partition("said before: ")
    plan = _read(rest.partition(";")[0], vocabulary, _CONTEXT) if found else None
    if not isinstance(plan, StepPlan):
        return None
    steps = plan.steps
    thing = next((step.object for step in steps if isinstance(step, Find)), None)
    ended = row.situation.startswith(("robot idle", "robot has", "robot waiting"))
    return LastOrder(steps, () if ended else steps, ended, thing=thing, names=vocabulary)


def _is_meant(intent: object, label: PlanNode) -> bool:
    """Return whether a word to the planner is of the label's kind and names what it names."""
    if not isinstance(intent, _INTENTS[label.form]):
        return False
    if isinstance(intent, ChangeOrders) and label.form != f"order_{intent.act}":
        return False
    told = repr(intent).casefold()
    which = label.slots[0][0] if label.slots and label.slots[0] else ""
    return all(word in told for word in which.casefold().split() if word not in _LITTLE_WORDS)


_LITTLE_WORDS = frozenset({"the", "one", "that", "my", "is", "are"})


def _judge_words(row: WrittenSentence, label: PlanNode, made: Plan) -> PlannerVerdict:
    """Return what becomes of a word to the planner itself."""
    if _is_meant(parse(row.words).intent, label):
        return PlannerVerdict.AT_ONCE
    if isinstance(made, StepPlan):
        return PlannerVerdict.WRONG_MOTION if _moves(made) else PlannerVerdict.WRONG_STILL
    options = made.options if isinstance(made, Clarify) else ()
    meant = [each.plan is None and _is_meant(parse(each.text).intent, label) for each in options]
    return _of_offers(meant)


def _of_offers(are_meant: list[bool]) -> PlannerVerdict:
    """Return what becomes of a sentence that is met with these offers."""
    if not are_meant:
        return PlannerVerdict.ASKED
    if not any(are_meant):
        return PlannerVerdict.OTHER_OFFER
    return PlannerVerdict.AFTER_YES if len(are_meant) == 1 else PlannerVerdict.AFTER_CHOICE


def _read_kept(text: str, when: str, vocabulary: Vocabulary, context: Context) -> Plan | None:
    """Return what a standing order does at a time; None where it is for another one."""
    kept = parse(text).intent
    if not isinstance(kept, ScheduleCommand) or kept.problem is not None:
        return None
    if when and kept.words.casefold() not in when.casefold():
        return None
    order = kept.order
    if kept.reminder is not None:
        lead = "say" if context.language is Language.EN else "说"
        order = f"{lead} “{kept.reminder}”"
    return _read(order, vocabulary, context) if order else None


def _laid_plan(option: Option, when: str) -> Plan | None:
    """Return the plan of an offer; None: it has none, or does it at another time."""
    if not option.is_standing:
        return None if when else option.plan
    kept = parse(option.text).intent
    is_due = isinstance(kept, ScheduleCommand) and kept.words.casefold() in when.casefold()
    return option.plan if is_due else None


def judge_sentence(row: WrittenSentence) -> PlannerVerdict:
    """Return what the offline planner makes of a sentence."""
    vocabulary = vocabulary_of(row.home)
    ids = {name.casefold(): f"place_{number}" for number, name in enumerate(row.home)}
    label = _with_ids(normalise_plan(parse_plan(row.label)), ids)
    form, last = label[0].form, _said_before(row, vocabulary)
    language = Language(row.language)
    context = _CONTEXT.model_copy(update={"language": language, "newest": last})
    if form in _INTENTS:
        named = parse_plan(row.label)[0]
        return _judge_words(row, named, _read(row.words, vocabulary, context))
    maker = StepMaker(vocabulary, language, lambda words: "10:00", read_span)
    when = label[0].slots[0][0] if form == "at" else ""
    deed = name_pointed(label[0].blocks[0] if form == "at" else label, last)
    meant = maker.plan(deed) if form not in ALONE else None
    if form in CHANGES:
        meant = change_order(label[0], last)
    if form == "first" and meant is not None:
        meant = put_first(meant, last)
    made: Plan | None = _read(row.words, vocabulary, context)
    at_once = _read_kept(row.words, when, vocabulary, context) if form == "at" else made
    if isinstance(at_once, StepPlan) and meant is not None and _is_same(at_once, meant):
        return PlannerVerdict.AT_ONCE
    if form == "at" and isinstance(at_once, Clarify):
        made, when = at_once, ""
    if isinstance(made, StepPlan):
        return PlannerVerdict.WRONG_MOTION if _moves(made) else PlannerVerdict.WRONG_STILL
    options = made.options if isinstance(made, Clarify) else ()
    if not options and form in ("none", "refuse"):
        return PlannerVerdict.QUIET

    def is_meant(option: Option) -> bool:
        text, laid = option.text, _laid_plan(option, when)
        if laid is None:
            kept = _read_kept(text, when, vocabulary, context) if when else None
            laid = kept if when else _read(text, vocabulary, context)
        return meant is not None and isinstance(laid, StepPlan) and _is_same(laid, meant)

    return _of_offers([is_meant(each) for each in options])


def main() -> None:
    """Judge files, and tell shares by category."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--every", type=int, default=1, help="judge each so many rows")
    parser.add_argument("--show", default="", help="print sentences of this verdict")
    told = parser.parse_args()
    counts: defaultdict[str, Counter[PlannerVerdict]] = defaultdict(Counter)
    for path in told.files:
        rows = [row for row in read_sentences(path) if not fault_of(row)]
        for row in rows[:: told.every]:
            if is_stop(row.words):
                counts[row.category][PlannerVerdict.STOPS] += 1
                continue
            verdict = judge_sentence(row)
            counts[row.category][verdict] += 1
            if verdict == told.show:
                sys.stdout.write(f"{row.label}\n    {row.words}\n")
    whole = sum(counts.values(), Counter())
    for name, found in (*sorted(counts.items()), ("all", whole)):
        shares = ", ".join(f"{verdict} {number}" for verdict, number in found.most_common())
        sys.stdout.write(f"{name} ({found.total()}): {shares}\n")


if __name__ == "__main__":
    main()
