"""Put the steps of skills in the place of the calls in a plan, before anything of it is judged.

A routine's steps stand in its file; a function's are worked out by its process, from what it is
given alone. Both are then judged like anybody's. Law: no call is left in a plan that is returned.
"""

from __future__ import annotations

import asyncio
import json
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Any

from planner.language.grammar.sentence_text import squash
from planner.language.motion_guard.unasked_motion import can_move
from planner.plan import (
    AnswerPlan,
    Attempt,
    If,
    Language,
    ParameterKind,
    Plan,
    Repeat,
    Say,
    Skill,
    Step,
    StepPlan,
    UseSkill,
    Vocabulary,
    holds_call,
    list_nodes,
    say_same,
)
from planner.skill_files.problems import SkillProblem
from planner.skill_files.sandbox import call_function
from planner.skill_files.skill_file import fill_steps, steps_from

if TYPE_CHECKING:
    pass

MOST_WORDS = 500
_HELD = ("then", "otherwise", "steps", "on_failure")


@dataclass(frozen=True, slots=True)
class SkillScene:
    """Hold what a function is told of where things stand."""

    names: Vocabulary
    language: Language
    room: str | None = None
    battery: float | None = None
    now: datetime | None = None

    def describe(self) -> dict[str, Any]:
        """Return it as the fields of ``pons.skill.World``."""
        places = {
            each.id: {"en": each.name.en, "zh": each.name.zh, "kind": each.kind, "room": each.room}
            for each in self.names.entries
        }
        now = self.now or datetime.now().astimezone()
        return {
            "places": places, "room": self.room, "battery": self.battery,
            "now": now.isoformat(timespec="seconds"), "language": self.language.value,
        }  # fmt: skip


class SkillFailure(Exception):
    """A call can't be carried out; ``outcome`` is how its goal ends."""

    def __init__(self, name: str, problem: SkillProblem) -> None:
        super().__init__(str(problem))
        self.problem, self.outcome = problem, problem.outcome(name)


@dataclass(frozen=True, slots=True)
class UnfoldedPlan:
    """Hold a plan without calls, and where each step of its row stood in the one before."""

    plan: Plan
    row: tuple[int, ...] = ()
    own: frozenset[int] = frozenset()
    """The steps that came from skills."""

    def find_unasked(self, before: tuple[int, ...], *, by_grammar: bool) -> tuple[int, ...]:
        """Return the steps that nobody asked for, given those of the plan before.

        A skill's own words ask for all that it does; a model that calls one has guessed that it is
        meant, and a person is asked.
        """
        if not self.row:
            return before
        row = list_nodes(self.plan.steps if isinstance(self.plan, StepPlan) else ())
        guessed = (at for at in self.own if not by_grammar and can_move(row[at].step))
        kept = (at for at, old in enumerate(self.row) if old in before)
        return tuple(sorted({*guessed, *kept}))


async def unfold(plan: Plan, scene: SkillScene) -> UnfoldedPlan:
    """Return a plan with the steps of its skills; one that calls none is returned as it is.

    Raises:
        SkillFailure: one can't be carried out, and nothing of the plan is done.
    """
    if not isinstance(plan, StepPlan) or not holds_call(plan.steps):
        return UnfoldedPlan(plan)
    plan = StepPlan.model_validate(plan.model_dump())  # each step an object of its own
    calls = {id(n.step): n.step for n in list_nodes(plan.steps) if isinstance(n.step, UseSkill)}
    made = {key: await carry_out(call, scene) for key, call in calls.items()}
    alone = plan.steps[0] if len(plan.steps) == 1 else None
    if isinstance(alone, UseSkill):
        words = made[id(alone)]
        if isinstance(words, str):
            return UnfoldedPlan(AnswerPlan(text=say_same(words)))
    before = {id(node.step): at for at, node in enumerate(list_nodes(plan.steps))}
    came: dict[int, tuple[int, bool]] = {}

    def put(step: Step) -> tuple[Step, ...]:
        at = before[id(step)]
        if isinstance(step, UseSkill):
            found = made[id(step)]
            steps = (Say(text=found),) if isinstance(found, str) else found
            came.update({id(node.step): (at, True) for node in list_nodes(steps)})
            return steps
        changed = step
        if isinstance(step, If | Attempt | Repeat):
            held = {
                name: tuple(new for each in getattr(step, name) for new in put(each))
                for name in _HELD
                if hasattr(step, name)
            }
            changed = step.model_copy(update=held)
        came[id(changed)] = (at, False)
        return (changed,)

    steps = tuple(new for step in plan.steps for new in put(step))
    row = [came.get(id(n.step), (before.get(id(n.step), 0), False)) for n in list_nodes(steps)]
    quoted = plan.asked_by
    asked = tuple(quoted[at] for at, _ in row) if len(quoted) == len(before) else ()
    own = frozenset(at for at, (_, of_skill) in enumerate(row) if of_skill)
    unfolded = plan.model_copy(update={"steps": steps, "asked_by": asked})
    return UnfoldedPlan(unfolded, tuple(at for at, _ in row), own)


async def carry_out(call: UseSkill, scene: SkillScene) -> tuple[Step, ...] | str:
    """Return the steps, or the words, that a call stands for. Raises SkillFailure."""
    skill = scene.names.skill(call.name)
    try:
        if skill is None:
            known = ", ".join(each.name for each in scene.names.skills) or "none"
            raise SkillProblem("skill_unknown", f"{call.name}.toml", name=call.name, known=known)
        values = [_value(skill, at, call.arguments, scene) for at in range(len(skill.parameters))]
        if not skill.is_function:
            rows = json.loads(skill.steps)
            return steps_from(skill.file, _routine(rows, skill, values, scene)).steps
        given: list[Any] = [
            _to_number(each.kind, v) for each, v in zip(skill.parameters, values, strict=True)
        ]
        if skill.takes_world is not None:
            given.insert(skill.takes_world, scene.describe())
        asked = (skill.file, skill.source, skill.function, given)
        return _read_answer(skill, await asyncio.to_thread(call_function, *asked))
    except SkillProblem as problem:
        raise SkillFailure(call.name, problem) from None


def _routine(rows: Any, skill: Skill, values: list[str], scene: SkillScene) -> Any:
    """Return a routine's steps filled in; words that are said have places by their names."""
    told = [
        scene.names.name(value).of(scene.language) if each.kind is ParameterKind.PLACE else value
        for each, value in zip(skill.parameters, values, strict=True)
    ]
    language = scene.language.value
    filled, spoken = (
        fill_steps(rows, skill, values, language),
        fill_steps(rows, skill, told, language),
    )
    return _with_words(filled, spoken)


def _with_words(filled: Any, spoken: Any) -> Any:
    """Return steps with what is said or asked by the names that people use."""
    if isinstance(filled, dict):
        return {
            name: spoken[name] if name in ("text", "question") else _with_words(each, spoken[name])
            for name, each in filled.items()
        }
    if isinstance(filled, list):
        return [_with_words(*pair) for pair in zip(filled, spoken, strict=True)]
    return filled


def _value(skill: Skill, at: int, arguments: tuple[str, ...], scene: SkillScene) -> str:
    parameter = skill.parameters[at]
    said = (arguments[at] if at < len(arguments) else "") or parameter.default
    if said is None:
        raise SkillProblem("skill_argument", skill.file, name=parameter.name, said="")
    if parameter.kind is ParameterKind.PLACE:
        wanted = squash(said)
        found = [
            e.id for e in scene.names.entries if said == e.id or wanted in map(squash, e.spellings)
        ]
        if len(found) != 1:
            raise SkillProblem("skill_argument", skill.file, name=parameter.name, said=said)
        return found[0]
    if parameter.kind in (ParameterKind.NUMBER, ParameterKind.DURATION):
        try:
            float(said)
        except ValueError:
            raise SkillProblem(
                "skill_argument", skill.file, name=parameter.name, said=said
            ) from None
    return said


def _to_number(kind: ParameterKind, value: str) -> str | float | int:
    if kind not in (ParameterKind.NUMBER, ParameterKind.DURATION):
        return value
    number = float(value)
    return int(number) if number.is_integer() else number


def _read_answer(skill: Skill, answer: dict[str, Any]) -> tuple[Step, ...] | str:
    if "steps" in answer:
        if not answer["steps"]:
            raise SkillProblem("skill_result", skill.file, what="[]")
        return steps_from(skill.file, answer["steps"]).steps
    facts = answer.get("facts")
    told = answer.get("words")
    if isinstance(facts, dict):
        told = ", ".join(f"{name}: {value}" for name, value in facts.items())
    told = " ".join(told.split()) if isinstance(told, str) else ""
    if not 1 <= len(told) <= MOST_WORDS:
        raise SkillProblem("skill_result", skill.file, what=f"{len(told)} characters")
    return told
