"""Make and try skills of one's own: ``pons skill new | list | check | try``.

``list`` asks the planner; the others work on files, move nothing and need no running robot, whose
taught places they know where one answers.
"""

from __future__ import annotations

import asyncio
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pons.command_parser import CommandParser
from pons.http import PlannerDown, PlannerProblem, call, tell_unreached
from pons.terminal import pick, pick_of

if TYPE_CHECKING:
    import argparse

    from planner.plan import Vocabulary
    from planner.skill_files.problems import SkillProblem
    from pons.settings import LaunchSettings

EXIT_DONE, EXIT_FOUND, EXIT_USAGE, EXIT_REFUSED, EXIT_DOWN = 0, 1, 2, 3, 6
PATH = "/v1/skills"
_ROUTINE = """\
# A routine: words that call it, and steps. docs/skills.md has them all.
en = ["[do] the {words} [in {{where}}]"]
zh = ["{zh}[去{{where}}]"]
steps = [
  {{kind = "go_to", place = "{{where}}"}},
  {{kind = "say", text = {{en = "I am in the {{where}}.", zh = "我在{{where}}。"}}}},
  {{kind = "return_home"}},
]

[parameters.where]
kind = "place"  # or thing, person, words, number, duration
default = "{place}"
"""
_FUNCTION = '''\
"""A skill: one function, which works out words, facts or steps. docs/skills.md says what it may."""

from pons.skill import Place, Step, World, go_home, go_to, say


def {name}(where: Place, world: World) -> list[Step]:
    """Visit a room and say so.

    en: [do] the {words} in {{where}}
    zh: {zh}去{{where}}
    """
    return [go_to(where), say(f"This is the {{world.name(where)}}."), go_home()]
'''


def parser() -> CommandParser:
    """Return the grammar of ``pons skill``."""
    top = CommandParser(
        prog="pons skill",
        description="Make and try skills of your own: a routine or a Python function, each in a "
        "file, called by words that you choose.",
        examples=['pons skill new evening_round', 'pons skill try "do the evening round"'],
    )  # fmt: skip
    acts = top.add_subparsers(dest="act", required=True, metavar="ACT", parser_class=CommandParser)

    def add(act: str, what: str, example: str) -> argparse.ArgumentParser:
        return acts.add_parser(act, help=what, description=what, examples=[example])

    made = add("new", "write an example to begin with", "pons skill new plants --python")
    made.add_argument("name", help="of the skill: small letters, digits, _")
    made.add_argument(
        "--python", action="store_true", help="a function, where steps are worked out"
    )
    listed = add("list", "list the skills of the robot that runs", "pons skill list --json")
    listed.add_argument("--json", action="store_true", help="as JSON")
    checked = add("check", "say what is wrong in the files, with line and cure", "pons skill check")
    checked.add_argument("files", nargs="*", type=Path, metavar="FILE", help="all unless named")
    tried = add("try", "show what a sentence would do; nothing moves", 'pons skill try "brew tea"')
    tried.add_argument("text", nargs="+", help="the sentence")
    tried.add_argument("--json", action="store_true", help="the steps as JSON")
    return top


def run(settings: LaunchSettings, words: list[str]) -> int:
    """Do one act; 0 done, 1 something is wrong or not called, 2 bad order, 3 refused, 6 down."""
    said = parser().parse_args(words)
    if said.act == "new":
        return _new(settings, said.name, is_function=said.python)
    if said.act == "list":
        return _list(settings, as_json=said.json)
    if said.act == "check":
        return _check(settings, said.files)
    return _try(settings, " ".join(said.text), as_json=said.json)


def _new(settings: LaunchSettings, name: str, *, is_function: bool) -> int:
    from planner.skill_files.folder import FOLDER
    from planner.skill_files.problems import SkillProblem
    from planner.skill_files.skill_file import check_name

    path = settings.home / FOLDER / f"{name}.{'py' if is_function else 'toml'}"
    try:
        check_name(name, path.name)
        if any(path.with_suffix(kind).exists() for kind in (".toml", ".py")):
            raise SkillProblem("skill_exists", path.name, name=name, file_name=path.name)
        place = next(iter(_names(settings).by_id), "kitchen")
        text = _FUNCTION if is_function else _ROUTINE
        words = name.replace("_", " ")
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        path.write_text(text.format(name=name, words=words, zh=f"执行{name}", place=place), "utf-8")
    except SkillProblem as problem:
        return _tell(problem, EXIT_REFUSED)
    except OSError as wrong:
        return _tell(SkillProblem("skill_unwritable", path.name, what=wrong.strerror), EXIT_USAGE)
    print(path)
    print(pick(f'say "the {words}"; `pons skill check` looks at it', "`pons skill check` 检查它"))
    return EXIT_DONE


def _list(settings: LaunchSettings, *, as_json: bool) -> int:
    try:
        found: dict[str, Any] = call(settings, "GET", PATH)
    except PlannerProblem as refused:
        print(f"refused: {refused}", file=sys.stderr)
        return EXIT_REFUSED
    except PlannerDown as trouble:
        print(tell_unreached(trouble), file=sys.stderr)
        return EXIT_DOWN
    if as_json:
        print(json.dumps(found, ensure_ascii=False, indent=1))
        return EXIT_DONE
    for skill in found["skills"]:
        print(f"{skill['file']:<24} {'  '.join((*skill['en'], *skill['zh']))}")
    for problem in found["problems"]:
        print(
            f"{problem['file']}:{problem['line']}: {problem['code']}: {pick_of(problem['message'])}"
        )
    if not found["skills"] and not found["problems"]:
        print(pick("no skill yet: pons skill new NAME", "还没有技能：pons skill new 名称"))
    return EXIT_DONE


def _names(settings: LaunchSettings) -> Vocabulary:
    """Return the names of the site, with what was taught to a planner that answers."""
    from planner.plan import Bilingual, Entry, Vocabulary
    from planner.site import Site
    from planner.site.site_view import vocabulary_of

    names = vocabulary_of(Site.load(settings.site))
    try:
        places = call(settings, "GET", "/v1/places")["places"]
    except (PlannerDown, PlannerProblem):
        return names
    taught = (
        Entry(id=each["id"], kind="place", name=Bilingual.model_validate(each["name"]))
        for each in places
        if each["id"] not in names
    )
    return Vocabulary(entries=(*names.entries, *taught), sentences=names.sentences)


def _check(settings: LaunchSettings, files: list[Path]) -> int:
    from planner.plan import Skill
    from planner.skill_files.folder import FOLDER, SkillsRead, judge_skill, read_folder
    from planner.skill_files.problems import SkillProblem

    names = _names(settings)
    read = read_folder(settings.home / FOLDER, names)
    if files:
        skills: list[Skill] = []
        problems: list[SkillProblem] = []
        for path in files:
            try:
                skills.append(judge_skill(path, names, tuple(skills)))
            except SkillProblem as problem:
                problems.append(problem)
        read = SkillsRead(tuple(skills), tuple(problems))
    for skill in read.skills:
        print(f"ok   {skill.file:<24} {'  '.join((*skill.en, *skill.zh))}")
    for each in read.problems:
        _tell(each, EXIT_FOUND)
    if not read.skills and not read.problems:
        print(pick("no skill yet: pons skill new NAME", "还没有技能：pons skill new 名称"))
    return EXIT_FOUND if read.problems else EXIT_DONE


def _try(settings: LaunchSettings, text: str, *, as_json: bool) -> int:
    from planner.language.grammar import Context, plan
    from planner.language.plan_words import tell_steps
    from planner.language.sentence import parse
    from planner.language.templates.skills import with_skills
    from planner.plan import EVERY_KIND, AnswerPlan, StepPlan, holds_call
    from planner.skill_files.calls import SkillFailure, SkillScene, unfold
    from planner.skill_files.folder import FOLDER, read_folder

    bare = _names(settings)
    read = read_folder(settings.home / FOLDER, bare)
    names = with_skills(bare, read.skills)
    made = plan(text, names, Context(runnable=EVERY_KIND | names.calls))
    if not isinstance(made, StepPlan) or not holds_call(made.steps):
        for problem in read.problems:  # it may be one that can't be read
            _tell(problem, EXIT_FOUND)
        told = pick("these words call no skill; they are", "这句话不调用技能；技能有")
        print(
            f"skill_not_called: {told}: {', '.join(s.name for s in read.skills)}", file=sys.stderr
        )
        return EXIT_FOUND
    try:
        done = asyncio.run(unfold(made, SkillScene(names, parse(text).language))).plan
    except SkillFailure as failed:
        return _tell(failed.problem, EXIT_FOUND)
    if isinstance(done, AnswerPlan):
        print(pick(done.text.en, done.text.zh))
        return EXIT_DONE
    if not isinstance(done, StepPlan):
        return EXIT_FOUND
    if as_json:
        print(
            json.dumps(done.model_dump(mode="json", exclude_none=True)["steps"], ensure_ascii=False)
        )
        return EXIT_DONE
    for number, step in enumerate(done.steps, 1):
        words = tell_steps([step], names.name)
        print(f"{number}. {pick(words.en, words.zh)}")
    return EXIT_DONE


def _tell(problem: SkillProblem, status: int) -> int:
    told = pick(problem.said.en, problem.said.zh)
    print(f"{problem.file}:{problem.line}: {problem.code}: {told}", file=sys.stderr)
    return status
