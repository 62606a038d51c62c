"""Serve the owner's skills: how each is called, and what is wrong in the files that are none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from fastapi import APIRouter
from pydantic import BaseModel

from planner.plan import Bilingual, Parameter

if TYPE_CHECKING:
    from planner.api.interfaces import Services


class SkillView(BaseModel):
    """Show one skill."""

    name: str
    file: str
    kind: Literal["routine", "function"]
    about: str
    en: tuple[str, ...]
    """The sentences that call it, in the slot language of templates."""
    zh: tuple[str, ...]
    parameters: tuple[Parameter, ...]


class SkillProblemView(BaseModel):
    """Show a file that is no skill: its line, its stable code, and the cure."""

    file: str
    line: int
    code: str
    message: Bilingual


class SkillList(BaseModel):
    """Show all files in the folder of skills."""

    folder: str
    skills: tuple[SkillView, ...]
    problems: tuple[SkillProblemView, ...]


def routes(services: Services) -> APIRouter:
    """Return the route of the owner's skills."""
    router = APIRouter(prefix="/v1/skills", tags=["skills"])

    @router.get("", operation_id="list_skills")
    async def several() -> SkillList:
        """List the skills as their files are now, and what is wrong in the others."""
        folder, read = services.skills.folder, services.skills.read
        return SkillList(
            folder=str(folder),
            skills=tuple(
                SkillView(
                    name=each.name, file=each.file, about=each.about, en=each.en, zh=each.zh,
                    kind="function" if each.is_function else "routine",
                    parameters=each.parameters,
                )
                for each in read.skills
            ),
            problems=tuple(
                SkillProblemView(file=p.file, line=p.line, code=p.code, message=p.said)
                for p in read.problems
            ),
        )  # fmt: skip

    return router
