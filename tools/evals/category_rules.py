"""Own the laws on a sentence by its category, for suites that others wrote.

The table of a data set's description, as data: which steps, which answers, what no motion may come
of. The judge reads the category and the names in the sentence; it shares nothing with any brain.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from planner.language.motion_guard.mentioned_names import places_named, plain
from planner.plan import Clarify, Refuse, StepPlan, Vocabulary, list_nodes
from pons.evals.matchers import Made, unnamed_motions
from pons.evals.world import walk

_STAND = frozenset({"wait", "say"})
_GO = frozenset({"go_to", "come_back", "return_home"})
_SEE = frozenset({"find", "count", "look", "go_to_object"})
_FIRST = re.compile(
    r"\byou (?:may|can|will|could|might) find (?:them|him|her|it) (?:at|in|on|near|by)\b"
)


@dataclass(frozen=True, slots=True)
class Law:
    """Hold one category's permissions."""

    steps: frozenset[str] = frozenset()  # kinds of steps of a plan; none: no plan at all
    needs: frozenset[str] = frozenset()  # a plan has one of these
    clarify: frozenset[str] | None = frozenset()  # codes of a question; empty: any; none: no
    refuse: frozenset[str] | None = None  # codes of a no, likewise
    answer: bool = False

    def fault(self, made: Made, text: str, vocabulary: Vocabulary) -> str:
        """Return why an outcome is not allowed, or an empty string."""
        match made:
            case StepPlan():
                return self._plan_fault(made, text, vocabulary)
            case Clarify():
                return _code_fault("a question", made.code, self.clarify)
            case Refuse():
                return _code_fault("a no", made.code, self.refuse)
        return "" if self.answer else "an answer is not allowed here"

    def wrong(self, made: StepPlan, text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
        """Return why each motion is wrong that the sentence does not name."""
        return unnamed_motions(made, text, vocabulary, bool(self.steps))

    def _plan_fault(self, plan: StepPlan, text: str, vocabulary: Vocabulary) -> str:
        kinds = {node.step.kind for node in list_nodes(plan.steps)}
        if not self.steps:
            return "a plan is not allowed here"
        if kinds - self.steps:
            return f"steps not allowed here: {', '.join(sorted(kinds - self.steps))}"
        if self.needs and not kinds & self.needs:
            return f"none of the steps that the order is about: {', '.join(sorted(self.needs))}"
        return route_fault(plan, text, vocabulary)


def _code_fault(what: str, code: str, allowed: frozenset[str] | None) -> str:
    if allowed is None:
        return f"{what} is not allowed here ({code})"
    return f"{what} with {code}" if allowed and code not in allowed else ""


def route_fault(plan: StepPlan, text: str, vocabulary: Vocabulary) -> str:
    """Return the fault of a plan's places: all that are named, in the named order.

    A place may be visited once more than it is named where the sentence speaks of a way back.
    """
    asked = order_named(text, vocabulary)
    went = [event.what for event in walk(plan) if event.kind == "at" and event.what in vocabulary]
    back = bool(re.search(r"\bback\b|回", plain(text)))
    too_often = Counter(went) - Counter(asked)
    if sum(too_often.values()) > int(back):
        return f"visited more often than named: {', '.join(too_often)}"
    once = [place for at, place in enumerate(went) if place not in went[:at]]
    around = {vocabulary.by_id[place].room for place in once}  # "the bed in the bedroom"
    wanted = [p for p in dict.fromkeys(asked) if p in once or p not in around]
    return "" if once == wanted else f"went {', '.join(once)}; named {', '.join(wanted)}"


def order_named(text: str, vocabulary: Vocabulary) -> list[str]:
    """Return the named places in the order to visit: where somebody is to be found comes first."""
    said = plain(text)
    found = _FIRST.search(said)
    if found is None:
        return list(places_named(said, vocabulary))
    late, early = said[: found.start()], said[found.start() :]
    return [*places_named(early, vocabulary), *places_named(late, vocabulary)]


_ANY = frozenset[str]()
_NO_ARM = frozenset({"no_capability"})
_NOTHING = Law(refuse=_ANY)

LAWS: dict[str, Law] = {
    # English: a robot without an arm
    "navigation": Law(_GO | _STAND | {"patrol"}, refuse=_NO_ARM),
    "find_object": Law(_GO | _SEE | {"say"}, needs=_SEE),
    "count": Law(_GO | _SEE | {"say"}, needs=frozenset({"count"})),
    "find_person": Law(_GO | _SEE | {"say"}, needs=_SEE),
    "follow": Law(
        frozenset({"go_to", "find", "follow", "say"}), frozenset({"follow"}), refuse=_NO_ARM
    ),
    "guide": Law(
        frozenset({"go_to", "find", "follow", "say"}), frozenset({"go_to"}), refuse=_NO_ARM
    ),
    "talk": Law(frozenset({"go_to", "find", "say", "ask"}), frozenset({"say", "ask"}), answer=True),
    "bring_manipulate": Law(clarify=_NO_ARM, refuse=_NO_ARM),
    "incomplete": Law(),
    "egpsr_other": Law(
        _GO | _SEE | _STAND | {"ask", "follow", "patrol", "turn", "move", "decide", "explore"},
        refuse=_ANY,
        answer=True,
    ),
    # Chinese
    "manipulate": Law(refuse=_NO_ARM),
    "reject": _NOTHING,
    "clarify": _NOTHING,
    "negation": _NOTHING,
    "conditional": _NOTHING,
    "coordinate": Law(clarify=frozenset({"out_of_scope"}), refuse=frozenset({"out_of_scope"})),
    "relative": Law(_GO, refuse=_ANY),
    "motion": Law(frozenset({"turn", "move"}), refuse=frozenset({"out_of_scope", "no_capability"})),
    "stop": Law(clarify=None, refuse=frozenset({"stopped"})),
    "wait": Law(frozenset({"wait"}), clarify=None),
}
"""Codes as in ``planner.plan.Code``; the route categories (navigate, multi, mixed) name a route."""
