"""Do at each of several places what is ordered behind them: "go to the kitchen and the study and
count the chairs" counts in both, 去厨房和卧室看看 looks in both.

Several places are one order's list: the first with the verb, the others bare. A clause that goes on
with "there" left unsaid, and whose place follows where the robot is, is done at each; what is only
said or waited for is done at the last. A search ends where nothing is found, so it can't be done at
one place after the other ("find the cup in the kitchen and the study"): it is asked where. All
rooms are the whole home, which `find` and `count` search by themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from planner.language.catalogue import say
from planner.language.grammar.parse_result import Clause, Meaning, Problem, Reading, Steps
from planner.language.grammar.place_names import go_to
from planner.plan import MAX_STEPS, Bilingual, Code, Count, Find, GoTo, Look, Patrol, Step

WHICH = say("grammar.which_one")
TOO_MANY = say("grammar.too_many")
_LEAD = re.compile(r"^(?:back )?(?:to|into|in|inside|on) ")


@dataclass(frozen=True, slots=True)
class Heard:
    """Hold a clause with what it meant and the scene that it was read in."""

    clause: Clause
    meaning: Meaning
    reading: Reading

    def at(self, place: str, read: Callable[[Clause, Reading], Meaning]) -> Meaning:
        """Return what the clause would have meant, had the robot been at another place."""
        scene = replace(self.reading.scene, place=place)
        return read(self.clause, replace(self.reading, scene=scene))


def at_each(
    heard: Sequence[Heard], read: Callable[[Clause, Reading], Meaning]
) -> tuple[Meaning, ...]:
    """Return the meanings of all clauses, what follows several places done at each of them."""
    meanings: list[Meaning] = []
    at = 0
    while at < len(heard):
        places, acts = _list(heard, at)
        end = _end(heard, acts, places, read)
        searched = _searched(heard, at)
        if len(searched) > 1:
            meanings.append(_searching(heard[at : at + len(searched)]))
            at += len(searched)
        elif end > acts:
            meanings.append(_spread(heard[acts:end], places, read))
            at = end
        else:
            meanings.append(heard[at].meaning)
            at += 1
    return tuple(meanings)


def _list(heard: Sequence[Heard], at: int) -> tuple[tuple[str, ...], int]:
    """Return the places that are listed from a clause on, and the clause behind the list."""
    places = _goals(heard[at].meaning)
    after = at + 1
    while places and after < len(heard) and _bare(heard[after]):
        places += _goals(heard[after].meaning)
        after += 1
    return tuple(dict.fromkeys(places)), after


def _goals(meaning: Meaning) -> tuple[str, ...]:
    """Return where a clause drives: of a way from place to place its end, of a round all."""
    steps = meaning.steps if isinstance(meaning, Steps) else ()
    if len(steps) == 1 and isinstance(steps[0], Patrol):
        return steps[0].places
    goals = [step.place for step in steps if isinstance(step, GoTo)]
    return tuple(goals[-1:]) if len(goals) == len(steps) else ()


def _bare(heard: Heard) -> bool:
    """Tell whether a clause is one more place of a list, without a verb of its own."""
    return _place_alone(heard) and bool(_goals(heard.meaning))


def _end(
    heard: Sequence[Heard],
    acts: int,
    places: tuple[str, ...],
    read: Callable[[Clause, Reading], Meaning],
) -> int:
    """Return the clause behind those that are done wherever the robot is."""
    end = acts
    while len(places) > 1 and end < len(heard) and _follows(heard[end], places, read):
        end += 1
    return end


def _follows(
    heard: Heard, places: tuple[str, ...], read: Callable[[Clause, Reading], Meaning]
) -> bool:
    looked = _looked_in(heard.meaning)
    return looked == {places[-1]} and _looked_in(heard.at(places[0], read)) == {places[0]}


def _looked_in(meaning: Meaning) -> set[str | None]:
    steps = meaning.steps if isinstance(meaning, Steps) else ()
    return {step.place for step in steps if isinstance(step, Find | Count | Look)}


def _spread(
    acts: Sequence[Heard], places: tuple[str, ...], read: Callable[[Clause, Reading], Meaning]
) -> Meaning:
    """Return what the clauses order, done at each place; or the question where."""
    meanings = [act.meaning for act in acts if isinstance(act.meaning, Steps)]
    steps = [step for meaning in meanings for step in meaning.steps]
    rooms = {e.id for e in acts[0].reading.vocabulary.entries if e.kind == "room"}
    whole = tuple(_anywhere(step) for step in steps)
    here = meanings[-1]
    if rooms <= set(places) and not any(isinstance(step, Look) for step in steps):
        return replace(here, steps=whole)
    each = tuple(_at(acts, place, read) for place in places)
    if any(isinstance(step, Find) for step in steps):
        only = all(isinstance(step, Find | Count) for step in steps)
        return _ask(acts, WHICH, (*each, whole) if only else each)
    if sum(map(len, each)) > MAX_STEPS:
        return _ask(acts, TOO_MANY, ())
    return replace(here, steps=tuple(step for done in each for step in done))


def _searched(heard: Sequence[Heard], at: int) -> tuple[Find, ...]:
    """Return the searches for one thing in several places: "find the cup here and there"."""
    finds: list[Find] = []
    for one in heard[at:]:
        steps = one.meaning.steps if isinstance(one.meaning, Steps) else ()
        last = steps[-1] if steps else None
        again = not finds or (isinstance(last, Find) and last.object == finds[0].object)
        if not isinstance(last, Find) or not again or (finds and not _place_alone(one)):
            break
        finds.append(last)
    return tuple(finds)


def _place_alone(heard: Heard) -> bool:
    named = go_to(_LEAD.sub("", heard.clause.text), heard.reading)
    return isinstance(named, Steps)


def _searching(searches: Sequence[Heard]) -> Problem:
    each = tuple(one.meaning.steps for one in searches if isinstance(one.meaning, Steps))
    return _ask(searches, WHICH, (*each, (_anywhere(each[0][-1]),)))


def _anywhere(step: Step) -> Step:
    return step.model_copy(update={"place": None}) if isinstance(step, Find | Count) else step


def _at(
    acts: Sequence[Heard], place: str, read: Callable[[Clause, Reading], Meaning]
) -> tuple[Step, ...]:
    done = [act.at(place, read) for act in acts]
    steps = (step for meaning in done if isinstance(meaning, Steps) for step in meaning.steps)
    return (GoTo(place=place), *steps)


def _ask(acts: Sequence[Heard], what: Bilingual, choices: tuple[tuple[Step, ...], ...]) -> Problem:
    reading = acts[0].reading
    part = ", ".join(act.clause.text for act in acts)
    return Problem(Code.INCOMPLETE, reading.marked.restore(part), what=what, choices=choices)
