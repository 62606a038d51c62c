"""Make one plan of the clauses' meanings: all of them, or a question, or an honest no.

One clause that can't be read or done holds the whole sentence back; what could be done without it
is offered, never done unasked.

What a button of a question says stands here, too: the steps as a sentence. The button carries them,
and no reader reads it again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from itertools import chain

from planner.language.catalogue import list_names, message, say
from planner.language.grammar.checks import Veto
from planner.language.grammar.lexicon import Lexicon, MarkedText
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Steps, TopicQuestion
from planner.language.grammar.small_talk import Topic, answer_topic
from planner.language.place_lists import known_places
from planner.language.plan_words import tell_steps
from planner.plan import (
    DRIVES,
    MAX_STEPS,
    NEEDS_CAMERA,
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    ComeBack,
    Count,
    Explore,
    Find,
    GoTo,
    Language,
    Option,
    Patrol,
    Refuse,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    Vocabulary,
    lacking,
    say_same,
)

# What no other wording can mend is told first.
_RANK = (
    Code.UNSAFE,
    Code.NO_CAPABILITY,
    Code.NO_CAMERA,
    Code.NO_DETECTOR,
    Code.NOT_MAPPING,
    Code.BAD_PLAN,
    Code.NOT_UNDERSTOOD,
    Code.UNKNOWN_PLACE,
    Code.INCOMPLETE,
    Code.AMBIGUOUS,
)
_LACKING = frozenset({Code.NO_CAPABILITY, Code.NO_CAMERA, Code.NO_DETECTOR, Code.NOT_MAPPING})
_SHOWN = 60  # characters of the sentence that a message repeats
_SPAN = say("grammar.wait_too_long")
_NO_ROOM = say("grammar.room_unknown")


Plan = StepPlan | AnswerPlan | Clarify | Refuse


@dataclass(frozen=True, slots=True)
class Setting:
    """Carry what plans are made against: the names, the language, and where the robot is."""

    vocabulary: Vocabulary
    lexicon: Lexicon
    language: Language
    room: str | None
    now: datetime | None = None
    offers: bool = True  # false where the sentence denies: what it names may be what it forbids
    moved: bool = False  # the robot has driven somewhere before these steps

    def button(self, steps: Sequence[Step]) -> Option:
        """Return a button that stands for these steps."""
        return option(steps, self.vocabulary, self.lexicon, self.language)


def compose(meanings: Sequence[Meaning], text: str, setting: Setting) -> Plan:
    """Return the plan of a sentence from the meanings of its clauses."""
    problems = [meaning for meaning in meanings if isinstance(meaning, ClauseProblem)]
    if problems:
        worst = min(problems, key=lambda problem: _RANK.index(problem.code))
        return _explain(worst, problems, meanings, setting)
    greetings = [each for each in meanings if each == TopicQuestion(Topic.HELLO)]
    meanings = [each for each in meanings if each not in greetings] or greetings[:1]
    if len(meanings) == 1 and isinstance(meanings[0], TopicQuestion):
        return _answer(meanings[0].topic, setting)
    meanings = [_aloud(meaning, setting) for meaning in meanings]
    steps = _join_patrols(_steps_of(meanings))
    if not steps or any(isinstance(meaning, TopicQuestion) for meaning in meanings):
        return _ask(ClauseProblem(Code.NOT_UNDERSTOOD, text), (), setting)
    return _check(steps, text, setting)


def veto(found: Veto, marked: MarkedText, setting: Setting) -> Plan:
    """Return the no, or for "or" the question, to a sentence that may not be read as an order."""
    part = marked.restore(found.part)
    if found.code not in (Code.AMBIGUOUS, Code.NOT_UNDERSTOOD):
        return Refuse(code=found.code, reason=message(found.code, part=quote_part(part)))
    named = dict.fromkeys(m.ids[0] for m in marked.mentions if len(m.ids) == 1)
    several = found.code is Code.AMBIGUOUS or len(named) == 1
    buttons = tuple(setting.button((GoTo(place=place),)) for place in named)
    return _ask(ClauseProblem(found.code, part), buttons if several and found.only else (), setting)


def unsafe(rule: Bilingual, part: str) -> Refuse:
    """Return the no to an order that would do harm, with the rule that it breaks."""
    return Refuse(code=Code.UNSAFE, reason=message(Code.UNSAFE, part=quote_part(part), rule=rule))


def _aloud(meaning: Meaning, setting: Setting) -> Meaning:
    """Say a topic's text, where it is one part of an order."""
    words = answer_topic(meaning.topic, setting.now) if isinstance(meaning, TopicQuestion) else None
    return Steps((Say(text=words.of(setting.language)),)) if words else meaning


def _join_patrols(steps: Sequence[Step]) -> tuple[Step, ...]:
    """Join patrols that follow each other: "the kitchen and the study" are one round."""
    joined: list[Step] = []
    for step in steps:
        before = joined[-1] if joined else None
        if isinstance(step, Patrol) and isinstance(before, Patrol) and before.places != step.places:
            places = (*before.places, *step.places)[:MAX_STEPS]
            joined[-1] = Patrol(places=places, look=before.look or step.look)
        else:
            joined.append(step)
    return tuple(joined)


def _check(steps: tuple[Step, ...], text: str, setting: Setting) -> Plan:
    if len(steps) > MAX_STEPS:
        why = say("grammar.too_many_steps", count=len(steps), limit=MAX_STEPS)
        return Refuse(code=Code.BAD_PLAN, reason=message(Code.BAD_PLAN, why=why))
    drives = (step for step in steps if step.kind in DRIVES or isinstance(step, Count))
    first = next(drives, None)
    if (
        isinstance(first, ComeBack) and not setting.moved
    ):  # back from where? nothing was driven before it
        home = (setting.button((ReturnHome(),)),)
        return _ask(ClauseProblem(Code.AMBIGUOUS, text), home, setting)
    return StepPlan(steps=steps)


def _explain(
    worst: ClauseProblem,
    problems: Sequence[ClauseProblem],
    meanings: Sequence[Meaning],
    setting: Setting,
) -> Plan:
    alone = len(problems) == 1
    if worst.code in _LACKING:
        understood = all(problem.code in _LACKING for problem in problems)
        return _lacking(worst, _offer(meanings) if understood else (), setting)
    if worst.code is Code.BAD_PLAN:
        return Refuse(code=worst.code, reason=message(worst.code, why=worst.what or _SPAN))
    if worst.code is Code.NOT_UNDERSTOOD:
        offered = _offer(meanings)
        # Of two places the order was not understood either.
        certain = len(offered) == 1 and _drives(offered)
        return _ask(worst, (setting.button(offered),) if certain else (), setting)
    stead = worst.choices or ((worst.instead,) if worst.instead else ())
    stead = stead or tuple((GoTo(place=place),) for place in worst.places)
    choices = stead if alone else ()
    options = tuple(setting.button(_steps_of(meanings, worst, steps)) for steps in choices)
    return _ask(worst, options, setting)


def _lacking(worst: ClauseProblem, offered: tuple[Step, ...], setting: Setting) -> Plan:
    said = message(worst.code, part=quote_part(worst.part))
    if not _drives(offered) or not setting.offers:
        return Refuse(code=worst.code, reason=said)
    order = sentence(offered, setting.vocabulary, setting.lexicon)
    question = say("grammar.only", said=said, order=order)
    return Clarify(code=worst.code, question=question, options=(setting.button(offered),))


def _ask(problem: ClauseProblem, options: tuple[Option, ...], setting: Setting) -> Clarify:
    if problem.code is Code.INCOMPLETE:
        what = problem.what or say_same("?")
        question = message(problem.code, part=quote_part(problem.part), what=what)
    elif problem.code is Code.UNKNOWN_PLACE:
        question = _unknown(problem, setting)
    elif problem.code is Code.NOT_UNDERSTOOD and len(options) == 1 and setting.offers:
        said = say("grammar.unread_part", part=quote_part(problem.part))
        question = say("grammar.only", said=said, order=options[0].label)  # what a yes does is told
    else:
        question = message(problem.code, part=quote_part(problem.part))
    return Clarify(code=problem.code, question=question, options=options if setting.offers else ())


def _unknown(problem: ClauseProblem, setting: Setting) -> Bilingual:
    vocabulary = setting.vocabulary
    names = [vocabulary.name(place) for place in problem.places if setting.offers]
    near = (
        say("grammar.did_you_mean", names=list_names(names, "joint.or")) if names else say_same("")
    )
    return message(
        problem.code, name=quote_part(problem.name), near=near, known=known_places(vocabulary)
    )


def _answer(topic: Topic, setting: Setting) -> AnswerPlan:
    if topic is Topic.PLACES:
        names = known_places(setting.vocabulary)
        return AnswerPlan(text=say("grammar.places", names=names))
    words = answer_topic(topic, setting.now)
    if words is not None:
        return AnswerPlan(text=words)
    if setting.room is None:
        return AnswerPlan(text=_NO_ROOM)
    return AnswerPlan(text=say("grammar.in_room", name=setting.vocabulary.name(setting.room)))


def _steps_of(
    meanings: Sequence[Meaning],
    instead_of: ClauseProblem | None = None,
    instead: tuple[Step, ...] = (),
) -> tuple[Step, ...]:
    """Return all steps in order, one problem replaced by other steps."""
    steps: list[Step] = []
    for meaning in meanings:
        if isinstance(meaning, Steps):
            steps.extend(meaning.steps)
        elif meaning is instead_of:
            steps.extend(instead)
    return tuple(steps)


def _offer(meanings: Sequence[Meaning]) -> tuple[Step, ...]:
    """Return the part of the order that could be driven without the impossible parts."""
    steps: list[Step] = []
    for meaning in meanings:
        if isinstance(meaning, Steps):
            steps.extend(meaning.steps)
        elif isinstance(meaning, ClauseProblem):
            named = meaning.places if meaning.code is not Code.NO_CAPABILITY else ()
            steps.extend(meaning.before or tuple(GoTo(place=place) for place in named))
    return tuple(steps[:MAX_STEPS])


def _drives(steps: Sequence[Step]) -> bool:
    return any(isinstance(step, GoTo | ReturnHome | Find | Patrol | Explore) for step in steps)


def quote_part(part: str) -> Bilingual:
    """Return words of a sentence as they are quoted in an answer: not too many of them."""
    return say_same(part if len(part) <= _SHOWN else part[: _SHOWN - 1] + "…")


def sentence(steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon) -> Bilingual:
    """Return the order of these steps in both languages."""
    return tell_steps(steps, lambda place: lexicon.own_name(vocabulary.by_id[place]))


def option(
    steps: Sequence[Step], vocabulary: Vocabulary, lexicon: Lexicon, language: Language
) -> Option:
    """Return a button that stands for these steps."""
    label = sentence(steps, vocabulary, lexicon)
    plan = StepPlan(steps=tuple(steps)) if 0 < len(steps) <= MAX_STEPS else None
    return Option(label=label, text=label.of(language)[:2000], plan=plan)


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
