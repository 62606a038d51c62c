"""Keep the steps of an order as a routine: "remember that as the evening round"."""

from __future__ import annotations

import asyncio
import hashlib
import json
import os
import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner.language.folding import has_chinese
from planner.skill_files.folder import judge_skill
from planner.skill_files.problems import SkillProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.plan import Skill, Step
    from planner.skill_files.folder import SkillFolder

_NO_NAME = re.compile(r"[^a-z0-9]+")


class SkillKeeper:
    """Write routines into the folder of skills."""

    def __init__(self, folder: SkillFolder) -> None:
        """Take the folder, which reads what was written."""
        self._folder = folder

    async def keep(self, name: str, steps: Sequence[Step]) -> Skill:
        """Keep steps under a name that people say; they call it from now on.

        Raises:
            SkillProblem: nothing was written, and why.
        """
        text = write_routine(name, steps)
        skill = await asyncio.to_thread(self._write, name, text)
        await self._folder.look()
        return skill

    def _write(self, name: str, text: str) -> Skill:
        """Judge the file beside the others, then put it in its place, where none is."""
        file = f"{_file_name(name)}.toml"
        target = self._folder.folder / file
        if target.exists() or target.with_suffix(".py").exists():
            raise SkillProblem("skill_exists", file, name=name, file_name=file)
        try:
            target.parent.mkdir(mode=0o700, exist_ok=True)
            with tempfile.TemporaryDirectory(dir=target.parent, prefix=".") as beside:
                made = Path(beside) / file
                made.write_text(text, "utf-8")
                names = self._folder.names()
                bare = names.model_copy(update={"skills": (), "skill_templates": ""})
                skill = judge_skill(made, bare, self._folder.read.skills)
                os.link(made, target)
        except OSError as wrong:
            raise SkillProblem("skill_unwritable", file, what=wrong.strerror) from None
        return skill


def _file_name(name: str) -> str:
    slug = _NO_NAME.sub("_", name.casefold()).strip("_")[:40]
    if name.isascii() and slug[:1].isalpha():
        return slug
    return f"skill_{hashlib.sha256(name.encode()).hexdigest()[:8]}"


def write_routine(name: str, steps: Sequence[Step]) -> str:
    """Return the text of a routine that is called by a name, and by "do" before it."""
    called = "".join(each for each in name if each not in "()[]{}<>|@")
    words = f"[做|执行]{called}" if has_chinese(called) else f"[do|make] [the] {called}"
    tongue = "zh" if has_chinese(called) else "en"
    rows = [_inline(step.model_dump(mode="json", exclude_none=True)) for step in steps]
    listed = "".join(f"  {row},\n" for row in rows)
    return f"{tongue} = [{json.dumps(words, ensure_ascii=False)}]\nsteps = [\n{listed}]\n"


def _inline(value: Any) -> str:
    """Return a value as TOML writes it within a line."""
    if isinstance(value, dict):
        return f"{{{', '.join(f'{name} = {_inline(each)}' for name, each in value.items())}}}"
    if isinstance(value, list):
        return f"[{', '.join(map(_inline, value))}]"
    return json.dumps(value, ensure_ascii=False)
