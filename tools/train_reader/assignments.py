"""Print assignments for writers: plans by seed, each with a persona, a situation and a home.

``python -m tools.train_reader.assignments --language en --count 400 --seed 7``. A line is id,
language, persona, situation, home, label and an empty field for the words that a writer gives.
"""

from __future__ import annotations

import argparse
import sys
from random import Random
from typing import TYPE_CHECKING

from planner.language.semantic_parser.normal_plan import normalise_plan
from planner.language.semantic_parser.plan_grammar import parse_plan, render_plan
from tools.train_reader.drawn_plans import (
    PlanDraw,
    draw_condition,
    draw_several,
    draw_simple,
    words_of,
)
from tools.train_reader.sentences import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Callable


def _several_or_simple(draw: PlanDraw) -> str:
    return draw_simple(draw) if draw.often(0.6) else draw_several(draw)


def _add_hint(hint: str, make: Callable[[PlanDraw], str]) -> Callable[[PlanDraw], str]:
    """Return a draw with a hint; ``{other}`` in it is a place or a thing, as the label has."""

    def make_one(draw: PlanDraw) -> str:
        label = make(draw)
        others = ((draw.place, "in "), (draw.place, "go("), (lambda: draw.one("things"), 'find("'))
        other = next((other for other, mark in others if mark in label), None)
        if other is None and "{other}" in hint:
            return make_one(draw)
        text = hint.replace("{other}", other()) if other else hint
        draw.hint = text.replace("{p}", draw.place()) if "{p}" in text else text
        return label

    return make_one


def _ordering_nothing(section: str) -> Callable[[PlanDraw], str]:
    def make_one(draw: PlanDraw) -> str:
        draw.hint = f"orders nothing: {draw.fill(section)}"
        return "none"

    return make_one


def _draw_refusal(draw: PlanDraw) -> str:
    place = f", {draw.place()} is named" if draw.often(0.6) else ""
    draw.hint = f"asks for what wheels and a camera can't do: {draw.fill('beyond')}{place}"
    return "refuse"


def _standing(draw: PlanDraw) -> str:
    chance = draw.random.random()
    section = "times once" if chance < 0.45 else "times again" if chance < 0.85 else "events"
    when = draw.one(section)
    remind = f'say("{draw.one("sayings")}")'
    steps = remind if draw.often(0.3) else _several_or_simple(draw)
    draw.hint = "reminds of words" if steps == remind else ""
    return f'at("{when}") {{ {steps} }}'


def _draw_order_change(draw: PlanDraw) -> str:
    which = f'"{draw.one("order names")}"'
    day = f'when "{draw.one("order days")}"'
    return draw.pick(
        "orders",
        f"orders({which})",
        f"orders({day})",
        f"order_remove({which})",
        "order_remove",
        f"order_pause({which})",
        f"order_resume({which})",
        f"order_skip({which}, {day})",
        f"order_skip({day})",
        f'order_move({which}, to "{draw.one("times once")}")',
        f'order_move(to "{draw.one("times once")}")',
    )


def _follow_up(draw: PlanDraw) -> str:
    steps = _several_or_simple(draw)
    return draw.pick(
        f"after {{ {steps} }}",
        f"after {{ {steps} }}",
        f"instead {{ {steps} }}",
        f"instead {{ {steps} }}",
        f"first {{ {steps} }}",
        f"slowly {{ {steps} }}",
        f"skip({draw.place()})",
        f"also({draw.place()})",
        f"also_thing({draw.thing()})",
        f"change_place({draw.place()})",
        f"change_place({draw.place()})",
        f"change_thing({draw.thing()})",
        "again",
        f"again({draw.pick('2 times', '3 times')})",
        "more",
        "less",
        "other",
        "go(there)",
        f"find(it{draw.in_place(0.7)})",
        "check(it, in there)",
    )


def _draw_memory(draw: PlanDraw) -> str:
    when = f', when "{draw.one("past")}"' if draw.often(0.35) else ""
    chance = draw.random.random()
    if chance < 0.75:
        what = draw.thing() if draw.often(0.6) else draw.somebody()
        return f"recall({what}{draw.in_place(0.3)}{when})"
    return draw.pick(f"deeds({when[2:]})" if when else "deeds", f"recall(in {draw.place()}{when})")


def _fact(draw: PlanDraw) -> str:
    return draw.pick(
        f'fact("{draw.one("facts")}")',
        f'fact("{draw.one("facts")}")',
        f'fact("{draw.one("facts")}")',
        f'forget("{draw.one("fact topics")}")',
        f'name_here("{draw.one("here names")}")',
        f"here({draw.place()})",
    )


def _command(draw: PlanDraw) -> str:
    return draw.pick("stop", "stop", "stop", "cancel", "pause", "resume", "slower", "faster")


CATEGORIES: tuple[tuple[str, float, Callable[[PlanDraw], str]], ...] = (
    ("plain", 11, draw_simple),
    ("indirect", 6, _add_hint("says it indirectly: as a wish, a worry or a question", draw_simple)),
    ("several", 17, draw_several),
    ("condition", 15, draw_condition),
    ("denial", 6, _ordering_nothing("denials")),
    ("mixed denial", 4, _add_hint("says as well that it shall NOT go to {p}", _several_or_simple)),
    ("correction", 6, _add_hint("says {other} first, then corrects himself", _several_or_simple)),
    ("which", 3, _add_hint("says which of two: not {other}, but the label's", _several_or_simple)),
    ("first person", 4, _ordering_nothing("first person")),
    ("first person", 3, _add_hint("says as well that he himself goes to {p}", _several_or_simple)),
    ("talk", 6, _ordering_nothing("talk")),
    ("beside talk", 4, _add_hint("tells something about {p} beside the order", _several_or_simple)),
    ("standing", 8, _standing),
    ("managed", 2, _draw_order_change),
    ("follow-up", 6, _follow_up),
    ("memory", 4, _draw_memory),
    ("fact", 2, _fact),
    ("refuse", 3, _draw_refusal),
    ("command", 2, _command),
)  # fmt: skip
_SITUATIONS = (
    "robot idle at its dock",
    "robot idle at its dock",
    "robot idle, beside the person",
    "robot idle in {p}",
    "robot driving to {p}",
    "robot looking for {t}",
    "robot on its rounds, now in {p}",
    "robot has just come from {p} and told what it saw",
    "robot waiting at {p}",
)
_BEFORE = ("go to {p}", "find {t}", "look in {p}")
_BEFORE_MOVES = ("move forward", "turn left", "come closer", "back up")
_LEANING = frozenset(
    {"after", "first", "instead", "skip", "also", "also_thing", "change_place"}
) | {*("change_thing", "again", "more", "less", "other")}
"""Forms that have a meaning by the order before alone; ``there`` and ``it`` have as well."""
_NO_EARLIER_SHARE = 0.5


def _said_before(form: str, label: str, random: Random) -> str:
    """Return the order before that a label leans on, or any; empty where none was given."""
    if form in ("more", "less", "other"):
        return random.choice(_BEFORE_MOVES)
    if form == "skip":
        return f"look in {{p}}, {label[5:-1]} and {{q}}"
    if form in ("also_thing", "change_thing") or "(it" in label:
        return "find {t} in {p}"
    if form in _LEANING or "there" in label:
        return random.choice((_BEFORE[0], _BEFORE[2]))
    return "" if random.random() < _NO_EARLIER_SHARE else random.choice(_BEFORE)


def draw_assignment(random: Random, language: str) -> tuple[str, str, str, str, str]:
    """Return category, persona, situation, home and label of one assignment."""
    category, _, make = random.choices(CATEGORIES, [weight for _, weight, _ in CATEGORIES])[0]
    draw = PlanDraw(random, language)
    label = render_plan(normalise_plan(parse_plan(make(draw))))
    words = words_of(language)
    persona = f"{random.choice(words['personas'])}; {random.choice(words['moods'])}"
    form = label.split("(")[0].split()[0]
    before = _said_before(form, label, random)
    state = random.choice(_SITUATIONS[4:] if form in _LEANING else _SITUATIONS)
    parts = (state, before and f"said before: {before}", draw.hint and f"HOW: {draw.hint}")
    situation = "; ".join(part for part in parts if part).replace("{q}", draw.place())
    situation = situation.replace("{p}", draw.place()).replace("{t}", draw.one("things"))
    return category, persona, situation, " | ".join(draw.home), label


def main() -> None:
    """Print so many assignments of one language."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", choices=("en", "zh"), required=True)
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--seed", type=int, required=True)
    told = parser.parse_args()
    random = Random(f"{told.language}{told.seed}")
    sys.stdout.write("\t".join(COLUMNS) + "\n")
    for number in range(told.count):
        category, persona, situation, home, label = draw_assignment(random, told.language)
        id_ = f"{told.language}{told.seed:02d}-{number:03d}-{category.replace(' ', '_')}"
        row = (id_, told.language, persona, situation, home, label, "")
        sys.stdout.write("\t".join(row) + "\n")


if __name__ == "__main__":
    main()
