"""Say what the whole offline planner makes of writers' sentences.

A sentence is right at once where the steps are those of its label, right after one yes where the
one plan laid before the person is, and a wrong motion where something is done at once that moves
and is not meant. Steps are compared by what drives, where, and under which condition; words by
containing each other.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter, defaultdict
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.grammar.context import Context
from planner.language.readers import OrderWords, read_order
from planner.language.schedule import ScheduleCommand
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
    Language,
    Plan,
    StepPlan,
    Vocabulary,
    list_nodes,
)
from tools.train_reader.sentences import fault_of, read_sentences

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from planner.language.semantic_parser.plan_grammar import LabelledPlan
    from planner.plan import Step, StepNode
    from tools.train_reader.sentences import WrittenSentence

_PLACES = (SlotKind.PLACE, SlotKind.PLACES, SlotKind.ROUND)
_MOVES = frozenset(
    {"go_to", "stand_at", "come_back", "return_home", "turn", "move", "patrol", "explore"}
    | {"go_to_object", "find", "count", "follow", "look"}
)
_SPEECH = ("say", "ask")
_CONTEXT = Context(runnable=frozenset(EVERY_KIND))


class PlannerVerdict(StrEnum):
    """Say what became of a sentence."""

    AT_ONCE = "right at once"
    AFTER_YES = "right after one yes"
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


def _order_at(text: str, when: str) -> str:
    """Return what a standing order does at a time; empty where it is for another one."""
    kept = parse(text).intent
    if not isinstance(kept, ScheduleCommand) or kept.words.casefold() not in when.casefold():
        return ""
    return kept.order if kept.reminder is None else text.removeprefix(kept.words)


def judge_sentence(row: WrittenSentence) -> PlannerVerdict:
    """Return what the offline planner makes of a sentence."""
    vocabulary = vocabulary_of(row.home)
    ids = {name.casefold(): f"place_{number}" for number, name in enumerate(row.home)}
    label = normalise_plan(parse_plan(row.label))
    maker = StepMaker(vocabulary, Language(row.language), lambda words: "10:00")
    meant = None if label[0].form in ALONE else maker.plan(_with_ids(label, ids))
    context = _CONTEXT.model_copy(update={"language": Language(row.language)})
    made = _read(row.words, vocabulary, context)
    quiet = label[0].form in ("none", "refuse")
    if isinstance(made, StepPlan):
        if meant is not None and _is_same(made, meant):
            return PlannerVerdict.AT_ONCE
        return PlannerVerdict.WRONG_MOTION if _moves(made) else PlannerVerdict.WRONG_STILL
    options = made.options if isinstance(made, Clarify) else ()
    if len(options) == 1:
        laid: Plan | None = options[0].plan
        text = options[0].text
        if label[0].form == "at" and laid is None:
            meant = maker.plan(_with_ids(label[0].blocks[0], ids))
            text = _order_at(text, label[0].slots[0][0])
        laid = laid or _read(text, vocabulary, context)
        if meant is not None and isinstance(laid, StepPlan) and _is_same(laid, meant):
            return PlannerVerdict.AFTER_YES
        return PlannerVerdict.OTHER_OFFER
    return PlannerVerdict.QUIET if quiet else PlannerVerdict.ASKED


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
