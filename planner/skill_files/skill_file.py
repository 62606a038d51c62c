"""Read one file of the owner's into a skill: a routine (``.toml``) or a function (``.py``).

Neither is run here: a function's file is read by a process of its own (``sandbox.py``).
"""

from __future__ import annotations

import json
import os
import re
import stat
import tomllib
import unicodedata
from itertools import islice
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from planner.plan import (
    EVERY_KIND,
    Code,
    ParameterKind,
    Skill,
    StepPlan,
    Vocabulary,
    check_plan,
)
from planner.plan.skill import SkillName
from planner.skill_files.problems import SkillProblem
from planner.skill_files.sandbox import read_source

MOST_BYTES = 32_000
KINDS = (".toml", ".py")
_NAME: TypeAdapter[str] = TypeAdapter(SkillName)
_KEYS = frozenset({"en", "zh", "about", "parameters", "steps"})
_BLANK = re.compile(r"\{([a-z][a-z0-9_]*)\}")
_NEVER = frozenset({"use_skill", "use_tool", "go_to_pose"})
"""A skill calls none, and gives no point of the map: a person points, and nobody else."""
_EXAMPLES = {
    ParameterKind.THING: "red cup",
    ParameterKind.PERSON: "Anna",
    ParameterKind.WORDS: "dinner is ready",
    ParameterKind.NUMBER: "3",
    ParameterKind.DURATION: "5",
}


def read_skill(path: Path) -> Skill:
    """Return the skill of a file. Raises SkillProblem: with its code, line and cure."""
    text = _text_of(path)
    found = _routine(path.name, text) if path.suffix == ".toml" else _function(path.name, text)
    if not found.en and not found.zh:
        raise SkillProblem("skill_wordless", path.name)
    return found


def check_name(name: str, file: str) -> None:
    """Judge the name of a skill. Raises SkillProblem."""
    try:
        _NAME.validate_python(name)
    except ValidationError:
        raise SkillProblem("skill_name", file) from None


def _text_of(path: Path) -> str:
    """Return a file's text; a link, a device, a pipe and what is too long are refused unread."""
    name = path.name
    check_name(path.stem, name)
    try:
        opened = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as wrong:
        code = "skill_link" if path.is_symlink() else "skill_unreadable"
        raise SkillProblem(code, name, what=wrong.strerror) from None
    try:
        if not stat.S_ISREG(os.fstat(opened).st_mode):
            raise SkillProblem("skill_link", name)
        raw = os.read(opened, MOST_BYTES + 1)
    finally:
        os.close(opened)
    if len(raw) > MOST_BYTES:
        raise SkillProblem("skill_long", name, most=MOST_BYTES)
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError as wrong:
        line = raw[: wrong.start].count(b"\n") + 1
        raise SkillProblem("skill_unreadable", name, line, what="not UTF-8") from None
    for number, line_text in enumerate(text.split("\n"), 1):
        if any(
            unicodedata.category(each) in ("Cc", "Cf", "Co") and each not in "\t\r"
            for each in line_text
        ):
            raise SkillProblem("skill_unseen", name, number)
    return text


def _routine(file: str, text: str) -> Skill:
    try:
        data = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as wrong:
        told, _, at = str(wrong).rpartition("(at line ")
        line = int(at.split(",")[0]) if at.split(",")[0].isdigit() else 1 + text.count("\n")
        raise SkillProblem("skill_not_toml", file, line, what=told.strip() or str(wrong)) from None
    unknown = sorted(data.keys() - _KEYS)
    if unknown:
        raise SkillProblem(
            "skill_key",
            file,
            _line_with(text, unknown[0]),
            name=unknown[0],
            known=", ".join(sorted(_KEYS)),
        )
    steps = data.get("steps")
    if not isinstance(steps, list) or not steps or not all(isinstance(s, dict) for s in steps):
        raise SkillProblem("skill_stepless", file, _line_with(text, "steps"))
    if any(each.get("kind") == "use_skill" for each in _every(steps)):
        raise SkillProblem("skill_nested", file, _line_with(text, "use_skill"))
    given = data.get("parameters", {})
    rows = [
        {"name": name, **(row if isinstance(row, dict) else {"kind": row})}
        for name, row in (given.items() if isinstance(given, dict) else ())
    ]
    told = json.dumps(steps, ensure_ascii=False, default=str)
    fields = {"parameters": rows, "about": data.get("about", ""), "steps": told}
    return _skill(
        file, text, fields | {each: _as_list(data.get(each, ())) for each in ("en", "zh")}
    )


def _function(file: str, text: str) -> Skill:
    read = read_source(file, text)
    given = read["parameters"]
    worlds = [at for at, each in enumerate(given) if each["kind"] == "world"]
    fields = {
        **{name: read[name] for name in ("function", "en", "zh")},
        "about": str(read["about"])[:200],
        "parameters": [each for each in given if each["kind"] != "world"],
        "source": text,
        "takes_world": worlds[0] if worlds else None,
    }
    return _skill(file, text, fields)


def _skill(file: str, text: str, fields: dict[str, Any]) -> Skill:
    """Return the record of a file, or the first thing that is wrong in it."""
    try:
        return Skill.model_validate({"name": file.rpartition(".")[0], "file": file, **fields})
    except ValidationError as wrong:
        first = wrong.errors(include_url=False)[0]
        at = ".".join(map(str, first["loc"]))
        clues = [str(first["input"]), *map(str, reversed(first["loc"]))]
        line = next((n for each in clues if (n := _line_with(text, each)) > 1), 1)
        raise SkillProblem("skill_malformed", file, line, at=at, what=first["msg"]) from None


def _as_list(said: object) -> object:
    return [said] if isinstance(said, str) else said


def _line_with(text: str, words: str, nth: int = 0) -> int:
    """Return the line in which words stand for the nth time; 1 where they do not."""
    found = (at for at, line in enumerate(text.splitlines(), 1) for _ in range(line.count(words)))
    return next(islice(found, nth, None), 1)


def _every(steps: object) -> Any:
    """Yield every object within steps, the outer ones first."""
    if isinstance(steps, dict):
        yield steps
        steps = list(steps.values())
    for each in steps if isinstance(steps, list) else ():
        yield from _every(each)


def check_routine(skill: Skill, vocabulary: Vocabulary, text: str) -> None:
    """Judge a routine's steps with an example in each blank. Raises SkillProblem."""
    some = next(iter(vocabulary.by_id), "kitchen")
    values = [_EXAMPLES.get(each.kind, some) for each in skill.parameters]
    rows = json.loads(skill.steps)
    known = {each.name for each in skill.parameters}
    for blank in sorted(set(_BLANK.findall(skill.steps)) - known):
        line = _line_with(text, f"{{{blank}}}")
        raise SkillProblem("skill_blank", skill.file, line, name=blank)
    for number in range(len(rows)):
        line = _line_of(text, rows, number)
        steps_from(skill.file, fill_steps([rows[number]], skill, values, "en"), line)
    whole = steps_from(skill.file, fill_steps(rows, skill, values, "en"))
    rejection = check_plan(whole, vocabulary, EVERY_KIND)
    if rejection is None:
        return
    first = rejection.first
    if first.code is Code.UNKNOWN_PLACE:
        places, line = ", ".join(list(vocabulary.by_id)[:20]), _line_with(text, f'"{first.what}"')
        raise SkillProblem("skill_place", skill.file, line, name=first.what, known=places)
    raise SkillProblem(
        "skill_step", skill.file, _line_with(text, "steps"), at="steps", what=first.what
    )


def _line_of(text: str, rows: list[Any], number: int) -> int:
    """Return the line at which a routine's step begins, by how many objects stand before it."""
    before = sum(1 for row in rows[:number] for each in _every(row) if "kind" in each)
    lines = (at for at, line in enumerate(text.splitlines(), 1) for _ in range(line.count("kind")))
    return next(islice(lines, before, None), _line_with(text, "steps"))


def fill_steps(steps: Any, skill: Skill, values: list[str], language: str) -> Any:
    """Return steps with words in their blanks; a text in two languages is told in one."""
    blanks = dict(zip((f"{{{each.name}}}" for each in skill.parameters), values, strict=True))
    numbers = {
        f"{{{p.name}}}"
        for p in skill.parameters
        if p.kind in (ParameterKind.NUMBER, ParameterKind.DURATION)
    }

    def fill(value: Any) -> Any:
        if isinstance(value, dict) and value.keys() == {"en", "zh"}:
            return fill(value[language])
        if isinstance(value, dict):
            return {name: fill(each) for name, each in value.items()}
        if isinstance(value, list):
            return [fill(each) for each in value]
        if not isinstance(value, str):
            return value
        if value in numbers:
            return _number(blanks[value])
        for blank, word in blanks.items():
            value = value.replace(blank, word)
        return value

    return fill(steps)


def _number(word: str) -> float | int | str:
    try:
        number = float(word)
    except ValueError:
        return word  # the step's own check says what it expected
    return int(number) if number.is_integer() else number


def steps_from(file: str, rows: object, line: int = 1) -> StepPlan:
    """Return steps of the closed vocabulary. Raises SkillProblem: they are none."""
    for each in _every(rows):
        if each.get("kind") in _NEVER:
            raise SkillProblem(
                "skill_step", file, line, at="kind", what=f"{each['kind']} is not a skill's to give"
            )
    try:
        return StepPlan.model_validate({"steps": rows})
    except (ValidationError, RecursionError) as wrong:
        errors = wrong.errors(include_url=False) if isinstance(wrong, ValidationError) else ()
        first = errors[0] if errors else {"loc": (), "msg": "too deep"}
        at = ".".join(map(str, first["loc"][1:]))
        raise SkillProblem("skill_step", file, line, at=at, what=first["msg"]) from None
