"""Know the skills in ``$PONS_HOME/skills``: read them, and again whenever a file changes.

Looked at twice a second, outside every loop that drives; what is wrong in a file is kept beside its
line and cure, and the skill of before is gone with it: a skill is what its file says now.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.templates.owners import read_skill_templates
from planner.language.templates.skills import with_skills
from planner.loops import keep_going
from planner.plan import Entry, Skill, Vocabulary
from planner.skill_files.problems import SkillProblem
from planner.skill_files.skill_file import KINDS, check_routine, read_skill
from planner.skill_files.words import check_words

if TYPE_CHECKING:
    from collections.abc import Callable

log = logging.getLogger(__name__)
FOLDER = "skills"
MOST_SKILLS = 32
LOOK_S = 0.5
_Stamps = tuple[tuple[Entry, ...], tuple[tuple[str, int, int, int], ...]]


@dataclass(frozen=True, slots=True)
class SkillsRead:
    """Hold what a folder's files are: skills, and what is wrong with the others."""

    skills: tuple[Skill, ...] = ()
    problems: tuple[SkillProblem, ...] = ()


def read_folder(folder: Path, names: Vocabulary) -> SkillsRead:
    """Return the skills of a folder beside the site's own names, in the order of their files."""
    bare = names.model_copy(update={"skills": (), "skill_templates": ""})
    skills: list[Skill] = []
    problems: list[SkillProblem] = []
    for path in _files(folder):
        try:
            skills.append(judge_skill(path, bare, tuple(skills)))
        except SkillProblem as wrong:
            problems.append(wrong)
    named = with_skills(bare, tuple(skills))
    read_skill_templates(named.skill_templates)  # built here, beside the loop that reads by them
    return SkillsRead(tuple(skills), tuple(problems))


def judge_skill(path: Path, names: Vocabulary, others: tuple[Skill, ...]) -> Skill:
    """Return the skill of a file, judged beside a site's names and the skills before it.

    Raises:
        SkillProblem: something is wrong with it.
    """
    if any(each.name == path.stem for each in others):
        raise SkillProblem("skill_twice", path.name, name=path.stem)
    if len(others) >= MOST_SKILLS:
        raise SkillProblem("skill_many", path.name, most=MOST_SKILLS)
    skill = read_skill(path)
    text = path.read_text("utf-8", "replace")
    check_words(skill, names, with_skills(names, others), text)
    if not skill.is_function:
        check_routine(skill, names, text)
    return skill


def _files(folder: Path) -> list[Path]:
    """Return a folder's skill files; none where it is not there, or leads elsewhere."""
    if folder.is_symlink() or not folder.is_dir():
        return []
    return sorted(path for path in folder.iterdir() if path.suffix in KINDS)


class SkillFolder:
    """Keep the skills of a folder as its files are now."""

    def __init__(
        self,
        home: Path,
        names: Callable[[], Vocabulary],
        told: Callable[[SkillsRead], None] = lambda _: None,
    ) -> None:
        """Take the folder's home, the site's names now, and a listener for each change."""
        self.folder, self.names, self._told = home / FOLDER, names, told
        self.read = SkillsRead()
        self._stamps: _Stamps | None = None
        self._looking: asyncio.Task[None] | None = None
        self._turn = asyncio.Lock()

    async def start(self) -> None:
        """Read the skills beside what else begins, and look for changes from now on."""
        work = keep_going("look at skills", self._look_again)
        self._looking = asyncio.create_task(work, name="look at skills")

    async def close(self) -> None:
        """Look no more."""
        if self._looking is not None:
            self._looking.cancel()
            await asyncio.gather(self._looking, return_exceptions=True)

    async def _look_again(self) -> None:
        while True:
            try:
                await self.look()
            except OSError as wrong:
                log.warning("the folder of skills can't be read: %s", wrong)
            await asyncio.sleep(LOOK_S)

    async def look(self) -> SkillsRead:
        """Read the skills where a file or a name of the site has changed; return those of now."""
        async with self._turn:
            names = self.names()
            stamps = (names.entries, await asyncio.to_thread(self._stamp))
            if stamps == self._stamps:
                return self.read
            read = await asyncio.to_thread(read_folder, self.folder, names)
            self._stamps, self.read = stamps, read
            for each in read.problems:
                log.warning("%s", each)
            self._told(read)
            return read

    def _stamp(self) -> tuple[tuple[str, int, int, int], ...]:
        found: list[tuple[str, int, int, int]] = []
        for path in _files(self.folder):
            with contextlib.suppress(OSError):
                stat = path.lstat()
                found.append((path.name, stat.st_mtime_ns, stat.st_size, stat.st_ino))
        return tuple(found)
