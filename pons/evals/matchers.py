"""Read a suite's expectation of a sentence, and compare it with a plan's acts.

``go kitchen > find cup @kitchen > back`` in this order · ``{go kitchen & go study}`` in any order ·
``go kitchen | clarify ambiguous`` either. Expectations are compared with the trace of a walk
(:mod:`pons.evals.world`), so that it does not matter how a plan is cut into steps. Words said on
the way are free; every other act must be expected. ``if > look @kitchen > then > back > else >
home > end`` and its like hold steps in steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain, permutations
from math import radians
from typing import Protocol

from planner.language.motion_guard.mentioned_names import plain
from planner.language.motion_guard.step_words import moves, wrong_motions
from planner.plan import AnswerPlan, Clarify, Refuse, StepPlan, Vocabulary, list_nodes
from pons.evals.world import HOME, START, EvalEvent, walk

Made = StepPlan | AnswerPlan | Clarify | Refuse
CLOSE = 0.02
_FREE = frozenset({"say", "watch"})
"""May be done without being expected: words, and a look at a patrol's stop."""
_STILL = frozenset({"clarify", "refuse", "still", "answer"})
_STAYS = ("still", "answer", "say", "ask", "ask > decide")
"""Ways in which nothing moves, words and a question on the way among them."""
_KINDS = frozenset(
    {"go", "back", "home", "wait", "say", "ask", "turn", "move", "find", "count", "look"}
    | {"follow", "decide", "approach", "recall", "waitfor", "clock", "watch", "stand"}
    | {"if", "then", "else", "try", "failing", "repeat", "until", "end"}
)


class BadMatcher(ValueError):
    """Ours: a suite's expectation can't be read."""


@dataclass(frozen=True, slots=True)
class Act:
    """Expect one thing done: of several words one, at a place where one is named."""

    kind: str
    words: tuple[str, ...] = ()  # any of these
    where: str | None = None
    number: float | None = None
    optional: bool = False

    def fits(self, event: EvalEvent) -> bool:
        """Return whether an event is the expected one."""
        if event.kind != self.kind or (self.where is not None and event.where != self.where):
            return False
        if self.number is not None:
            said = event.number if event.number is not None else float("inf")
            return abs(said - self.number) <= CLOSE * max(1.0, abs(self.number))
        if self.kind == "at":
            return event.what in self.words
        done = plain(event.what)
        return not self.words or any(all(part in done for part in w.split()) for w in self.words)


class OutcomeJudge(Protocol):
    """Judge what a brain made of one sentence."""

    def fault(self, made: Made, text: str, vocabulary: Vocabulary) -> str:
        """Return why an outcome is not allowed; empty where it is."""

    def wrong(self, made: StepPlan, text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
        """Return why each motion is wrong."""


Item = Act | tuple[Act, ...]  # a tuple in any order


@dataclass(frozen=True, slots=True)
class NoMotion:
    """Expect no motion: a question, a no, an answer; with one of these codes where any is named."""

    kinds: frozenset[str]
    codes: frozenset[str]

    def fits(self, made: Made) -> bool:
        """Tell whether nothing moves, in the way expected."""
        code = getattr(made, "code", None)
        return made.kind in self.kinds and (not self.codes or code in self.codes)


@dataclass(frozen=True, slots=True)
class Expectation:
    """Expect one of several things of a sentence."""

    plans: tuple[tuple[Item, ...], ...]
    stills: tuple[NoMotion, ...]

    def fits(self, made: Made) -> bool:
        """Tell whether a plan, an answer, a question or a no is one that is expected."""
        if isinstance(made, StepPlan):
            trace = walk(made)
            return any(_follows(trace, items) for items in self.plans)
        return any(still.fits(made) for still in self.stills)

    def fault(self, made: Made, text: str, vocabulary: Vocabulary) -> str:
        """Return why an outcome is not allowed; empty where it is."""
        del text, vocabulary
        return "" if self.fits(made) else "not what is expected"

    def wrong(self, made: StepPlan, text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
        """Return why each motion is wrong; a plan that is expected may misspell a name."""
        return () if self.fits(made) else unnamed_motions(made, text, vocabulary, bool(self.plans))

    @property
    def acts(self) -> tuple[Act, ...]:
        """Return all that may be expected, in any plan."""
        items = (item for plan in self.plans for item in plan)
        return tuple(a for item in items for a in (item if isinstance(item, tuple) else (item,)))

    @property
    def destinations(self) -> frozenset[str]:
        """Return where the plans drive: ids of places, the start and the site's home."""
        driven = {word for act in self.acts if act.kind == "at" for word in act.words}
        return frozenset((driven | {act.where or "" for act in self.acts}) - {""})


def unnamed_motions(
    made: StepPlan, text: str, vocabulary: Vocabulary, may_move: bool
) -> tuple[str, ...]:
    """Return why each motion is wrong that a sentence does not name."""
    if not may_move and any(moves(node.step) for node in list_nodes(made.steps)):
        return ("moves where nothing may move",)
    return wrong_motions(made, text, vocabulary)


def read_expectation(text: str) -> Expectation:
    """Read an expectation.

    Raises:
        BadMatcher: it can't be read.
    """
    plans, stills = [], []
    ways = [part.strip() for part in text.split("|")]
    for way in chain.from_iterable(_STAYS if way == "stays" else (way,) for way in ways):
        word, *codes = way.split() or [""]
        if word in _STILL:
            kinds = frozenset({"clarify", "refuse"}) if word == "still" else frozenset({word})
            stills.append(NoMotion(kinds, frozenset(codes)))
        else:
            plans.append(tuple(_unroll([_item(part.strip()) for part in way.split(">")])))
    return Expectation(tuple(plans), tuple(stills))


def _unroll(items: list[Item]) -> list[Item]:
    """Write out rounds: ``repeat 2 > look > end`` is two looks; one with ``until`` stays."""
    begin = next((i for i, item in enumerate(items) if _is(item, "repeat")), None)
    if begin is None or any(_is(item, "until") for item in items):
        return items
    end = next((i for i in range(begin, len(items)) if _is(items[i], "end")), len(items))
    head = items[begin]
    times = int(head.number or 1) if isinstance(head, Act) else 1
    return [*items[:begin], *items[begin + 1 : end] * times, *_unroll(items[end + 1 :])]


def _is(item: Item, kind: str) -> bool:
    return isinstance(item, Act) and item.kind == kind


def _item(text: str) -> Item:
    if text.startswith("{") and text.endswith("}"):
        return tuple(_act(part.strip()) for part in text[1:-1].split("&"))
    return _act(text)


def _act(text: str) -> Act:
    optional = text.endswith("?")
    kind, *rest = text.removesuffix("?").split()
    if kind not in _KINDS:
        raise BadMatcher(f"{text!r}: unknown act {kind!r}; known: {', '.join(sorted(_KINDS))}")
    if kind == "recall":  # the robot is not where memory is asked about
        return Act(kind, (plain(" ".join(rest)),) if rest else (), optional=optional)
    where = next((word[1:] for word in rest if word.startswith("@")), None)
    words = " ".join(word for word in rest if not word.startswith("@"))
    if kind == "stand":  # side, thing, @place and metres
        number = next((float(word) for word in words.split() if word[0].isdigit()), None)
        said = " ".join(word for word in words.split() if not word[0].isdigit())
        return Act("stand_at", (plain(said),), where, number, optional)
    if kind == "watch":
        return Act(kind, where=words, optional=optional)
    if kind in ("go", "back", "home"):
        places = {"back": START, "home": HOME}.get(kind, words)
        return Act("at", tuple(places.split("/")), optional=optional)
    if kind in ("wait", "turn", "move", "repeat"):
        if kind == "repeat" and not words:  # as often as it takes
            return Act(kind, optional=optional)
        try:
            number = radians(float(words)) if kind == "turn" else float(words)
        except ValueError:
            raise BadMatcher(f"{text!r}: {kind} needs a number, not {words!r}") from None
        return Act(kind, number=number, optional=optional)
    kind = {"approach": "go_to_object", "waitfor": "wait_for"}.get(kind, kind)
    return Act(kind, tuple(plain(words).split("/")) if words else (), where, optional=optional)


def _follows(trace: tuple[EvalEvent, ...], items: tuple[Item, ...], here: str = START) -> bool:
    """Tell whether a trace does these things in order and nothing else but talk."""
    if not items:
        return all(event.kind in _FREE for event in trace)
    head, rest = items[0], items[1:]
    if isinstance(head, tuple):
        return any(_follows(trace, (*order, *rest), here) for order in permutations(head))
    if head.kind == "at" and here in head.words and _follows(trace, rest, here):
        return True
    if head.optional and _follows(trace, rest, here):
        return True
    if not trace:
        return False
    event, after = trace[0], trace[1:]
    if head.fits(event) and _follows(after, rest, event.where):
        return True
    if event.kind == "at" and head.where == event.what:  # the way to where it is to be done
        return _follows(after, items, event.where)
    return event.kind in _FREE and _follows(after, items, here)
