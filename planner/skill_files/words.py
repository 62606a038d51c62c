"""Judge the sentences that call a skill: each is heard as that call, and meant nothing before.

Law: a skill takes no word away from stopping, answering, commanding, a place's name or an order
that is read without it. Each sentence is tried as people would say it.
"""

from __future__ import annotations

import contextlib
import re
from functools import lru_cache
from itertools import islice, product

from planner.language.commands import intent_of
from planner.language.grammar import means_already, plan
from planner.language.grammar.context import Context
from planner.language.motion_guard.clause_moods import is_bare
from planner.language.stop import StopReading, is_stop, read_stop
from planner.language.templates.expressions import (
    Expression,
    LiteralWords,
    OneOf,
    Sequel,
    SlotFilling,
    TemplateError,
    parse_expression,
)
from planner.language.templates.skills import with_skills
from planner.language.templates.template_file import load_templates
from planner.language.yes_no import consents
from planner.plan import EVERY_KIND, ParameterKind, Skill, StepPlan, UseSkill, Vocabulary
from planner.skill_files.problems import SkillProblem

_BLANK = re.compile(r"\{([^}:]*)")
_MARK = 0xF600
"""A private character stands for a parameter where a sentence is drawn."""
_SAID = {
    "en": {
        ParameterKind.THING: "red cup", ParameterKind.PERSON: "Anna", ParameterKind.WORDS: "dinner",
        ParameterKind.NUMBER: "3", ParameterKind.DURATION: "5 minutes",
    },
    "zh": {
        ParameterKind.THING: "杯子", ParameterKind.PERSON: "小明", ParameterKind.WORDS: "开饭",
        ParameterKind.NUMBER: "3", ParameterKind.DURATION: "5分钟",
    },
}  # fmt: skip
MOST_DRAWN, MOST_TRIED = 60, 4


def check_words(skill: Skill, names: Vocabulary, others: Vocabulary, text: str) -> None:
    """Judge a skill's sentences.

    Args:
        skill: whose sentences.
        names: the site's names, without skills.
        others: the same, with the skills that are known already.
        text: of the file, for its lines.

    Raises:
        SkillProblem: with the sentence's line.
    """
    with_own = with_skills(names, (skill,))
    for tongue in ("en", "zh"):
        for sentence in getattr(skill, tongue):
            line = next((n for n, each in enumerate(text.splitlines(), 1) if sentence in each), 1)
            try:
                tried = _draw(skill, sentence, tongue, names)
                for said in tried:
                    _check_said(skill, said, line, names, with_own, others)
            except TemplateError as wrong:
                raise SkillProblem("skill_words", skill.file, line, what=wrong.problem) from None


def list_spoken(names: Vocabulary, place: str) -> list[str]:
    """Return the English sentences that call skills, for ears of a closed grammar.

    ``place`` stands where a name of a place is said. What takes other words is left out: ears that
    know all their sentences can't hear words that nobody has told them.
    """
    return [said for skill in names.skills for said in _list_spoken(skill, place)]


@lru_cache(maxsize=256)
def _list_spoken(skill: Skill, place: str) -> tuple[str, ...]:
    free, said = load_templates(), []
    marks = {
        each.name: place if each.kind is ParameterKind.PLACE else chr(_MARK + at)
        for at, each in enumerate(skill.parameters)
    }
    for sentence in skill.en:
        with contextlib.suppress(TemplateError):
            named = {**free.words["en"], **marks}
            said += _ways(parse_expression(sentence, named, frozenset(free.free), {}))
    return tuple(" ".join(way) for way in said if set(way) & set(marks.values()) <= {place})


def _draw(skill: Skill, sentence: str, tongue: str, names: Vocabulary) -> list[str]:
    """Return sentences as people would say them: the shortest, the longest, some between."""
    marks = {each.name: chr(_MARK + at) for at, each in enumerate(skill.parameters)}
    unknown = sorted(set(_BLANK.findall(sentence)) - marks.keys())
    if unknown:
        raise TemplateError(
            f"{{{unknown[0]}}} is none of its parameters: {', '.join(marks) or 'none'}", "", ""
        )
    ours = load_templates()
    named = {**ours.words[tongue], **marks}
    parsed = parse_expression(sentence, named, frozenset(ours.free), {})
    drawn = sorted(set(islice(_ways(parsed), MOST_DRAWN)), key=lambda way: (len(way), way))
    kept = drawn if len(drawn) <= MOST_TRIED else [*drawn[:2], *drawn[-2:]]
    needed = {marks[each.name] for each in skill.parameters if each.default is None}
    for way in drawn:
        if needed - set(way):
            raise TemplateError(
                f"“{sentence}” can be said without a parameter that has no default", "", ""
            )
        if set(way) <= set(marks.values()):
            raise TemplateError(f"“{sentence}” has no words of its own", "", "")
    examples = {marks[each.name]: _example(each.kind, tongue, names) for each in skill.parameters}
    joint = "" if tongue == "zh" else " "
    return [joint.join(examples.get(token, token) for token in way) for way in kept]


def _ways(expression: Expression) -> list[tuple[str, ...]]:
    match expression:
        case LiteralWords():
            options = (option for each in expression.by_length.values() for option in each)
            rows = sorted(options, key=lambda option: (len(option), option))
            return (
                rows if len(rows) <= 2 * MOST_TRIED else [*rows[:MOST_TRIED], *rows[-MOST_TRIED:]]
            )
        case Sequel():
            combined = islice(product(*map(_ways, expression.parts)), MOST_DRAWN)
            return [tuple(token for part in way for token in part) for way in combined]
        case OneOf():
            return [way for option in expression.options for way in _ways(option)]
        case SlotFilling():
            return _ways(expression.filled_by)
        case _:
            raise TemplateError(
                "@ stands for words that no parameter names: use a parameter", "", ""
            )


def _example(kind: ParameterKind, tongue: str, names: Vocabulary) -> str:
    if kind is ParameterKind.PLACE:
        first = next(iter(names.entries), None)
        return first.name.of(tongue) if first is not None else ""
    return _SAID[tongue][kind]


def _check_said(
    skill: Skill, said: str, line: int, names: Vocabulary, with_own: Vocabulary, others: Vocabulary
) -> None:
    stops = is_stop(said) or read_stop(said) is not StopReading.NONE
    place = is_bare(said.casefold(), names)
    if stops or place or intent_of(said) is not None or consents(said) is not None:
        raise SkillProblem("skill_words_taken", skill.file, line, said=said)
    if means_already(said, names):
        raise SkillProblem("skill_words_taken", skill.file, line, said=said)
    if (other := called_by(said, others)) is not None:
        raise SkillProblem("skill_words_shared", skill.file, line, said=said, other=other)
    if called_by(said, with_own) != skill.name:
        raise SkillProblem("skill_unheard", skill.file, line, said=said)


def called_by(said: str, names: Vocabulary) -> str | None:
    """Return the skill that a sentence calls; None: it calls none, or does more."""
    if not names.skills:
        return None
    made = plan(said, names, Context(runnable=EVERY_KIND | names.calls))
    steps = made.steps if isinstance(made, StepPlan) else ()
    return steps[0].name if len(steps) == 1 and isinstance(steps[0], UseSkill) else None
