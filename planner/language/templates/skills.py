"""Write the sentences that call skills as templates, and build the call from what was found.

The owner's sentences are of the same slot language as ours; a name of a place in them is told apart
as it is in what people say, so that "the kitchen round" is heard beside a place called kitchen.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.noun_phrases import go_to
from planner.language.grammar.parse_result import Meaning, Reading, Steps
from planner.language.grammar.quotes import FIRST_QUOTE
from planner.language.grammar.sentence_text import normalise
from planner.language.numbers import seconds
from planner.plan import Code, GoTo, ParameterKind, UseSkill

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from planner.language.grammar.lexicon import Lexicon
    from planner.language.templates.template_file import TemplateFind
    from planner.plan import Parameter, Skill, Vocabulary

SYNTAX = re.compile(r"(\{[^}]*\}|<[^>]*>|[\[\]()|]|@[a-z]+)")
_FREE = {ParameterKind.THING: "@thing", ParameterKind.PERSON: "@person | @plain"}
_SPOT = "[<the>] @place [room|area] | @words"
_SPOT_ZH = "@place | @item"
_ZH = dict.fromkeys((ParameterKind.THING, ParameterKind.PERSON), "@person | @item")
_PLACED = "_at"
"""Slots of places that a sentence names itself; no parameter's name begins so."""


def filled_by(parameter: Parameter, language: str) -> str:
    """Return what fills a parameter's slot, in the slot language."""
    match parameter.kind:
        case ParameterKind.PLACE:
            return _SPOT_ZH if language == "zh" else _SPOT
        case ParameterKind.DURATION:
            return "@duration"
        case kind:
            own = _ZH if language == "zh" else _FREE
            return own.get(kind, "@quote | @words")


def write_templates(skills: Sequence[Skill], lexicon: Lexicon) -> str:
    """Return the templates of these skills as a file of sentences."""
    words: dict[str, list[str]] = {"en": [], "zh": []}
    rows: list[str] = []
    for skill in skills:
        for tongue in words:
            words[tongue] += [
                f"{skill.name}_{each.name} = {json.dumps(filled_by(each, tongue))}"
                for each in skill.parameters
            ]
        for tongue in words:
            for said in getattr(skill, tongue):
                rows += _row(skill, tongue, said, lexicon)
    head = [
        line
        for tongue in words
        for line in (f"[words.{tongue}]", "own_spot = '@place'", *words[tongue])
    ]
    return "\n".join([*head, *rows, ""]) if rows else ""


def with_skills(names: Vocabulary, skills: tuple[Skill, ...]) -> Vocabulary:
    """Return names with these skills in place of those before."""
    templates = write_templates(skills, lexicon_of(names))
    return names.model_copy(update={"skills": skills, "skill_templates": templates})


def _row(skill: Skill, tongue: str, said: str, lexicon: Lexicon) -> Iterator[str]:
    """Yield the lines of one sentence's template; places that it names stand among its values."""
    named: list[str] = []
    parts = []
    for part in SYNTAX.split(said):
        slot = part[1:-1].partition(":")[0] if part.startswith("{") else ""
        if slot:
            parts.append(f"{{{slot}:{skill.name}_{slot}}}")
            continue
        if SYNTAX.fullmatch(part):
            parts.append(part)
            continue
        marked = lexicon.mark(normalise(part))
        for char in marked.text:
            if "\ue000" <= char <= "\ue8ff":
                parts.append(f" {{{_PLACED}{len(named)}:own_spot}} ")
                named.append("/".join(marked.mention(char).ids))
            else:
                parts.append(char)
        parts.append(" ")
    slots = [
        *(each.name for each in skill.parameters),
        *(f"{_PLACED}{n}" for n in range(len(named))),
    ]
    values = [f"skill={skill.name}", *(f"{_PLACED}{n}_is={ids}" for n, ids in enumerate(named))]
    yield "[[template]]"
    inside = ", ".join([*values, *slots])
    yield f'plan = "use_skill({inside})"'
    yield f"{tongue} = [{json.dumps(''.join(parts), ensure_ascii=False)}]"


def use_skill(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read a call of a skill with what it is given."""
    skill = reading.vocabulary.skill(found["skill"])
    if skill is None:
        return None
    for slot in (
        each for each in found.slots if each.startswith(_PLACED) and not each.endswith("_is")
    ):
        named = set(reading.marked.mention(found[slot]).ids)
        if named.isdisjoint(found[f"{slot}_is"].split("/")):
            return None
    given: list[str] = []
    for parameter in skill.parameters:
        value = _argument(parameter, found, reading)
        if not isinstance(value, str):
            return value
        given.append(value)
    return Steps((UseSkill(name=skill.name, arguments=tuple(given)),))


def _argument(parameter: Parameter, found: TemplateFind, reading: Reading) -> str | Meaning:
    """Return what a parameter is given; or why it is given nothing. Left out, it is empty."""
    said = found[parameter.name]
    if not said:
        return ""
    match parameter.kind:
        case ParameterKind.PLACE:
            meaning = go_to(said, reading)
            goal = meaning.steps[0] if isinstance(meaning, Steps) and meaning.steps else None
            if isinstance(goal, GoTo):
                return goal.place
            return reading.problem(Code.NOT_UNDERSTOOD, found[0]) if goal else meaning
        case ParameterKind.DURATION:
            return f"{found.amounts[parameter.name]:g}"
        case ParameterKind.NUMBER:
            number = seconds(said, "s")
            problem = reading.problem(Code.NOT_UNDERSTOOD, found[0])
            return problem if number is None else f"{number:g}"
        case _ if len(said) == 1 and "\uf800" <= said <= "\uf8ff":
            return reading.quotes[ord(said) - FIRST_QUOTE][:200]
        case _:
            return reading.marked.restore(said)[:200]
