"""Read what came of an order's steps so far, as a suite of turns writes it.

``go: kitchen ; look: I see 1 cup. ; decide: is there a cup?`` Each part is one step, oldest first:
``KIND: words`` went well, ``KIND! words`` failed, ``ask: question = answer`` was answered, and
``asked: question = answer`` came before any step. Of a drive the words are a place and, where it
failed, a code. What stands behind ``~`` was read in a picture: no plan may follow from it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from planner.brain.interface import Exchange, Observation
from planner.language.catalogue import UnknownMessage, message, say
from planner.language.motion_guard import said_words
from planner.language.motion_guard.step_words import wrong_motions
from planner.language.sentence import parse
from planner.plan import DRIVES, EVERY_KIND, Code, say_same
from pons.evals.matchers import BadMatcher, Expectation
from pons.evals.suites import Case, Suite, read_case, read_rows
from pons.evals.world import site_world, walk
from tools.evals.lines import HERE, LANGUAGES

if TYPE_CHECKING:
    from pathlib import Path

    from planner.plan import Bilingual, StepPlan, Vocabulary
    from pons.evals.matchers import Made
    from pons.evals.world import EvalWorld

_NAMES = {"go": "go_to", "approach": "go_to_object", "back": "come_back", "home": "return_home"}
"""Kinds of steps that a suite calls by a shorter name."""
_NEAR_M = "0.8"
"""How far from a place that is occupied the robot came, in the words of such a failure."""


@dataclass(frozen=True, slots=True)
class OrderCourse:
    """Hold the course of one order until a brain is asked again."""

    told: str
    """As the suite writes it."""
    observed: tuple[Observation, ...] = ()
    exchanges: tuple[Exchange, ...] = ()
    """Questions before any step, and their answers."""
    answers: tuple[str, ...] = ()
    """To questions on the way."""
    room: str | None = None
    """The room that the robot is in by now."""
    failed: frozenset[str] = frozenset()
    """Places that could not be reached."""

    @property
    def replan(self) -> int:
        """Return how often a plan of this order has failed."""
        return sum(each.result == "failed" for each in self.observed)

    def person_words(self, order: str) -> tuple[str, ...]:
        """Return all that the person said: the order and every answer."""
        pairs = tuple((each.asked, each.answer) for each in self.exchanges)
        return (*said_words(order, pairs), *self.answers)


def read_course(told: str, world: EvalWorld) -> OrderCourse:
    """Read the course of an order.

    Raises:
        BadMatcher: it can't be read.
    """
    course = OrderCourse(told, room=world.room)
    for part in (each.strip() for each in told.split(" ; ")):
        course = _append(course, part, world)
    return course


def _append(course: OrderCourse, part: str, world: EvalWorld) -> OrderCourse:
    head = part.split(maxsplit=1)[0] if part else ""
    kind, mark, words = head[:-1], head[-1:], part[len(head) :].strip()
    if mark not in (":", "!") or not words:
        raise BadMatcher(f"{part!r}: expected `KIND: words`, or `KIND! words` where it failed")
    if kind in ("ask", "asked"):
        return _append_answer(course, kind, words)
    step = _NAMES.get(kind, kind)
    if step not in EVERY_KIND:
        raise BadMatcher(f"{part!r}: unknown step {kind!r}")
    words, _, read = (each.strip() for each in words.partition(" ~ "))
    place, room = None, course.room
    if step == "go_to":
        place, _, code = words.partition(" ")
        if place not in world.vocabulary.by_id:
            raise BadMatcher(f"{part!r}: unknown place {place!r}")
        detail = _tell_drive(place, code, world) if mark == "!" else _name(place, world)
    elif step == "decide":
        detail = say("observation.decide_now", text=words)
    elif step == "say":
        detail = say("observation.said", text=words)
    else:
        detail = say_same(words)
    if place is not None and mark == ":":
        room = place if world.vocabulary.by_id[place].kind == "room" else None
    result = "failed" if mark == "!" else "succeeded"
    seen = Observation.model_validate(
        {"step": step, "result": result, "detail": detail, "read": say_same(read) if read else None}
    )
    failed = course.failed | ({place} if place is not None and mark == "!" else frozenset())
    return replace(course, observed=(*course.observed, seen), room=room, failed=failed)


def _append_answer(course: OrderCourse, kind: str, words: str) -> OrderCourse:
    question, found, answer = (each.strip() for each in words.partition(" = "))
    if not (question and found and answer):
        raise BadMatcher(f"{words!r}: expected `question = answer`")
    if kind == "asked":
        pair = Exchange(asked=question, answer=answer)
        return replace(course, exchanges=(*course.exchanges, pair))
    detail = say("observation.asked_answer", text=question, answer=answer)
    seen = Observation(step="ask", result="answered", detail=detail)
    observed, answers = (*course.observed, seen), (*course.answers, answer)
    return replace(course, observed=observed, answers=answers)


def _name(place: str, world: EvalWorld) -> Bilingual:
    return world.vocabulary.by_id[place].name


def _tell_drive(place: str, code: str, world: EvalWorld) -> Bilingual:
    """Return the words of a drive that failed, as a mission tells them."""
    try:
        return message(Code(code), place=_name(place, world), metres=_NEAR_M)
    except (ValueError, KeyError, UnknownMessage):
        raise BadMatcher(f"{place} {code!r}: expected a code such as no_route or blocked") from None


@dataclass(frozen=True, slots=True)
class WantedTurn:
    """Expect something of a turn: neither order nor results allow any other motion."""

    wanted: Expectation
    course: OrderCourse

    def fault(self, made: Made, text: str, vocabulary: Vocabulary) -> str:
        """Return why an outcome is not allowed; empty where it is."""
        return self.wanted.fault(made, text, vocabulary)

    def wrong(self, made: StepPlan, text: str, vocabulary: Vocabulary) -> tuple[str, ...]:
        """Return why each motion is wrong; to try once more what failed is only in vain."""
        if self.wanted.fits(made):
            return ()
        allowed = self.wanted.destinations | self.course.failed
        kinds = {act.kind for act in self.wanted.acts}
        said = " | ".join(self.course.person_words(text))
        found = dict.fromkeys(wrong_motions(made, said, vocabulary))
        for event in walk(made):
            if event.kind == "at" and event.what not in allowed:
                found[f"drives to {event.what}, which neither order nor results allow"] = None
            elif event.kind in DRIVES and event.kind not in kinds:
                found[f"{event.kind}, which neither order nor results allow"] = None
        return tuple(found)


def load_turns(site: Path) -> tuple[Suite, ...]:
    """Return the turns of both languages.

    Raises:
        SiteError: the site can't be read.
        BadMatcher: a line can't be read.
    """
    world = site_world(site, "study")
    return tuple(read_turns(HERE / "turns" / f"{name}.tsv", world) for name in LANGUAGES)


def read_turns(path: Path, world: EvalWorld) -> Suite:
    """Read a file of turns: a suite's rows with the course before the expectation.

    Raises:
        BadMatcher: a row can't be read.
    """

    def read(columns: list[str]) -> Case:
        split, group, text, told, expected = columns
        case, course = read_case([split, group, text, expected], world), read_course(told, world)
        return turn_case(case, course)

    return Suite(f"turns_{path.stem}", world, read_rows(path, read))


def turn_case(case: Case, course: OrderCourse) -> Case:
    """Return a sentence's case in the middle of its order, asked as a mission asks again."""
    asked: dict[str, object] = {
        "room": course.room,
        "language": parse(case.text).language,
        "observed": course.observed,
        "replan": course.replan,
        "exchanges": course.exchanges,
    }
    if course.exchanges:
        asked |= {"text": course.exchanges[-1].answer, "order": case.text}
    wanted = case.wanted
    if not isinstance(wanted, Expectation):
        raise BadMatcher(f"{case.text!r}: no expectation of acts")
    return replace(case, wanted=WantedTurn(wanted, course), told=course.told, asked=asked)
