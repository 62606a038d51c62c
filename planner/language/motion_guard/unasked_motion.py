"""Find what a plan would move that a person's own words do not ask for.

Laws: only what a person said counts, never what a brain asked, reported or read (a plain yes alone
makes the question that it answers the person's own). What is denied, past, told to others or on a
condition that nobody has looked at names nothing. Where the grammar reads harm, an arm's work, a
choice or an unknown place, everything that moves is unasked; what it reads as the very same step is
asked, however it was spelt. In doubt a step is unasked: a person is then asked, and nothing else.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from planner.language.motion_guard.kind_words import ROUNDS, unsaid_kind
from planner.language.motion_guard.mentioned_names import (
    find_places,
    places_named,
    plain,
)
from planner.language.motion_guard.order_scope import read_scope
from planner.language.motion_guard.second_reader import (
    asked_about,
    branch_of,
    hangs_on_more,
    key_of_step,
    read_branches,
    read_grammar,
    spare_clauses,
)
from planner.language.motion_guard.statements import cut_statements, orders_anything
from planner.language.motion_guard.step_words import evidence, makes_way, moves
from planner.language.questions import looks_round
from planner.language.yes_no import consents
from planner.plan import (
    ClockTime,
    Code,
    Count,
    Look,
    Repeat,
    Step,
    StepNode,
    StepPlan,
    StepRole,
    Vocabulary,
    list_nodes,
    parent_of,
    parents_of,
    places_of,
)

LOOKS = frozenset({"look", "find", "count"})
"""May be done to learn whether a condition holds."""
_LEARNS = LOOKS | {"ask"}
_ALL_ROOMS = re.compile(
    r"\b(?:every|each|all|other|whole|entire|rest of)\b[a-z' ]{0,12}\b"
    r"(?:rooms?|house|home|flat|apartment|places?)\b|\beverywhere\b|\bwhole place\b"
    r"|\b(?:around|through) the (?:house|home|flat|apartment)\b"
    r"|(?:所有|每个|每间|各个|各|全部)的?(?:房间|屋子|屋)|全屋|整个(?:家|屋|房)|到处|四处|全家"
)
_HERE = re.compile(
    r"\b(?:here|this room|in this|around|the room)\b|这里|这儿|这个房间|这间|周围|四周|屋里"
)
_REPEATS = re.compile(
    r"\b(?:twice|thrice|times|again|repeat|loop|keep|over and over|back and forth|laps?)\b"
    r"|[二两三四五六七八九十几\d]\s*[次遍趟圈]|来回|反复|一直|轮流|不断|循环|往返"
)
_ROUNDS_SAID = re.compile(
    rf"{_REPEATS.pattern}|\b(?:until|till|while|as long as|every|for [a-z0-9]+ (?:minutes?|hours?"
    r"|seconds?)|rounds?)\b|直到|等到|为止|每|分钟|小时|秒|轮"
)
_ENDS_THERE = frozenset({"go_to", "patrol", "stand_at"})
_THERE = re.compile(
    r"\b(?:go|get|drive|move|head|stay|wait|come|back|over|return|walk|in) there\b"
    r"|那里|那儿|那边|过去|进去"
)


@dataclass(frozen=True, slots=True)
class PersonWords:
    """Hold what a person said about one goal, and the facts that the words lean on."""

    words: tuple[str, ...]
    """The order and the answers about it, oldest first."""
    room: str | None = None
    """Where the robot is."""
    checked: bool = False
    """This goal has looked or asked already: what stood on a condition may be done."""


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


def find_unasked(
    made: StepPlan, person: PersonWords, vocabulary: Vocabulary
) -> tuple[UnaskedStep, ...]:
    """Return the steps that move the robot and that nobody asked for. Never raises.

    Their index is that of the row of all steps (``list_nodes``). A branch is held to the words on
    a condition, since it looks or asks first; so is what is done where something else fails. What
    comes again in rounds must have been ordered so.
    """
    judge = _Judge(person, vocabulary)
    row = list_nodes(made.steps)
    found, before = [], False
    for index, node in enumerate(row):
        step = node.step
        if can_move(step):
            upon = before or person.checked or step.kind in LOOKS or hangs_on_more(row, index)
            asked = asked_about(row, index)
            judge.enter(row, index)
            why = (
                judge.find_branch(row, index)
                or judge.find_fault(step, upon=upon, asked=asked, when=node.role is StepRole.WHEN)
                or judge.find_rounds(row, index)
            )
            found += [UnaskedStep(index, why)] if why else []
        before = before or step.kind == "ask"
    return tuple(found)


def can_move(step: Step | ClockTime) -> bool:
    """Tell whether a step moves the robot, turning about to look included."""
    turns_about = isinstance(step, Look) and looks_round(step.question)
    return moves(step) or isinstance(step, Count) or turns_about


class _Judge:
    """Judge the steps of one plan in their order; counts how often each thing is done."""

    def __init__(self, person: PersonWords, vocabulary: Vocabulary) -> None:
        self._vocabulary, self._room = vocabulary, person.room
        self._scopes = tuple(read_scope(words) for words in person.words)
        self._words = person.words
        newest = person.words[-1] if person.words else ""
        self._own, self._hung, self._veto = read_grammar(newest, vocabulary, person.room)
        self._branches = read_branches(newest, vocabulary, person.room)
        if self._veto is not None and self._veto is not Code.UNSAFE:
            spared = spare_clauses(newest, vocabulary, person.room)
            if spared is not None:  # "somebody knocks at the door, go and look"
                self._veto = None
                self._scopes = (*self._scopes[:-1], read_scope(spared))
        self._done: Counter[object] = Counter()
        self._at = ""
        self._path: dict[int, StepRole] = {}
        self._arrivals: list[tuple[str, dict[int, StepRole]]] = []
        self._repeats = any(_REPEATS.search(scope.upon) for scope in self._scopes)

    def find_fault(
        self,
        step: Step | ClockTime,
        *,
        upon: bool,
        asked: Counter[str] | None = None,
        when: bool = False,
    ) -> str:
        """Return why a step is unasked; empty where it is asked.

        Args:
            step: what would be done.
            upon: what stands on a condition counts.
            asked: places that the conditions ask about on which the step hangs.
            when: the step is itself a condition.
        """
        if self._veto is not None:
            return f"the order itself is {self._veto.value}"
        if not places_of(step):
            self._at = ""  # wherever it leads
        whole = _GAP.join(self._words)
        hangs = when and _CONDITION.search(plain(whole)) is not None
        asks = step.kind in _QUIET
        if not (
            hangs
            or makes_way(step, whole)
            or orders_anything(self._words, self._vocabulary, by_question=asks)
        ):
            return f"{step.kind} for words that order no drive"
        key = key_of_step(step)
        self._done[key] += 1
        own = self._hung if upon else self._own
        if key in own and self._done[key] <= own[key]:
            for place in places_of(step):
                self._arrive(place)
            return ""
        said = _GAP.join(self._texts(upon))
        if step.kind not in _QUIET and _ASKS.match(said) and not _ORDERS.search(said):
            return "a question orders no drive"
        return (
            self._why_places(step, self._texts(upon))
            or self._why_condition(step, said, asked or Counter())
            or ("" if hangs and isinstance(step, Look) else self._why_kind(step, said))
            or self._why_often(step, key, said)
        )

    def enter(self, row: tuple[StepNode, ...], index: int) -> None:
        """Note in which branches the step stands that is judged next."""
        self._path = {
            parent: role
            for at in (index, *parents_of(row, index))
            if (parent := parent_of(row, at)) is not None
            and (role := row[at].role) in (StepRole.THEN, StepRole.OTHERWISE)
            and role is not None
        }

    def find_branch(self, row: tuple[StepNode, ...], index: int) -> str:
        """Return why a step ends where the order sends the robot in the other branch, or in none.

        Judged where the grammar has read the order whole, and no denial lets it be put both ways.
        """
        step, role = row[index].step, branch_of(row, index)
        if self._branches is None or role is None or step.kind not in _ENDS_THERE:
            return ""
        wrong = next((p for p in places_of(step) if p not in self._branches[role]), None)
        return f"{step.kind} to {wrong}, which this branch does not say" if wrong else ""

    def find_rounds(self, row: tuple[StepNode, ...], index: int) -> str:
        """Return why a step is done again and again though nobody ordered that."""
        about = (row[i].step for i in parents_of(row, index))
        again = any(isinstance(step, Repeat) and step.times > 1 for step in about)
        said = _GAP.join(f"{scope.upon} {scope.things}" for scope in self._scopes)
        if not again or _ROUNDS_SAID.search(said):
            return ""
        return f"{row[index].step.kind} again and again, which is not said"

    def _texts(self, upon: bool) -> tuple[str, ...]:
        return tuple(scope.upon if upon else scope.ordered for scope in self._scopes)

    def _why_places(self, step: Step | ClockTime, texts: tuple[str, ...]) -> str:
        said = _GAP.join(cut_statements(text, self._vocabulary) for text in texts)
        named = Counter(places_named(said, self._vocabulary))
        named.update(dict.fromkeys(self._rooms_of_group(said), 1))
        named.update(self._rooms_described(said))
        if self._room is not None and _HERE.search(said):
            named[self._room] += 1
        for place in places_of(step):
            if not named[place]:
                return f"{step.kind} to {place}, which is not named"
            self._arrive(place)
            if self._count_before(place) >= named[place] and not self._repeats:
                return f"{step.kind} to {place} more often than named"
        return ""

    def _why_condition(self, step: Step | ClockTime, said: str, asked: Counter[str]) -> str:
        """Return why a branch drives to a place that its condition alone names."""
        if step.kind not in _ENDS_THERE or not asked or _THERE.search(said):
            return ""
        named = Counter(places_named(said, self._vocabulary))
        once = (p for p in places_of(step) if asked[p] and named[p] <= asked[p])
        place = next(once, None)
        return f"{step.kind} to {place}, which only the condition names" if place else ""

    def _arrive(self, place: str) -> None:
        """Note a drive to a place; who is there already drives no farther."""
        if place != self._at:
            self._arrivals.append((place, self._path))
        self._at = place

    def _count_before(self, place: str) -> int:
        """Return how many drives to a place came before the newest that may all be walked.

        Of two branches of one condition only one is.
        """
        return sum(
            there == place and all(self._path.get(at, role) is role for at, role in path.items())
            for there, path in self._arrivals[:-1]
        )

    def _rooms_described(self, said: str) -> Counter[str]:
        """Return the rooms that are named by what stands in them: "the one with the bed"."""
        found: Counter[str] = Counter()
        for place in find_places(said, self._vocabulary):
            room = self._vocabulary.by_id[place.id].room
            if room is not None and (
                _HOLDS.search(said, 0, place.start)
                or _HELD_ZH.match(said, place.end)
                or (_HOLDS_ZH.search(said, 0, place.start) and _HOLDING_ZH.match(said, place.end))
            ):
                found[room] = 1
        return found

    def _rooms_of_group(self, said: str) -> frozenset[str]:
        """Return the rooms that "every room" means, without those that are left out."""
        rounds = ROUNDS.search(said) and not places_named(said, self._vocabulary)
        if not (_ALL_ROOMS.search(said) or rounds):
            return frozenset()
        out = {p for scope in self._scopes for p in places_named(scope.excluded, self._vocabulary)}
        rooms = (entry.id for entry in self._vocabulary.entries if entry.kind == "room")
        return frozenset(rooms) - out

    def _why_kind(self, step: Step | ClockTime, said: str) -> str:
        things = _GAP.join(scope.things for scope in self._scopes)
        return unsaid_kind(step, said, things, self._vocabulary)

    def _why_often(self, step: Step | ClockTime, key: object, said: str) -> str:
        if self._repeats or places_of(step):
            return ""
        most = max(1, evidence(step, said))
        return "" if self._done[key] <= most else f"{step.kind} more often than said"


_GAP = " | "
_CONDITION = re.compile(r"\b(?:if|when|whether|unless|should)\b|如果|要是|若|假如|的话|就|没")
_HOLDS = re.compile(r"\b(?:room|one|place) (?:that )?(?:with|has|having|where)\b[^,.;|]{0,24}$")
_HOLDS_ZH = re.compile(r"(?:有|摆着?|放着?)[^,，。;|去到来回就]{0,4}$")
_HOLDING_ZH = re.compile(r"的(?:那|房|屋|间|地方)")
_HELD_ZH = re.compile(r"(?:在的|所在的?)那?[个间]?")
_ORDERS = re.compile(
    r"\b(?:go|goes|drive|come|walk|run|head|move|look|see|check|find|search|count|turn|follow|wait"
    r"|visit|swing|stop by|return|take|bring|tell|ask|patrol|rounds?|back)\b"
    r"|[去到来回看找数查转跟开走巡]"
)
_ASKS = re.compile(
    r"\s*(?:how|what|which|who|whose|why|when (?:is|are|do|does|did|will)|is|are|was|were|does"
    r"|do (?:you|i|we)|has|have|did)\b|.*\?\s*$"
    r"|.*(?:多远|多大|多少|几个|哪个|什么|为什么|怎么|吗|呢|没有$)"
)
_QUIET = frozenset({"look", "find", "count", "go_to_object"})
"""Steps by which a question is answered."""
