"""Every skill that is wrong is told with its code, its line and its cure, and nothing moves."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

from planner.language.templates.skills import with_skills
from planner.plan import Language, StepPlan, UseSkill, Vocabulary
from planner.site import Site
from planner.site.site_view import vocabulary_of
from planner.skill_files import sandbox
from planner.skill_files.calls import SkillFailure, SkillScene, unfold
from planner.skill_files.folder import read_folder
from planner.skill_files.problems import SkillProblem
from planner.skill_files.skill_file import read_skill
from tests.planner.skill_files.broken import FILES, ROUTINE, RUNS, function

pytestmark = pytest.mark.nightly(keep=25)


NAMES = vocabulary_of(Site.load(Path("sites/home")))


def _tell(problem: SkillProblem) -> None:
    assert problem.said.en.endswith((".", "]"))
    assert problem.said.zh
    assert problem.said.en != problem.said.zh


@pytest.mark.parametrize("what", FILES)
def test_a_broken_file_is_refused_with_its_line(tmp_path: Path, what: str) -> None:
    name, text, code, line = FILES[what]
    (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    (tmp_path / "z.toml").write_text(ROUTINE.replace("evening", "other"), "utf-8")
    read = read_folder(tmp_path, NAMES)
    assert [each.name for each in read.skills] == ["z"]  # the others stay as they were
    [problem] = read.problems
    assert (problem.code, problem.line, problem.file) == (code, line, name)
    _tell(problem)


@pytest.mark.parametrize("what", RUNS)
def test_a_broken_function_does_nothing_and_is_told_with_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    body, code, line = RUNS[what]
    home = tmp_path / "home"
    home.mkdir()
    (home / "missions.db").write_bytes(b"journal")
    path = tmp_path / "plants.py"
    path.write_text(function(body.replace("{home}", str(home))), "utf-8")
    names = with_skills(NAMES, (read_skill(path),))
    plan = StepPlan(steps=(UseSkill(name="plants"),))
    if what == "a sleep":  # what is busy ends by the processor's seconds
        monkeypatch.setattr(sandbox, "WALL_S", 1.0)
    with pytest.raises(SkillFailure) as failed:
        asyncio.run(unfold(plan, SkillScene(names, Language.EN)))
    problem = failed.value.problem
    assert (problem.code, problem.line) == (code, line), problem.said.en
    _tell(problem)
    assert "plants.py" in failed.value.outcome.message.zh
    assert (home / "missions.db").read_bytes() == b"journal"


def test_a_link_a_folder_and_a_pipe_are_no_skills(tmp_path: Path) -> None:
    outside = tmp_path / "outside.toml"
    outside.write_text(ROUTINE, "utf-8")
    folder = tmp_path / "skills"
    folder.mkdir()
    (folder / "linked.toml").symlink_to(outside)
    (folder / "folder.toml").mkdir()
    os.mkfifo(folder / "pipe.toml")
    read = read_folder(folder, NAMES)
    assert {each.code for each in read.problems} == {"skill_link"}
    assert len(read.problems) == 3
    assert not read.skills
    linked = tmp_path / "linked"
    linked.symlink_to(folder)
    assert not read_folder(linked, NAMES).problems  # a folder that leads elsewhere holds none


def test_of_two_skills_with_one_name_or_one_sentence_the_second_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text(function("return 'x'"), "utf-8")
    (tmp_path / "a.toml").write_text(ROUTINE, "utf-8")
    (tmp_path / "b.toml").write_text(ROUTINE.replace("do the evening round", "water the plants"))
    read = read_folder(tmp_path, NAMES)
    assert [each.file for each in read.skills] == ["a.py"]
    assert [each.code for each in read.problems] == ["skill_twice", "skill_words_shared"]


def test_more_skills_than_a_folder_holds_are_refused(tmp_path: Path) -> None:
    for number in range(34):
        word = "".join(chr(ord("a") + int(digit)) for digit in f"{number:02}")
        text = ROUTINE.replace("do the evening round", f"whirl {word}x")
        (tmp_path / f"s{number:02}.toml").write_text(text, "utf-8")
    read = read_folder(tmp_path, Vocabulary(entries=NAMES.entries[:3]))
    assert len(read.skills) == 32
    assert {each.code for each in read.problems} == {"skill_many"}
