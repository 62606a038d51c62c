"""Read steps back from their records, and put another place, person or words into them. Pure."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from planner.plan.base import Bilingual
from planner.plan.goal import StepRecord, places_of
from planner.plan.responses import StepPlan
from planner.plan.steps import Attempt, Find, If, Look, Patrol, Repeat, Say, Step
from planner.plan.tree import StepRole, children_of, list_nodes
from planner.plan.vocabulary import Vocabulary

_HOLDS = {
    "if": {"when": StepRole.WHEN, "then": StepRole.THEN, "otherwise": StepRole.OTHERWISE},
    "try": {"steps": StepRole.BODY, "on_failure": StepRole.ON_FAILURE},
    "repeat": {"steps": StepRole.BODY, "until": StepRole.UNTIL},
}
SEEKS = frozenset({"find", "go_to", "patrol"})
_SHOWN = set(
    {"kind", "place", "places", "object", "text", "question", "seconds", "angle_rad", "distance_m"}
    | {
        "span",
        "deeds",
        "look",
        "x",
        "y",
        "map_id",
        "x_m",
        "y_m",
        "yaw_rad",
        "times",
        "side",
        "word",
        "time",
        "after",
        "before",
        "tool",
        "arguments",
    }
)
"""What is asked of a step, and no result of it."""


def steps_of(records: Sequence[StepRecord]) -> tuple[Step, ...]:
    """Return the steps that records were made of, without what came of them."""
    tops = [at for at, each in enumerate(records) if each.depth == 0]
    return StepPlan.model_validate({"steps": [_fields(records, at) for at in tops]}).steps


def _fields(records: Sequence[StepRecord], at: int) -> dict[str, Any]:
    record = records[at]
    fields = record.model_dump(include=_SHOWN, exclude_defaults=True) | {"kind": record.kind}
    if record.kind in ("look", "ask", "decide"):
        fields["question"] = fields.pop("text", None)
    held = children_of(records, at)
    for name, role in _HOLDS.get(record.kind, {}).items():
        found = [_fields(records, each) for each in held if records[each].role is role]
        fields[name] = found if name not in ("when", "until") else next(iter(found), None)
    return fields


def places_in(steps: Sequence[Step]) -> set[str]:
    """Return all places that steps name."""
    return {place for node in list_nodes(steps) for place in places_of(node.step)}


def sought_thing(steps: Sequence[Step]) -> str | None:
    """Return the one thing that steps do nothing but search for; None where they do more."""
    things = {step.object for step in steps if isinstance(step, Find)}
    only = len(things) == 1 and all(step.kind in SEEKS for step in steps)
    return things.pop() if only else None


def room_of(names: Vocabulary, place: str) -> str | None:
    """Return the room in which a place stands; None of a room, and of what stands in none."""
    entry = names.by_id.get(place)
    return entry.room if entry is not None else None


def places_inside(names: Vocabulary, place: str | None) -> set[str]:
    """Return the places that stand in a room."""
    return {each.id for each in names.entries if place is not None and each.room == place}


def names_place(names: Vocabulary, words: str) -> bool:
    """Tell whether words name any place."""
    return any(_pattern(names, each.id).search(words) for each in names.entries)


def put_place(steps: Sequence[Step], names: Vocabulary, put: dict[str, str]) -> tuple[Step, ...]:
    """Return steps with other places, in the questions that they ask, too."""

    def change(step: Step) -> Step:
        changes: dict[str, object] = {}
        if (place := getattr(step, "place", None)) in put:
            changes["place"] = put[place]
        if isinstance(step, Patrol):
            changes["places"] = tuple(put.get(each, each) for each in step.places)
        if isinstance(step, Look):
            changes["question"] = _rename(names, step.question, put)
        return step.model_copy(update=changes)

    return tuple(_change_each(step, change) for step in steps)


def _rename(names: Vocabulary, words: str, put: dict[str, str]) -> str:
    for old, new in put.items():
        name = names.name(new)

        def write(found: re.Match[str], name: Bilingual = name) -> str:
            return name.en if found[0].isascii() else name.zh

        words = _pattern(names, old).sub(write, words)
    return words


def _pattern(names: Vocabulary, place: str) -> re.Pattern[str]:
    entry = names.by_id.get(place)
    spellings = sorted(entry.spellings if entry is not None else (place,), key=len, reverse=True)
    return re.compile(
        "|".join(
            rf"(?<![a-z0-9]){re.escape(each)}(?![a-z0-9])" if each.isascii() else re.escape(each)
            for each in spellings
        ),
        re.IGNORECASE,
    )


def put_name(steps: Sequence[Step], old: str | None, new: str) -> tuple[Step, ...] | None:
    """Return steps for another person or thing; None where they are for none, or for that one."""
    if not old or old.casefold() == new.casefold():
        return None
    edge = (r"(?<![a-z])", r"(?![a-z])") if old.isascii() else ("", "")
    name = re.compile(edge[0] + re.escape(old) + edge[1], re.IGNORECASE)

    def change(step: Step) -> Step:
        fields = [each for each in ("object", "text", "question") if getattr(step, each, None)]
        return step.model_copy(
            update={each: name.sub(lambda _: new, getattr(step, each)) for each in fields}
        )

    return tuple(_change_each(step, change) for step in steps)


def put_words(steps: Sequence[Step], person: str | None, words: str) -> tuple[Step, ...] | None:
    """Return steps that say other words, to the same person; None where they say none, or twice."""
    said = [step for step in steps if isinstance(step, Say)]
    if len(said) != 1:
        return None
    called = re.match(rf"{re.escape(person)}[,，] *", said[0].text) if person else None
    text = (called[0] if called is not None else "") + words
    return tuple(Say(text=text) if isinstance(step, Say) else step for step in steps)


def _change_each(step: Step, change: Callable[[Step], Any]) -> Step:
    """Return a step, and those that it holds, changed."""
    held: dict[str, object] = {}
    if isinstance(step, If | Attempt | Repeat):
        for name in _HOLDS[step.kind]:
            part = getattr(step, name)
            if isinstance(part, tuple):
                held[name] = tuple(_change_each(each, change) for each in part)
            elif part is not None:
                held[name] = change(part)
    changed: Step = change(step)
    return changed.model_copy(update=held)
