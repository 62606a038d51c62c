"""Own the record of a skill: a routine or function of the owner's, with the words that call it.

Data only. A plan calls one by ``use_skill``; before anything is judged or moves, the call is
replaced by the steps that it stands for (``planner.skill_files.calls``).
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Self

from pydantic import Field, StringConstraints, model_validator

from planner.plan.base import Frozen

SkillName = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]{0,39}$")]
Sentence = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200)]
MOST_PARAMETERS = 6


class ParameterKind(StrEnum):
    """Say what words a parameter takes."""

    PLACE = "place"
    THING = "thing"
    PERSON = "person"
    WORDS = "words"
    NUMBER = "number"
    DURATION = "duration"
    """A time to stand or wait, kept in seconds."""


class Parameter(Frozen):
    """Name one parameter; ``default`` where it may be left out."""

    name: SkillName
    kind: ParameterKind
    default: Annotated[str, StringConstraints(max_length=200)] | None = None


class Skill(Frozen):
    """Hold one skill. ``steps`` is a routine's JSON with its blanks; ``source`` a function's."""

    name: SkillName
    file: str
    about: Annotated[str, StringConstraints(max_length=200)] = ""
    en: Annotated[tuple[Sentence, ...], Field(max_length=12)] = ()
    zh: Annotated[tuple[Sentence, ...], Field(max_length=12)] = ()
    parameters: Annotated[tuple[Parameter, ...], Field(max_length=MOST_PARAMETERS)] = ()
    steps: str = ""
    source: str = ""
    function: str = ""
    takes_world: int | None = None
    """Where among a function's parameters it is told where things stand; None: nowhere."""

    @model_validator(mode="after")
    def _each_once(self) -> Self:
        names = [each.name for each in self.parameters]
        if len(set(names)) != len(names):
            raise ValueError(f"parameters must be unique: {', '.join(names)}")
        return self

    @property
    def is_function(self) -> bool:
        """Return whether a program of the owner's works its steps out."""
        return bool(self.function)
