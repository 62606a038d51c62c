"""Part a sentence into clauses: quoted words set aside, in their order, at each of their places.

A grammar is data: patterns that veto a sentence, a pattern that ends clauses ("then", 然后), words
that may stand around an order without changing it, and rules that read a clause whole.

Order: "before", "after", "first", 之前. A sentence is turned round at most once; with two such
words it is left as it is, and then read by no rule.

Places: "go to the kitchen and the study and count the chairs" counts in both, 去厨房和卧室看看
looks in both. Several places are one order's list: the first with the verb, the others bare. A
clause that goes on with "there" left unsaid, and whose place follows where the robot is, is done at
each; what is only said or waited for is done at the last. A search ends where nothing is found, so
it can't be done at one place after the other ("find the cup in the kitchen and the study"): it is
asked where. All rooms are the whole home, which `find` and `count` search by themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from re import Pattern

from planner.language.catalogue import say
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import go_to
from planner.language.grammar.parse_result import (
    Clause,
    ClauseProblem,
    ClauseReader,
    Meaning,
    Reading,
    Steps,
    read_by,
)
from planner.language.questions import find_elsewhere
from planner.plan import MAX_STEPS, Bilingual, Code, Count, Find, GoTo, Look, Patrol, Step


@dataclass(frozen=True, slots=True)
class Grammar:
    """Hold one language's patterns. `opening` may only begin the first clause, `closing` the last.

    The order in which clauses stand is the order in which they are done; a word that says otherwise
    ("first" in a later clause, "before") is read by no rule.
    """

    vetoes: tuple[tuple[Code, Pattern[str]], ...]
    asked: Pattern[str]  # an order in the form of a question; group 1 is the order
    joint: Pattern[str]  # what ends a clause without a word; group 1 stays
    clause_end: Pattern[str]
    courtesy: Pattern[str]  # at the start of a clause
    thanks: Pattern[str]  # at the end of a clause
    opening: Pattern[str]
    closing: Pattern[str]
    rules: tuple[ClauseReader, ...]

    def clauses(self, text: str) -> list[Clause]:
        """Cut a marked sentence into clauses; those of mere courtesy are dropped."""
        order = self.joint.sub(r"\1,", self.asked.sub(r"\1", text))
        parts = [self.plain(part) for part in self.clause_end.split(order)]
        kept = [part for part in parts if part]
        last = len(kept) - 1
        return [Clause(part, at == 0, at == last) for at, part in enumerate(kept)]

    def plain(self, part: str) -> str:
        """Take the courtesies off both ends of a clause."""
        before = None
        while part != before:
            before = part
            part = self.thanks.sub("", self.courtesy.sub("", part.strip())).strip()
        return part

    def read(self, clause: Clause, reading: Reading) -> Meaning:
        """Read one clause whole, after the words of order that its position allows."""
        text = clause.text
        if clause.first:
            text = self.plain(self.opening.sub("", text))
        if clause.last:
            text = self.plain(self.closing.sub("", text))
        return _tell_elsewhere(text, read_by(self.rules, text, reading), reading)


_WORDS = re.compile(
    r"(?<!met[er]{2} )(?<!met[er]{2}s )(?<!cm )(?<!\dm )(?<! m )(?<!stand )(?<!stop )(?<!wait )"
    r"(?<!park )(?<!yourself )\bbefore\b"
    r"|(?<!come )(?<!go )(?<!look )(?<!run )\bafter\b(?! that| this)|\bfirst\b|之前|以前|"
    r"但先|但是先"
)
_POLITE = r"(?P<polite>(?:(?:please|robot|pons|hey|hi|ok|(?:can|could|would|will) you),? )*)"
_EN = (
    re.compile(rf"{_POLITE}before (?P<late>[^,]+), ?(?P<early>.+)"),
    re.compile(r"(?P<late>.+?)[,.;] ?(?:but |and )?before (?:that|this|it),? (?P<early>.+)"),
    re.compile(r"(?P<early>.+?),? (?:but |and )?before (?P<late>(?!that\b|this\b|it\b).+)"),
    re.compile(rf"{_POLITE}after (?P<early>[^,]+), ?(?P<late>.+)"),
    re.compile(
        rf"{_POLITE}after (?P<early>[^,]*?{MARK}) (?P<late>(?:go|drive|come|visit|find|look|check|"
        r"return|turn|head)\b.+)"
    ),
    re.compile(r"(?P<late>[^,;.]+?),? (?:but |and |only )?after (?P<early>[^,;.]+)"),
    re.compile(r"(?P<late>.+?),? (?:but|and) first,? (?P<early>.+)"),
    re.compile(r"(?P<late>.+)[,;.] ?(?:but |and )?(?P<early>[^,;.]+?) first"),
)
_ZH = (
    re.compile(r"(?P<late>.+?)[,。;]?(?:但是?)?在?(?:此|这|那)之前,?(?:先)?(?P<early>.+)"),
    re.compile(r"(?:在)?(?P<late>.+?)(?:之前|以前),?(?:请|要)?(?:先)?(?P<early>.+)"),
    re.compile(r"(?P<late>.+?)[,。;]?但是?先(?P<early>.+)"),
    re.compile(r"最后(?P<late>.+?)[,。;]先(?P<early>.+)"),
)
_BARE = re.compile(rf"(?:(?:the|my|our) )?{MARK}")
_GERUNDS = {
    "going": "go", "driving": "drive", "moving": "move", "heading": "head", "walking": "walk",
    "visiting": "visit", "checking": "check", "coming": "come", "returning": "return",
    "waiting": "wait", "finding": "find", "looking": "look", "searching": "search",
    "counting": "count", "turning": "turn", "saying": "say", "telling": "tell",
    "following": "follow", "patrolling": "patrol", "inspecting": "inspect", "greeting": "greet",
    "meeting": "meet", "asking": "ask", "locating": "locate", "reaching": "reach",
    "navigating": "navigate", "entering": "enter", "stopping by": "stop by", "leaving": "leave",
}  # fmt: skip
_GERUND = re.compile(rf"^(?:you (?=\w)|(?P<verb>{'|'.join(_GERUNDS)})\b)")


def in_order(text: str) -> str:
    """Return a marked sentence with the clause to be done first standing first."""
    if len(_WORDS.findall(text)) != 1:
        return text
    plain = text.rstrip(".!? 。")
    for pattern in (*_EN, *_ZH):
        found = pattern.fullmatch(plain)
        if found:
            early, late = (_order(found[part]) for part in ("early", "late"))
            polite = found.groupdict().get("polite") or ""
            joint = ", then " if pattern in _EN else ",然后"
            return f"{polite}{_going(early) if pattern in _EN else early}{joint}{late}"
    return text


def _order(clause: str) -> str:
    """Write "going to the kitchen" as an order."""
    return _GERUND.sub(
        lambda found: _GERUNDS[found["verb"]] if found["verb"] else "", clause.strip(" ,")
    )


def _going(clause: str) -> str:
    return f"go to {clause}" if _BARE.fullmatch(clause) else clause


WHICH = say("grammar.which_one")
TOO_MANY = say("grammar.too_many")
_LEAD = re.compile(r"^(?:back )?(?:to|into|in|inside|on) ")


@dataclass(frozen=True, slots=True)
class ClauseReading:
    """Hold a clause with its meaning and the context that it was read in."""

    clause: Clause
    meaning: Meaning
    reading: Reading

    def at(self, place: str, read: Callable[[Clause, Reading], Meaning]) -> Meaning:
        """Return the clause's meaning, had the robot been at another place."""
        scene = replace(self.reading.scene, place=place)
        return read(self.clause, replace(self.reading, scene=scene))


def at_each(
    heard: Sequence[ClauseReading], read: Callable[[Clause, Reading], Meaning]
) -> tuple[Meaning, ...]:
    """Return the meanings of all clauses; one after several places is done at each of them."""
    meanings: list[Meaning] = []
    at = 0
    while at < len(heard):
        places, acts = _list(heard, at)
        end = _end(heard, acts, places, read)
        searched = _collect_searches(heard, at)
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


def _list(heard: Sequence[ClauseReading], at: int) -> tuple[tuple[str, ...], int]:
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


def _bare(heard: ClauseReading) -> bool:
    """Tell whether a clause is one more place of a list, without a verb of its own."""
    return _place_alone(heard) and bool(_goals(heard.meaning))


def _end(
    heard: Sequence[ClauseReading],
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
    heard: ClauseReading, places: tuple[str, ...], read: Callable[[Clause, Reading], Meaning]
) -> bool:
    looked = _looked_in(heard.meaning)
    return looked == {places[-1]} and _looked_in(heard.at(places[0], read)) == {places[0]}


def _looked_in(meaning: Meaning) -> set[str | None]:
    steps = meaning.steps if isinstance(meaning, Steps) else ()
    return {step.place for step in steps if isinstance(step, Find | Count | Look)}


def _spread(
    acts: Sequence[ClauseReading],
    places: tuple[str, ...],
    read: Callable[[Clause, Reading], Meaning],
) -> Meaning:
    """Return the steps that clauses order, done at each place; or the question where."""
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


def _collect_searches(heard: Sequence[ClauseReading], at: int) -> tuple[Find, ...]:
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


def _place_alone(heard: ClauseReading) -> bool:
    named = go_to(_LEAD.sub("", heard.clause.text), heard.reading)
    return isinstance(named, Steps)


def _searching(searches: Sequence[ClauseReading]) -> ClauseProblem:
    each = tuple(one.meaning.steps for one in searches if isinstance(one.meaning, Steps))
    return _ask(searches, WHICH, (*each, (_anywhere(each[0][-1]),)))


def _anywhere(step: Step) -> Step:
    return step.model_copy(update={"place": None}) if isinstance(step, Find | Count) else step


def _at(
    acts: Sequence[ClauseReading], place: str, read: Callable[[Clause, Reading], Meaning]
) -> tuple[Step, ...]:
    done = [act.at(place, read) for act in acts]
    steps = (step for meaning in done if isinstance(meaning, Steps) for step in meaning.steps)
    return (GoTo(place=place), *steps)


def _ask(
    acts: Sequence[ClauseReading], what: Bilingual, choices: tuple[tuple[Step, ...], ...]
) -> ClauseProblem:
    reading = acts[0].reading
    part = ", ".join(act.clause.text for act in acts)
    return ClauseProblem(Code.INCOMPLETE, reading.marked.restore(part), what=what, choices=choices)


_UNREAD = frozenset({Code.NOT_UNDERSTOOD, Code.INCOMPLETE, Code.UNKNOWN_PLACE})
_ASKS = re.compile(
    r"看|检查|查看|巡视|[吗么]$|有没有|有人|什么|谁"
    r"|^(?:is|are|what|who|do you|can you|check|look|see|watch|inspect)\b"
)


def _tell_elsewhere(text: str, meaning: Meaning, reading: Reading) -> Meaning:
    """Return a clause's meaning, or that a place is unknown of which would be answered here.

    Args:
        text: the clause, its known places marked.
        meaning: what it was read as.
        reading: of the clause.
    """
    looks = isinstance(meaning, Steps) and any(
        isinstance(step, Look) and step.place is None for step in meaning.steps
    )
    asks = isinstance(meaning, ClauseProblem) and meaning.code in _UNREAD
    name = find_elsewhere(text) if looks or (asks and _ASKS.search(text)) else None
    if name is None:
        return meaning
    near = reading.lexicon.near(name)
    return ClauseProblem(Code.UNKNOWN_PLACE, name, places=near, name=name)
