"""Find what a plan would move that the words given as evidence for it do not ask for.

Laws: each step that moves names the words of the person that ask for it, and the clause around them
is judged, never the words alone. It must be an order to the robot that is not denied, past,
supposed or somebody else's; it names the place, or leads to the one place that the words name; what
stands on a condition is done in a branch. Only what a person said counts, never what a brain asked
(a plain yes makes the question that it answers the person's own). In doubt a step is unasked: a
person is then asked, and nothing else. Where all is asked for by these laws, but the learned reader
is sure that the sentence orders nothing, nothing counts as asked for.
"""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass, replace

from planner.language.motion_guard.branch_words import (
    BranchPath,
    may_both,
    path_of,
    select_of_branch,
)
from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.clauses import SaidClause, read_clauses
from planner.language.motion_guard.meant_places import GAP, MeantPlaces, join_clauses, leans_back
from planner.language.motion_guard.mentioned_names import places_named, plain
from planner.language.motion_guard.step_words import evidence, makes_way, moves, unsaid_kind
from planner.language.questions import looks_round
from planner.language.semantic_parser.parser import still_share
from planner.language.yes_no import consents
from planner.plan import (
    ClockTime,
    Count,
    If,
    Look,
    Patrol,
    PlanRole,
    Repeat,
    Step,
    StepNode,
    StepPlan,
    StepRole,
    Vocabulary,
    list_nodes,
    parents_of,
    places_of,
)

_QUIET = frozenset({"look", "find", "count", "go_to_object"})
"""Steps by which a question is answered."""
_LEARNS = frozenset({"look", "find", "count"})
"""Steps that learn whether a condition holds."""
_WAITS = frozenset({"ask", "wait_for"})
"""Behind them a condition of the words has come true, or somebody was asked."""
_UPON = frozenset(
    {StepRole.WHEN, StepRole.THEN, StepRole.OTHERWISE, StepRole.ON_FAILURE, StepRole.UNTIL}
)
_REPEATS = re.compile(
    r"\b(?:twice|thrice|times|again|repeat|loop|keep|over and over|back and forth|laps?)\b"
    r"|[二两三四五六七八九十几\d]\s*[次遍趟圈回]|来回|反复|一直|轮流|不断|循环|往返"
)
_ROUNDS_SAID = re.compile(
    rf"{_REPEATS.pattern}|\b(?:until|till|while|as long as|every|for [a-z0-9]+ (?:minutes?|hours?"
    r"|seconds?)|rounds?)\b|直到|等到|为止|每|分钟|小时|秒|轮"
)
_STILL = 0.9
"""From this share on the learned reader's word adds a question; it never spares one."""
_BACK = re.compile(r"\bback\b|回[来去]|[带领送]回")


@dataclass(frozen=True, slots=True)
class PersonWords:
    """Hold what a person said about one goal, and the facts that the words lean on."""

    words: tuple[str, ...]
    """The order and the answers about it, oldest first; also the order that it continues."""
    room: str | None = None
    """Where the robot is."""
    agreed: tuple[str, ...] = ()
    """Of the words, a brain's questions that got a plain yes: what they ask is ordered."""
    checked: bool = False
    """This goal has looked or asked already: what stood on a condition may be done."""
    before: tuple[str, ...] = ()
    """What "it", "there" and "again" lean on: earlier orders, newest first, with their finds."""


@dataclass(frozen=True, slots=True)
class UnaskedStep:
    """Name one step that nobody asked for, and why that is thought."""

    index: int
    why: str


def said_words(order: str, exchanges: tuple[tuple[str, str], ...]) -> tuple[str, ...]:
    """Return a person's words: order and answers, and a question that got a plain yes.

    Args:
        order: what was said first.
        exchanges: each question about it, with its answer.
    """
    said = [order]
    for asked, answer in exchanges:
        said.append(asked if consents(answer) is True else answer)
    return tuple(each for each in said if each)


def can_move(step: Step | ClockTime) -> bool:
    """Tell whether a step moves the robot, turning about to look included."""
    turns_about = isinstance(step, Look) and looks_round(step.question)
    return moves(step) or isinstance(step, Count) or turns_about


def find_unasked(
    made: StepPlan, person: PersonWords, vocabulary: Vocabulary, *, by_all_words: bool = False
) -> tuple[UnaskedStep, ...]:
    """Return the steps that move the robot and that nobody asked for. Never raises.

    Args:
        made: the plan; its ``asked_by`` holds the evidence of each step of its row.
        person: whose words count.
        vocabulary: the names of places.
        by_all_words: every word is evidence: the plan's reader has read them all.
    """
    judge = _Judge(person, vocabulary)
    row = list_nodes(made.steps)
    given = made.asked_by if len(made.asked_by) == len(row) else ("",) * len(row)
    found, waited = [], person.checked
    for index, node in enumerate(row):
        if can_move(node.step):
            quoted = None if by_all_words else given[index]
            why = judge.find_fault(row, index, quoted, upon=waited)
            found += [UnaskedStep(index, why)] if why else []
        waited = waited or node.step.kind in _WAITS
    # The reader hears the sentence alone: what replaces or follows an order leans on that.
    stands_alone = made.does is PlanRole.NEW and not by_all_words
    if found or not stands_alone or not _orders_nothing(person, vocabulary):
        return tuple(found)
    why = "the learned reader hears no order to drive in these words"
    return tuple(UnaskedStep(i, why) for i, node in enumerate(row) if can_move(node.step))


def _orders_nothing(person: PersonWords, vocabulary: Vocabulary) -> bool:
    """Tell whether the learned reader takes a person's words for no order; what leans, it can't."""
    alone = len(person.words) == 1 and not person.agreed
    return alone and still_share(person.words[0], vocabulary) >= _STILL


class _Judge:
    """Judge the steps of one plan in their order; counts how often each thing is done."""

    def __init__(self, person: PersonWords, vocabulary: Vocabulary) -> None:
        self._vocabulary, self._room = vocabulary, person.room
        self._texts = tuple(
            (plain(words), _as_ordered(words, person, read_clauses(words, vocabulary)))
            for words in person.words
        )
        every = [clause for _, clauses in self._texts for clause in clauses]
        self._every = every
        self._meant = MeantPlaces(tuple(every), person.room, vocabulary, person.before)
        self._things = GAP.join(
            f"{c.text}{c.speech}" for c in every if c.mood is not ClauseMood.DENIED
        )
        self._ordered = join_clauses(c for c in every if c.mood is ClauseMood.ORDER)
        leans = leans_back(c for c in every if c.mood is ClauseMood.ORDER)
        self._spoken_of = GAP.join((self._things, *(person.before if leans else ())))
        self._repeats = _REPEATS.search(self._ordered)
        self._done: defaultdict[str, list[BranchPath]] = defaultdict(list)
        self._arrivals: list[tuple[str, BranchPath, frozenset[int]]] = []
        self._at = ""

    def find_fault(
        self, row: tuple[StepNode, ...], index: int, quoted: str | None, *, upon: bool
    ) -> str:
        """Return why a step is unasked; empty where it is asked.

        Args:
            row: all steps of the plan.
            index: which of them is judged.
            quoted: the words that are said to ask for it; None: all of them.
            upon: what stands on a condition may be done.
        """
        step = row[index].step
        if any(c.beyond for c in self._every):
            return "the order itself is beyond the robot"
        roles = {row[i].role for i in (index, *parents_of(row, index))}
        touched = self._find_clauses(quoted)
        if not touched:
            return "no words of the person are named for it"
        if makes_way(step, join_clauses(touched)):
            return ""
        looked = _is_looked_next(row, index)
        usable, why = self._select(touched, step, roles, upon=upon, looked=looked)
        if quoted is None and usable:
            return self._why_elsewhere(step)
        usable = select_of_branch(usable, self._every, roles)
        if not usable:
            return why or "the words given stand in the other branch"
        if not places_of(step):
            self._at = ""  # wherever it leads
        said = join_clauses(usable)
        hung = roles & {StepRole.WHEN, StepRole.UNTIL}
        return (
            self._why_places(step, usable, path_of(row, index))
            or ("" if hung and isinstance(step, Look) else self._why_kind(step, said))
            or self._why_often(row, index, said)
        )

    def _find_clauses(self, quoted: str | None) -> list[SaidClause]:
        """Return the clauses that the evidence touches, of the newest words that hold it."""
        if quoted is None:
            return self._every
        span = plain(quoted).strip(" .,;!?。，！？；\"'")
        for said, clauses in reversed(self._texts):
            at = _find(said, span)
            if at is not None:
                end = at + len(span)
                return [c for c in clauses if c.start < end and at < c.end]
        return []

    def _select(
        self,
        touched: list[SaidClause],
        step: Step | ClockTime,
        roles: set[StepRole | None],
        *,
        upon: bool,
        looked: ClauseMood | None,
    ) -> tuple[list[SaidClause], str]:
        """Return the clauses that ask for a step of this kind, or why none does."""
        moods = {ClauseMood.ORDER}
        if step.kind in _QUIET or looked is not None:
            moods.add(ClauseMood.QUESTION)
        if StepRole.WHEN in roles or StepRole.UNTIL in roles:
            moods |= {ClauseMood.CONDITION, ClauseMood.QUESTION}
        if looked is ClauseMood.CONDITION or step.kind in _LEARNS:
            moods.add(ClauseMood.CONDITION)
        right = [c for c in touched if c.mood in moods]
        if not right:
            told = {c.mood.name.lower() for c in touched}
            return [], f"the words given order no {step.kind}: {', '.join(sorted(told))}"
        hangs = upon or bool(roles & _UPON) or step.kind in _QUIET
        free = [c for c in right if hangs or not c.hung]
        return free, "" if free else "the words given stand on a condition"

    def _why_places(
        self,
        step: Step | ClockTime,
        usable: list[SaidClause],
        path: BranchPath,
    ) -> str:
        named = self._meant.count_named(usable)
        upon = frozenset(c.start for c in usable if c.hung)
        for place in places_of(step):
            if not named[place]:
                return f"{step.kind} to {place}, which the words given do not name"
            other_branch = bool(self._arrivals) and not may_both(path, self._arrivals[-1][1])
            if place != self._at or other_branch:
                self._arrivals.append((place, path, upon))
            self._at = place
            before = sum(  # one order upon a condition stands in one of its branches
                there == place and (may_both(path, other) or not upon.isdisjoint(by))
                for there, other, by in self._arrivals[:-1]
            )
            most = named[place] + (1 if _BACK.search(self._ordered) else 0)
            if before >= most and not self._repeats:
                return f"{step.kind} to {place} more often than named"
        return ""

    def _why_elsewhere(self, step: Step | ClockTime) -> str:
        """Return why a step leads where only words lead that order nothing.

        Whoever has read every word may have read a name that no plain search finds.
        """
        orders = (ClauseMood.ORDER, ClauseMood.QUESTION, ClauseMood.CONDITION)
        meant = self._meant.count_named([c for c in self._every if c.mood in orders])
        named = places_named(join_clauses(self._every), self._vocabulary)
        wrong = next((p for p in places_of(step) if p in named and not meant[p]), None)
        return f"{step.kind} to {wrong}, which no order names" if wrong else ""

    def _why_kind(self, step: Step | ClockTime, said: str) -> str:
        """Return what no word asks for of a step's kind; a look may be said beside its place."""
        if step.kind in _QUIET:
            moods = (ClauseMood.ORDER, ClauseMood.QUESTION, ClauseMood.CONDITION)
            said = join_clauses(c for c in self._every if c.mood in moods)
        texts = (said, self._ordered) if step.kind in ("turn", "move") else (said,)
        whys = (unsaid_kind(step, text, self._spoken_of, self._vocabulary) for text in texts)
        return next(filter(None, whys), "")

    def _why_often(self, row: tuple[StepNode, ...], index: int, said: str) -> str:
        step = row[index].step
        about = (row[i].step for i in parents_of(row, index))
        again = any(isinstance(each, Repeat) and each.times > 1 for each in about)
        if again and not _ROUNDS_SAID.search(self._things):
            return f"{step.kind} again and again, which is not said"
        key = step.model_dump_json(exclude={"look", "question"})
        path = path_of(row, index)
        before = sum(may_both(path, other) for other in self._done[key])
        self._done[key].append(path)
        if self._repeats or places_of(step) or isinstance(step, Patrol):
            return ""
        most = max(1, evidence(step, said))
        return "" if before < most else f"{step.kind} more often than said"


def _as_ordered(
    words: str, person: PersonWords, clauses: tuple[SaidClause, ...]
) -> tuple[SaidClause, ...]:
    """Return the clauses of a person's words; what a plain yes was said to is an order."""
    asks = {ClauseMood.QUESTION, ClauseMood.FACT} if words in person.agreed else set()
    return tuple(replace(c, mood=ClauseMood.ORDER) if c.mood in asks else c for c in clauses)


def _is_looked_next(row: tuple[StepNode, ...], index: int) -> ClauseMood | None:
    """Return by which mood of words a drive is asked for that leads to where is looked next."""
    at = index + 1
    upon = at + 1 < len(row) and isinstance(row[at].step, If)
    looks = row[at + 1 if upon else at].step if at < len(row) else None
    if looks is None or row[index].step.kind != "go_to" or looks.kind not in _QUIET:
        return None
    there = places_of(looks) in ((), places_of(row[index].step))
    return (ClauseMood.CONDITION if upon else ClauseMood.QUESTION) if there else None


def _find(said: str, span: str) -> int | None:
    """Return where words stand in a text, as whole words where they are Latin."""
    if not span:
        return None
    edge = r"[a-z0-9]" if span.isascii() else r"(?!)"
    found = re.search(
        rf"(?<!{edge}){re.escape(span)}(?!{edge})" if span.isascii() else re.escape(span), said
    )
    return found.start() if found is not None else None
