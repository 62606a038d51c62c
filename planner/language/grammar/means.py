"""Limit what a clause means to the kinds of steps that this robot can do. Pure."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain

from planner.language.grammar.parse_result import ClauseProblem, Meaning, Steps
from planner.plan import NEEDS_CAMERA, Code, GoTo, Patrol, Step, lacking


def limit_to_means(meaning: Meaning, runnable: frozenset[str], blind: Code) -> Meaning:
    """Turn steps that this robot can't do into the problem that it lacks the means."""
    if isinstance(meaning, ClauseProblem):
        can = tuple(step for step in meaning.before if step.kind in runnable)
        offered = chain(meaning.instead, *meaning.choices)
        if all(step.kind in runnable for step in offered):
            return replace(meaning, before=can)
        return ClauseProblem(blind, meaning.part, before=can)
    if isinstance(meaning, Steps) and "count" not in runnable:  # nothing to look with
        meaning = replace(meaning, steps=tuple(map(_without_look, meaning.steps)))
    lacks = (
        [s for s in meaning.steps if s.kind not in runnable] if isinstance(meaning, Steps) else []
    )
    if not lacks or not isinstance(meaning, Steps):
        return meaning
    code = blind if any(s.kind in NEEDS_CAMERA for s in lacks) else lacking(lacks[0])
    patrolled = [p for s in lacks if isinstance(s, Patrol) for p in s.places]
    can = tuple(s for s in meaning.steps if isinstance(s, GoTo))
    can = (*can, *(GoTo(place=place) for place in patrolled))
    return ClauseProblem(code, meaning.part, before=can)


def _without_look(step: Step) -> Step:
    return step.model_copy(update={"look": False}) if isinstance(step, Patrol) else step
