"""Own the closed world of names: the rooms and places that a plan may mention, and nothing else.

Knows no coordinates: where a place lies is the world's business. A site builds one of these.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any, Literal, Self

from pydantic import StringConstraints, model_validator

from planner.plan.base import Bilingual, Frozen
from planner.plan.skill import Skill
from planner.plan.tool import Tool

PlaceId = Annotated[str, StringConstraints(pattern=r"^[a-z0-9][a-z0-9_]{0,63}$")]
Alias = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80)]


class Entry(Frozen):
    """Name one room or place: its id, its name in both languages and its other names."""

    id: PlaceId
    kind: Literal["room", "place"]
    name: Bilingual
    aliases: tuple[Alias, ...] = ()
    room: PlaceId | None = None  # the room a place stands in, where the site says so
    is_home: bool = False  # where "go home" leads

    @property
    def spellings(self) -> tuple[str, ...]:
        """Return every way to write this entry: both names, the aliases and the id in words."""
        written = (self.name.en, self.name.zh, *self.aliases, self.id.replace("_", " "))
        return tuple(dict.fromkeys(word for word in written if word.strip()))


class Vocabulary(Frozen):
    """List the site's names. An id occurs once; a spelling may be shared, and is then ambiguous.

    With them stand the sentences of the site's owner.
    """

    entries: tuple[Entry, ...] = ()
    sentences: str = ""
    """Templates of sentences by the site's owner, as their file holds them; checked when loaded."""
    skills: tuple[Skill, ...] = ()
    """What the owner has added in files of their own."""
    skill_templates: str = ""
    """The sentences that call them, as such a file holds them."""
    tools: tuple[Tool, ...] = ()
    """What servers of the owner's can be asked: a model alone is told of them."""

    @model_validator(mode="after")
    def _ids_once(self) -> Self:
        twice = [id_ for id_, n in Counter(entry.id for entry in self.entries).items() if n > 1]
        if twice:
            raise ValueError(f"place ids must be unique; given twice: {', '.join(sorted(twice))}")
        return self

    @cached_property
    def by_id(self) -> dict[str, Entry]:
        """Return the entries by their id."""
        return {entry.id: entry for entry in self.entries}

    @cached_property
    def text(self) -> str:
        """Return all that it holds as one text."""
        return self.model_dump_json()

    def model_copy(
        self, *, update: Mapping[str, Any] | None = None, deep: bool = False
    ) -> Vocabulary:
        """Return a copy that keeps nothing of what was worked out from the fields of this one."""
        made = super().model_copy(update=update, deep=deep)
        for worked_out in made.__dict__.keys() - type(made).model_fields.keys():
            del made.__dict__[worked_out]
        return made

    def __eq__(self, other: object) -> bool:
        """Compare as one text: what is kept by one vocabulary is looked up by another equal one."""
        return self is other or (isinstance(other, Vocabulary) and self.text == other.text)

    def __hash__(self) -> int:
        """Hash the ids alone: sentences are looked up by their vocabulary hundreds of times."""
        return hash(tuple(self.by_id))

    def skill(self, name: str) -> Skill | None:
        """Return the skill of a name; None: there is none."""
        return next((each for each in self.skills if each.name == name), None)

    @property
    def calls(self) -> frozenset[str]:
        """Return the kinds of steps that call a skill; none where there are no skills."""
        return frozenset({"use_skill"}) if self.skills else frozenset()

    def tool(self, name: str) -> Tool | None:
        """Return the tool of a name; None: there is none."""
        return next((each for each in self.tools if each.name == name), None)

    def __contains__(self, place: object) -> bool:
        return place in self.by_id

    def name(self, place: str) -> Bilingual:
        """Return a place's name; an id that is no longer known is its own name."""
        entry = self.by_id.get(place)
        return entry.name if entry else Bilingual(en=place, zh=place)
