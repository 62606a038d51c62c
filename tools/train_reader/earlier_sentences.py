"""Give the sentences of eighteen earlier writers plans: each has one intent and its slots.

What an intent leaves open (which words are the time, several steps at once) isn't learnt from.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.semantic_parser.amounts import write_amount
from planner.language.semantic_parser.plan_grammar import NotationError, SlotKind
from planner.language.semantic_parser.units import Gazetteer, SentenceUnits, cut_units
from planner.site.site import Site
from planner.site.site_view import vocabulary_of
from tools.train_reader.examples import PlanExample, make_example

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

ROOT = Path(__file__).parents[2]
EARLIER = Path(__file__).parent / "earlier"
_LABELS: Mapping[str, str] = {
    "go": "go({p})",
    "go_go": "go({p}); go({q})",
    "look": "look(in {p})",
    "look_here": "look",
    "look_look": "look(in {p}); look(in {q})",
    "look_back": "look(in {p}); back",
    "find_at": "find({t}, in {p})",
    "find_find": "find({t}, in {p}); find({t}, in {q})",
    "find": "find({t})",
    "count_at": "count({t}, in {p})",
    "count_here": "count({t})",
    "person_at": "check({n}, in {p})",
    "person": "find({n})",
    "go_say": "go({p}); say({w}, to {n})",
    "go_ask": "go({p}); ask({w}, to {n})",
    "person_say": "say({w}, to {n})",
    "person_ask": "ask({w}, to {n})",
    "go_wait_for": "go({p}); wait_for({n})",
    "follow": "follow",
    "home": "home",
    "back": "back",
    "go_back": "go({p}); wait({duration}); back",
    "go_wait": "go({p}); wait({duration})",
    "rounds": "inspect(all)",
    "turn": "turn({side}, {angle})",
    "left": "turn(left, {angle})",
    "right": "turn(right, {angle})",
    "round": "turn(full)",
    "forward": "move(forward, {length})",
    "backward": "move(backward, {length})",
    "recall": "recall({t}, in {p})",
    "remember": "fact({w})",
    "forget": "forget({w})",
    **{each: each for each in ("none", "refuse", "stop", "cancel", "resume", "slower", "faster")},
}
_ANYONE = re.compile(
    r"\b(?:any|some|every)(?:one|body)\b|\bpeople\b|\bwho\b|\bfolks?\b|有没有人|有人|没人|人|谁|哪个"
)
_LEFT, _RIGHT = re.compile(r"\bleft\b|左"), re.compile(r"\bright\b|右")
_SLIGHT = re.compile(r"\b(?:bit|little|touch|tad|hair|teeny|slightly)\b|一[点些丢]|稍|略|偏")
_LACKING = re.compile(r", (?:to |in )?\{\w+\}|; wait\(\{duration\}\)")


@cache
def home_names() -> Gazetteer:
    """Return the names of the home that the writers had before them."""
    entries = vocabulary_of(Site.load(ROOT / "sites" / "home")).entries
    return Gazetteer({word: entry.id for entry in entries for word in entry.spellings})


def _slots(written: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for slot in written.split("; "):
        kind, _, words = slot.partition(":")
        found.setdefault(kind, words)
    return found


def _fillings(said: SentenceUnits, slots: Mapping[str, str]) -> dict[str, str]:
    """Return what may be filled in a label, by its mark."""
    places = list(dict.fromkeys(unit.place for unit in said.units if unit.place))
    folded = said.text.casefold()
    found = dict(zip("pq", places, strict=False))
    found |= {kind: f'"{slots[kind]}"' for kind in "tnw" if slots.get(kind)}
    anyone = _ANYONE.search(folded)
    if "n" not in found and anyone is not None:
        found["n"] = f'"{anyone[0]}"'
    if "t" not in found and "n" in found:
        found["t"] = found["n"]
    for unit in said.units:
        if unit.amount is not None:
            found[unit.amount[0].value] = write_amount(*unit.amount)
    slight = _SLIGHT.search(folded) is not None
    found.setdefault("length", "a bit")
    sides = [name for name, word in (("left", _LEFT), ("right", _RIGHT)) if word.search(folded)]
    found["side"] = sides[0] if len(sides) == 1 else "around"
    if slight and found["side"] != "around":
        found.setdefault(SlotKind.ANGLE.value, "a bit")
    if found["side"] == "around":
        found.pop(SlotKind.ANGLE.value, None)
    return found


def label_of(intent: str, said: SentenceUnits, slots: Mapping[str, str]) -> str | None:
    """Return the plan of an intent in the notation; None where it is left open."""
    form = _LABELS.get(intent)
    if form is None:
        return None
    fillings = _fillings(said, slots)
    for mark, text in fillings.items():
        form = form.replace(f"{{{mark}}}", text)
    form = _LACKING.sub("", form)
    return None if re.search(r"\{\w", form) else form


def earlier_examples() -> Iterator[PlanExample]:
    """Yield what can be learnt from the sentences of both languages."""
    for language in ("en", "zh"):
        lines = (EARLIER / f"people_{language}.tsv").read_text("utf-8").splitlines()
        for line in lines:
            writer, intent, sentence, written = line.split("\t")
            said = cut_units(sentence, home_names())
            label = label_of(intent, said, _slots(written))
            if label is None:
                continue
            try:
                example = make_example(f"{language}{writer}", intent, said, label)
            except (NotationError, KeyError):
                continue
            if example is not None:
                yield example
