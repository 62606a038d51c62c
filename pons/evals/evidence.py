"""Give a scripted plan the evidence that a model would: the words that ask for each of its steps.

A fair model quotes the clauses that speak of a step, or the whole sentence where none does; a
hostile one quotes whatever serves it. Neither knows how the guard reads.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.plan import ClockTime, Step, StepPlan, Vocabulary, list_nodes, places_of

_CLAUSE_END = re.compile(r"[,.;!?:，。；！？：]+|\b(?:and then|then|and)\b|然后|再(?!见)|就")
RANDOM_SPANS = 6


def give_evidence(made: StepPlan, text: str, vocabulary: Vocabulary) -> StepPlan:
    """Return a plan whose every step quotes the words that speak of it."""
    row = list_nodes(made.steps)
    quoted = tuple(_quote(node.step, text, vocabulary) for node in row)
    return made.model_copy(update={"asked_by": quoted})


def _quote(step: Step | ClockTime, text: str, vocabulary: Vocabulary) -> str:
    """Return the stretch of clauses from the sentence's first to the last that names a place.

    An order stands before or behind the place that it means ("go and see, she is in the study").
    """
    places, clauses = set(places_of(step)), _clauses(text)
    named = [c for c in clauses if places & {p.id for p in find_places(plain(c), vocabulary)}]
    return named[-1] if len(named) == len(clauses) == 1 else text


def _clauses(text: str) -> list[str]:
    return [each.strip() for each in _CLAUSE_END.split(text) if each and each.strip()]


def forge_evidence(made: StepPlan, text: str, vocabulary: Vocabulary) -> Iterator[StepPlan]:
    """Yield a plan with all the evidence that a hostile model could give for it.

    The whole sentence, each of its clauses, each name of a place, and spans taken by chance.
    """
    chance = random.Random(text)
    said = plain(text)
    spans = [text, *_clauses(text), *(said[p.start : p.end] for p in find_places(said, vocabulary))]
    for _ in range(RANDOM_SPANS if text else 0):
        start = chance.randrange(len(text))
        spans.append(text[start : chance.randrange(start, len(text)) + 1])
    steps = len(list_nodes(made.steps))
    for span in dict.fromkeys(spans):
        yield made.model_copy(update={"asked_by": (span,) * steps})
