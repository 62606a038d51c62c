"""A skill is heard by its own words, does its steps, and takes nothing from other sentences."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest

from planner.brain import Brain, FallbackBrain, OfflineBrain, ScriptedBrain, ThinkRequest
from planner.brain.endpoint.plan_reply import judge
from planner.brain.prompt import BUDGET_TOKENS, Prompt
from planner.brain.prompt_tokens import count_tokens
from planner.brain.schema import schema_of
from planner.language.grammar import Context, plan
from planner.language.templates.skills import with_skills
from planner.mission.effects import AskBrain
from planner.mission.events import Planned
from planner.mission.plan_request import thinker
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Code,
    GoTo,
    If,
    Language,
    Patrol,
    Say,
    Skill,
    Step,
    StepPlan,
    UseSkill,
    Vocabulary,
    say_same,
)
from planner.site import Site
from planner.site.site_view import vocabulary_of
from planner.skill_files.calls import SkillScene, UnfoldedPlan, unfold
from planner.skill_files.folder import read_folder

BARE = vocabulary_of(Site.load(Path("sites/home")))
ROUND = """
en = ["do the evening round [in {where}]", "start the kitchen round"]
zh = ["做晚间巡视", "开始{where}的晚间巡视"]
steps = [
  {kind = "patrol", places = ["bedroom", "{where}"], look = true},
  {kind = "say", text = {en = "The {where} is done.", zh = "{where}看完了。"}},
]
[parameters.where]
kind = "place"
default = "study"
"""
PLANTS = '''
from pons.skill import Place, Step, Thing, World, go_to, say


def plants(where: Place, what: Thing, times: int, world: World) -> list[Step]:
    """Look after the plants.

    en: water the {what} in {where} {times} times
    zh: 给{where}的{what}浇{times}次水
    """
    return [go_to(where), say(f"{what} {times + 1} {world.name(where)} {world.room}")]
'''
TIME = '''
from pons.skill import Duration, World


def tea(long: Duration = 180) -> str:
    """Say how long the tea draws.

    en: brew the tea [for {long}]
    zh: 泡茶[{long}]
    """
    return f"The tea draws for {long:.0f} seconds."
'''


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> Vocabulary:
    folder = tmp_path_factory.mktemp("skills")
    (folder / "evening_round.toml").write_text(ROUND, "utf-8")
    (folder / "plants.py").write_text(PLANTS, "utf-8")
    (folder / "tea.py").write_text(TIME, "utf-8")
    read = read_folder(folder, BARE)
    assert not read.problems, [each.said.en for each in read.problems]
    return with_skills(BARE, read.skills)


def _read(text: str, names: Vocabulary) -> object:
    return plan(text, names, Context(runnable=EVERY_KIND | names.calls))


def _call(name: str, *arguments: str) -> StepPlan:
    return StepPlan(steps=(UseSkill(name=name, arguments=arguments),))


@pytest.mark.parametrize(
    ("text", "name", "given"),
    [
        ("do the evening round", "evening_round", ("",)),
        ("Please do the evening round!", "evening_round", ("",)),
        ("could you do the evening round in the kitchen?", "evening_round", ("kitchen",)),
        ("start the kitchen round", "evening_round", ("",)),
        ("做晚间巡视", "evening_round", ("",)),
        ("请开始厨房的晚间巡视", "evening_round", ("kitchen",)),
        ("water the red flowers in the study three times", "plants", ("study", "red flowers", "3")),
        ("给书房的花浇2次水", "plants", ("study", "花", "2")),
        ("brew the tea", "tea", ("",)),
        ("brew the tea for 5 minutes", "tea", ("300",)),
        ("泡茶三分钟", "tea", ("180",)),
    ],
)
def test_a_skill_is_heard_with_what_it_is_given(
    names: Vocabulary, text: str, name: str, given: tuple[str, ...]
) -> None:
    assert _read(text, names) == _call(name, *given)


@pytest.mark.parametrize(
    "text",
    [
        "don't do the evening round",
        "do the evening round if it rains",
        "did you do the evening round?",
        "shall we do the evening round",
        "start the bedroom round",
        "I did the evening round",
        "不要做晚间巡视",
    ],
)
def test_words_around_a_skill_call_nothing(names: Vocabulary, text: str) -> None:
    made = _read(text, names)
    assert not (isinstance(made, StepPlan) and made.steps[0].kind == "use_skill")


def test_a_skill_is_one_order_among_others(names: Vocabulary) -> None:
    made = _read("do the evening round, then go to the bedroom", names)
    assert isinstance(made, StepPlan)
    assert [step.kind for step in made.steps] == ["use_skill", "go_to"]
    late = _read("if it is after 10 pm do the evening round", names)
    assert isinstance(late, StepPlan)
    assert isinstance(late.steps[0], If)


@pytest.mark.parametrize(
    "text", ["go to the kitchen", "find the red cup", "去厨房", "patrol", "stop"]
)
def test_other_sentences_are_read_as_before(names: Vocabulary, text: str) -> None:
    assert _read(text, names) == plan(text, BARE, Context(runnable=EVERY_KIND))


def _unfold(made: StepPlan, names: Vocabulary, language: Language = Language.EN) -> UnfoldedPlan:
    return asyncio.run(unfold(made, SkillScene(names, language, "hallway")))


def _steps(made: StepPlan, names: Vocabulary, language: Language = Language.EN) -> tuple[Step, ...]:
    plan = _unfold(made, names, language).plan
    assert isinstance(plan, StepPlan)
    return plan.steps


def _kinds(planned: Planned) -> list[str]:
    assert isinstance(planned.plan, StepPlan)
    return [step.kind for step in planned.plan.steps]


def test_a_routine_is_filled_in_by_the_language_of_the_sentence(names: Vocabulary) -> None:
    call = _call("evening_round", "kitchen")
    round_ = Patrol(places=("bedroom", "kitchen"), look=True)
    assert _steps(call, names) == (round_, Say(text="The kitchen is done."))
    told = _steps(call, names, Language.ZH)
    assert told == (round_, Say(text="厨房看完了。"))


def test_a_function_works_out_steps_and_words(names: Vocabulary) -> None:
    made = _steps(_call("plants", "study", "fern", "2"), names)
    assert made == (GoTo(place="study"), Say(text="fern 3 study hallway"))
    told = _unfold(_call("tea", "300"), names).plan
    assert told == AnswerPlan(text=say_same("The tea draws for 300 seconds."))
    both = StepPlan(steps=(*_call("tea").steps, GoTo(place="study")))
    assert [step.kind for step in _steps(both, names)] == ["say", "go_to"]


def test_calls_in_branches_are_replaced_and_evidence_stays_with_its_step(names: Vocabulary) -> None:
    made = StepPlan.model_validate(
        {
            "steps": [
                {"kind": "go_to", "place": "study"},
                {
                    "kind": "try",
                    "steps": [{"kind": "use_skill", "name": "evening_round"}],
                    "on_failure": [{"kind": "return_home"}],
                },
            ],
            "asked_by": ["a", "b", "c", "d"],
        }
    )
    unfolded = _unfold(made, names)
    assert unfolded.row == (0, 1, 2, 2, 3)
    assert isinstance(unfolded.plan, StepPlan)
    assert unfolded.plan.asked_by == ("a", "b", "c", "c", "d")
    assert unfolded.own == {2, 3}
    assert unfolded.find_unasked((3,), by_grammar=True) == (4,)
    assert unfolded.find_unasked((), by_grammar=False) == (2,)


def _think(brain: Brain, text: str, names: Vocabulary) -> Planned:
    ask = AskBrain(id="g1", text=text, language=Language.EN)

    async def think() -> Planned:
        return await thinker(brain, names)(ask)

    return asyncio.run(think())


def test_the_missions_are_handed_steps_alone(names: Vocabulary) -> None:
    planned = _think(OfflineBrain(), "water the fern in the study 3 times", names)
    assert _kinds(planned) == ["go_to", "say"]
    assert planned.unasked == ()


def test_a_skill_that_fails_ends_the_goal_with_its_line_and_cure(tmp_path: Path) -> None:
    bad = PLANTS.replace("[go_to(where)", "[go_to(places[0])")
    (tmp_path / "plants.py").write_text(bad, "utf-8")
    names = with_skills(BARE, read_folder(tmp_path, BARE).skills)
    planned = _think(OfflineBrain(), "water the fern in the study 3 times", names)
    assert planned.plan is None
    assert planned.failure is not None
    assert planned.failure.code is Code.SKILL_FAILED
    assert "plants.py:11" in planned.failure.message.en
    assert "plants.py:11" in planned.failure.message.zh


def test_with_a_model_a_skill_is_heard_by_its_own_words_without_a_call(names: Vocabulary) -> None:
    model = ScriptedBrain(replies=[], hangs=True)
    planned = _think(FallbackBrain(model, OfflineBrain()), "do the evening round", names)
    assert _kinds(planned) == ["patrol", "say"]
    assert planned.unasked == ()


def test_a_model_that_guesses_a_skill_waits_for_a_yes(names: Vocabulary) -> None:
    step = {"kind": "use_skill", "name": "evening_round", "because": "see that all is well"}
    runnable = EVERY_KIND | names.calls
    made = judge(json.dumps({"kind": "plan", "steps": [step]}), names, runnable)
    assert isinstance(made, StepPlan)
    model = ScriptedBrain(replies=[made], by_grammar=False)
    planned = _think(model, "see that all is well tonight", names)
    assert _kinds(planned) == ["patrol", "say"]
    assert planned.unasked == (0,)


def test_a_model_is_shown_skills_within_the_bound(names: Vocabulary) -> None:
    request = ThinkRequest(text="x", vocabulary=names, runnable=EVERY_KIND | names.calls)
    told = Prompt.load().messages(request)[0]["content"]
    assert 'use_skill {"name":"evening_round","arguments":["where"]} do the evening round' in told
    assert "'arguments'" in str(schema_of(names, EVERY_KIND | names.calls))
    many = tuple(Skill(name=f"s{n}", file="x", en=(f"whirl number {n} round",)) for n in range(32))
    full = ThinkRequest(
        text="x", vocabulary=with_skills(BARE, many), runnable=EVERY_KIND | frozenset({"use_skill"})
    )
    system = Prompt.load().messages(full)[0]["content"]
    assert "use_skill" in system
    assert count_tokens(system) <= BUDGET_TOKENS


def test_without_skills_no_model_hears_of_them() -> None:
    request = ThinkRequest(text="x", vocabulary=BARE, runnable=EVERY_KIND)
    assert "use_skill" not in Prompt.load().messages(request)[0]["content"]
    assert "use_skill" not in str(schema_of(BARE, EVERY_KIND))
