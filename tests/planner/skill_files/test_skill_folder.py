"""A skill is usable once its file is saved, gone once it is wrong, and kept by a sentence."""

from __future__ import annotations

import asyncio
import os
import re
import shutil
from pathlib import Path

import pytest

from planner.language.commands import KeepSkill, TeachFact, intent_of
from planner.plan import GoTo, GoToPose, Language, Patrol, Say, StepPlan, UseSkill, Vocabulary, Wait
from planner.site import KnownPlaces, PlaceRefusal, Site
from planner.site.known_places import Lesson
from planner.skill_files.calls import SkillScene, unfold
from planner.skill_files.folder import SkillFolder
from planner.skill_files.keep import SkillKeeper
from planner.skill_files.problems import SkillProblem
from planner.skill_files.words import called_by, list_spoken
from pons import Robot

SITE = Site.load(Path("sites/home"))
TEXT = 'en = "{words}"\nsteps = [{{kind = "go_to", place = "{place}"}}]\n'


@pytest.fixture
def places() -> KnownPlaces:
    return KnownPlaces(SITE)


@pytest.fixture
def folder(tmp_path: Path, places: KnownPlaces) -> SkillFolder:
    return SkillFolder(
        tmp_path, lambda: places.vocabulary, lambda read: places.keep_skills(read.skills)
    )


def _save(folder: SkillFolder, name: str, words: str, place: str = "kitchen") -> Path:
    folder.folder.mkdir(exist_ok=True)
    path = folder.folder / name
    path.write_text(TEXT.format(words=words, place=place), "utf-8")
    return path


def test_a_home_without_skills_has_none(folder: SkillFolder, places: KnownPlaces) -> None:
    assert asyncio.run(folder.look()).skills == ()
    assert places.vocabulary.calls == frozenset()


def test_a_file_is_heard_once_it_is_saved_and_not_when_it_is_gone(
    folder: SkillFolder, places: KnownPlaces
) -> None:
    path = _save(folder, "tour.toml", "show the house")
    asyncio.run(folder.look())
    assert called_by("show the house", places.vocabulary) == "tour"
    assert list_spoken(places.vocabulary, "_") == ["show the house"]
    path.write_text(TEXT.format(words="show the flat to us", place="study"), "utf-8")
    asyncio.run(folder.look())
    assert called_by("show the house", places.vocabulary) is None
    assert called_by("show the flat to us", places.vocabulary) == "tour"
    path.write_text("half a fi", "utf-8")
    [problem] = asyncio.run(folder.look()).problems
    assert problem.code == "skill_not_toml"
    assert called_by("show the flat to us", places.vocabulary) is None
    path.unlink()
    assert not asyncio.run(folder.look()).problems
    assert list_spoken(places.vocabulary, "_") == []


def test_ears_of_a_closed_grammar_are_told_sentences_without_words_of_anybodys(
    folder: SkillFolder, places: KnownPlaces
) -> None:
    folder.folder.mkdir()
    for name in ("evening_round.toml", "plants.py"):
        shutil.copy(Path("examples/skills") / name, folder.folder)
    assert not asyncio.run(folder.look()).problems
    spoken = list_spoken(places.vocabulary, "_")
    assert {"the evening round", "do the evening round and end in _"} <= set(spoken)
    assert not [said for said in spoken if "plant" in said], "it takes a time"


def test_files_that_stay_as_they_are_are_not_read_again(folder: SkillFolder) -> None:
    _save(folder, "tour.toml", "show the house")
    first = asyncio.run(folder.look())
    assert asyncio.run(folder.look()) is first


def test_skills_are_judged_again_when_the_names_of_places_change(tmp_path: Path) -> None:
    known = KnownPlaces(SITE).vocabulary
    names = Vocabulary(entries=known.entries[:2])
    folder = SkillFolder(tmp_path, lambda: names)
    _save(folder, "tour.toml", "show the house", place="study")
    assert asyncio.run(folder.look()).problems[0].code == "skill_place"
    names = known
    assert not asyncio.run(folder.look()).problems


def test_no_place_is_taught_by_the_words_of_a_skill(
    folder: SkillFolder, places: KnownPlaces
) -> None:
    _save(folder, "tour.toml", "show the house")
    asyncio.run(folder.look())
    with pytest.raises(PlaceRefusal, match="place_name_reserved"):
        asyncio.run(places.teach(Lesson(en="show the house")))


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("remember that as the evening round", "evening round"),
        ("Save what you just did as morning tour.", "morning tour"),
        ("把这个记成晚间巡视", "晚间巡视"),
        ("把刚才的任务存为早晨一圈", "早晨一圈"),
    ],
)
def test_an_order_is_kept_by_a_sentence(text: str, name: str) -> None:
    assert intent_of(text) == KeepSkill(name)


@pytest.mark.parametrize(
    "text",
    ["remember that the key is in the drawer", "remember this place as the nook", "记住这里是角落"],
)
def test_facts_and_places_are_kept_as_before(text: str) -> None:
    kept = intent_of(text)
    assert kept is not None
    assert not isinstance(kept, KeepSkill)


def test_kept_steps_are_done_again_by_their_name(folder: SkillFolder, places: KnownPlaces) -> None:
    tour = Patrol(places=("kitchen", "study"), look=True)
    steps = (tour, Say(text='it is "well"'), Wait(seconds=2))
    keeper = SkillKeeper(folder)
    asyncio.run(keeper.keep("evening round", steps))
    assert called_by("do the evening round", places.vocabulary) == "evening_round"
    assert called_by("evening round", places.vocabulary) == "evening_round"
    scene = SkillScene(places.vocabulary, Language.EN)
    made = asyncio.run(unfold(StepPlan(steps=(UseSkill(name="evening_round"),)), scene)).plan
    assert isinstance(made, StepPlan)
    assert made.steps == steps
    with pytest.raises(SkillProblem, match="skill_exists"):
        asyncio.run(keeper.keep("Evening round", steps))
    asyncio.run(keeper.keep("晚间巡视", (GoTo(place="study"),)))
    assert (called_by("做晚间巡视", places.vocabulary) or "").startswith("skill_")


@pytest.mark.parametrize(
    ("name", "step", "code"),
    [
        ("stop", GoTo(place="study"), "skill_words_taken"),
        ("the kitchen", GoTo(place="study"), "skill_words_taken"),
        ("far", GoToPose(map_id="0" * 16, x_m=1.0, y_m=1.0), "skill_step"),
    ],
)
def test_what_can_not_be_kept_leaves_no_file(
    folder: SkillFolder, name: str, step: GoTo | GoToPose, code: str
) -> None:
    with pytest.raises(SkillProblem) as refused:
        asyncio.run(SkillKeeper(folder).keep(name, (step,)))
    assert refused.value.code == code
    assert list(folder.folder.iterdir()) == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_can_not_be_written_is_told(folder: SkillFolder, tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(SkillProblem, match="skill_unwritable"):
        asyncio.run(SkillKeeper(folder).keep("far", (GoTo(place="study"),)))
    tmp_path.chmod(0o700)


def test_the_examples_are_skills_that_do_what_they_say(
    folder: SkillFolder, places: KnownPlaces
) -> None:
    shutil.copytree("examples/skills", folder.folder)
    read = asyncio.run(folder.look())
    assert [each.code for each in read.problems] == []
    assert [each.name for each in read.skills] == ["evening_round", "plants"]
    names = places.vocabulary
    assert called_by("do the evening round and end in the study", names) == "evening_round"
    assert called_by("开始晚间巡视，最后去书房", names) == "evening_round"
    assert called_by("do the plant round for 5 minutes", names) == "plants"
    assert called_by("做三分钟的浇花巡视", names) == "plants"
    scene = SkillScene(names, Language.ZH, battery=0.9)

    def steps(name: str, *given: str, scene: SkillScene = scene) -> list[str]:
        call = StepPlan(steps=(UseSkill(name=name, arguments=given),))
        made = asyncio.run(unfold(call, scene)).plan
        assert isinstance(made, StepPlan)
        return [step.kind for step in made.steps]

    assert steps("evening_round", "") == ["patrol", "try", "go_to", "say"]
    assert steps("plants", "300") == ["ask", "patrol"]
    assert steps("plants", "60") == ["go_to", "say"]
    assert steps("plants", "60", scene=SkillScene(names, Language.EN, battery=0.1)) == ["say"]


def test_a_fact_is_no_skill() -> None:
    assert isinstance(intent_of("remember that my car is red"), TeachFact)


def test_the_page_shows_the_examples_as_they_are() -> None:
    page = Path("docs/skills.md").read_text("utf-8")
    function = Path("examples/skills/plants.py").read_text("utf-8").partition("\n\n")[2]
    assert function.strip() in page
    for words in ("pons skill new", "pons skill check", "pons skill try", "256 MB", "32"):
        assert words in page


def test_the_program_of_the_page_uses_calls_that_are_there() -> None:
    page = Path("docs/python.md").read_text("utf-8")
    program = page.partition("```python\n")[2].partition("```")[0]
    assert len(program.splitlines()) <= 20
    compile(program, "docs/python.md", "exec")
    for call in re.findall(r"robot\.(\w+)\(", program):
        assert hasattr(Robot, call)
