"""Define what is remembered, what is asked of it, and its bounds. Data only.

``*_unix_s`` are seconds of the wall clock: a memory outlives the process and its host. Points are
metres in ``map`` of the map they were seen on.
"""

from __future__ import annotations

from dataclasses import dataclass

THING, PERSON, FACT = "thing", "person", "fact"
KINDS = (THING, PERSON, FACT)
DAY_S = 86_400.0


@dataclass(frozen=True, slots=True)
class ObjectSighting:
    """Report one thing, or a person without a name or face, as it was seen just now."""

    label: str
    color: str | None
    map_id: str
    room: str | None
    x_m: float
    y_m: float
    confidence: float
    """0 to 1: how sure it is that it is there at all."""
    seen_unix_s: float
    first_unix_s: float
    thing_id: str = ""
    """Its id among the objects that are tracked now; empty where it is not tracked any more."""
    support: str | None = None
    """The class of what it stands on, where that is known."""
    step: str = ""
    """The kind of the step that was under way; empty where none was."""

    @property
    def kind(self) -> str:
        """Return which kind of memory it makes."""
        return PERSON if self.label == PERSON else THING


@dataclass(frozen=True, slots=True)
class Memo:
    """Hold one thing remembered: seen between two times, or told at one."""

    id: int
    kind: str
    first_unix_s: float
    last_unix_s: float
    words: str = ""
    """Of a fact, as it was said."""
    label: str = ""
    color: str | None = None
    map_id: str = ""
    room: str | None = None
    """A room or place of the site: where it was seen, or that a fact names."""
    support: str | None = None
    x_m: float | None = None
    y_m: float | None = None
    confidence: float = 1.0
    sightings: int = 1
    step: str = ""
    said_by: str = ""
    """Through which door a fact came: ``sentence``, ``page``, ``api``."""
    thing_id: str = ""
    fits: bool = False
    """The words that were asked for name it; else it is merely new."""


@dataclass(frozen=True, slots=True)
class KeptPicture:
    """Hold what is known of one picture that a patrol took; its bytes are apart."""

    goal: str
    step: int
    """Of the goal's plan, in the row of all its steps."""
    stop: int
    """Of the patrol, in its order."""
    place: str
    labels: tuple[str, ...]
    """Kinds of the things that the detector found in it, one for each."""
    media_type: str
    taken_unix_s: float = 0.0
    id: int = 0
    size: int = 0
    """Bytes."""


@dataclass(frozen=True, slots=True)
class MemoryQuery:
    """Ask for what is remembered. Empty: the newest of everything."""

    words: str = ""
    """A thing, a person or what a fact speaks of, in a person's words."""
    place: str | None = None
    """A room or place of the site."""
    since_unix_s: float | None = None
    until_unix_s: float | None = None
    kinds: tuple[str, ...] = KINDS
    limit: int = 20


@dataclass(frozen=True, slots=True)
class MemoryLimits:
    """Bound what is kept. From the owner's settings; nothing is kept of a kind with 0 days."""

    things_days: float = 30.0
    people_days: float = 7.0
    facts_days: float = 365.0
    most_sightings: int = 10_000
    most_facts: int = 500
    most_pictures: int = 60
    pictures_mb: float = 12.0

    @property
    def most_picture_bytes(self) -> int:
        """Return what all pictures together may have."""
        return int(self.pictures_mb * 1e6)

    def age_s(self, kind: str) -> float:
        """Return how old a memory of a kind may become [s]."""
        days = {THING: self.things_days, PERSON: self.people_days, FACT: self.facts_days}
        return days[kind] * DAY_S
