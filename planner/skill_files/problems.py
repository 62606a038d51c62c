"""Name what is wrong with a skill: a stable code, its file and line, the cure in both languages.

The sentences stand in the catalogue under ``skill.<code>``.
"""

from __future__ import annotations

from planner.language.catalogue import message, say
from planner.plan import Bilingual, Code, Outcome


class SkillProblem(Exception):
    """Tell why a skill can't be read or did not run."""

    def __init__(self, code: str, file: str, line: int = 1, /, **facts: object) -> None:
        super().__init__(f"{code}: {file}:{line}")
        self.code, self.file, self.line = code, file, line
        self.said: Bilingual = say(f"skill.{code}", **{k: str(v)[:300] for k, v in facts.items()})

    def outcome(self, name: str) -> Outcome:
        """Return how a goal ends that called the skill."""
        at = f"{self.file}:{self.line}"
        said = message(Code.SKILL_FAILED, name=name.replace("_", " "), at=at, why=self.said)
        return Outcome(code=Code.SKILL_FAILED, message=said)
