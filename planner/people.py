"""Keep who may use this robot: a name and a role each, and the print of their token.

The owner, who started the planner, adds and removes people. A token is told once, when it is made;
its SHA-256 alone is kept, which is enough for 32 random bytes. What somebody asks for is written
down under the person's id, so that a stop is told as theirs.
"""

from __future__ import annotations

import hashlib
import re
import secrets
import unicodedata
from contextvars import ContextVar
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.state_database import StateDatabase

MOST_PEOPLE = 64
TOKEN_BYTES = 24
"""In hexadecimal: one that begins with a hyphen is an option on a command line."""
MOST_ID_CHARACTERS = 32
OWN_IDS = frozenset({"api", "cli", "page", "planner", "bridge", "owner", "mqtt"})
"""What the robot's own doors are written down as; a person of that id would be taken for one."""


class Role(StrEnum):
    """Name how far a token's bearer may go; ``planner.api.access`` has the table of routes."""

    VIEWER = "viewer"
    OPERATOR = "operator"
    DISPATCHER = "dispatcher"
    """A person who gives the robot work, and neither powers nor steers it nor sets it up."""
    AGENT = "agent"
    """A program, such as an assistant: it gives goals and acts on its own alone."""


class PeopleError(Exception):
    """A person can't be added or removed; ``code`` is stable."""

    def __init__(self, code: str, detail: str) -> None:
        """Keep the code beside the words."""
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


@dataclass(frozen=True, slots=True)
class Person:
    """Hold one person, or one of a person's devices."""

    id: str
    """Latin letters, digits and hyphens, made from the name: what a record says."""
    name: str
    role: Role
    since: str
    """When the token was made, in UTC as ISO 8601."""


ASKER: ContextVar[Person | None] = ContextVar("asker", default=None)
"""The person whose token came with the request that is served now; None for the owner's."""


def name_asker(said: str) -> str:
    """Return whose request is served now, for the record: the person's id, else as it says."""
    person = ASKER.get()
    return said if person is None else person.id


class People:
    """Be the people of one home. ``find`` reads memory; the rest blocks on the disk."""

    def __init__(
        self, database: StateDatabase, clock: Callable[[], datetime] = lambda: datetime.now(UTC)
    ) -> None:
        """Read who is known; where the database can't be read, nobody is."""
        self._database, self._clock = database, clock
        self._by_print: dict[str, Person] = {}
        self.load()

    def load(self) -> None:
        """Read the table again."""
        try:
            rows = self._database.read("SELECT print, id, name, role, since FROM people")
        except OSError:
            rows = []
        self._by_print = {
            print_: Person(id_, name, Role(role), since) for print_, id_, name, role, since in rows
        }

    def find(self, token: str) -> Person | None:
        """Return the person of a token. A print tells nothing of a token, so no look-up does."""
        return self._by_print.get(_print_of(token)) if token else None

    def list_all(self) -> list[Person]:
        """Return everybody, the oldest first."""
        return sorted(self._by_print.values(), key=lambda person: (person.since, person.id))

    def add(self, name: str, role: Role) -> tuple[Person, str]:
        """Keep a person and return the token, which is told this once.

        Raises:
            PeopleError: ``person_exists``, ``people_full`` or ``person_unnamed``.
            OSError: the database can't be written.
        """
        name = " ".join(name.split())
        if not any(character.isalnum() for character in name):
            raise PeopleError("person_unnamed", f"{name!r} has no letter and no digit")
        taken = {person.id for person in self._by_print.values()}
        if name.casefold() in {person.name.casefold() for person in self._by_print.values()}:
            raise PeopleError("person_exists", f"{name!r} is known; remove that one first")
        if not len(taken) < MOST_PEOPLE:
            raise PeopleError("people_full", f"{MOST_PEOPLE} people are known; remove one first")
        token = secrets.token_hex(TOKEN_BYTES)
        person = Person(
            _id_of(name, taken | OWN_IDS), name, role, self._clock().isoformat("T", "seconds")
        )
        with self._database.change() as connection:
            connection.execute(
                "INSERT INTO people (print, id, name, role, since) VALUES (?, ?, ?, ?, ?)",
                (_print_of(token), person.id, person.name, person.role.value, person.since),
            )
        self.load()
        return person, token

    def remove(self, person_id: str) -> Person:
        """Forget a person; the token opens nothing from then on.

        Raises:
            PeopleError: ``unknown_person``.
            OSError: the database can't be written.
        """
        person = next((each for each in self.list_all() if each.id == person_id), None)
        if person is None:
            known = ", ".join(each.id for each in self.list_all()) or "nobody"
            raise PeopleError("unknown_person", f"nobody is {person_id!r}; known: {known}")
        with self._database.change() as connection:
            connection.execute("DELETE FROM people WHERE id = ?", (person_id,))
        self.load()
        return person


def _print_of(token: str) -> str:
    return hashlib.sha256(token.encode()).hexdigest()


def _id_of(name: str, taken: set[str] | frozenset[str]) -> str:
    """Return a name for records: its Latin letters and digits, and a number where that is taken."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
    stem = re.sub(r"[^a-z0-9]+", "-", plain.replace("'", "")).strip("-")[:MOST_ID_CHARACTERS]
    stem = stem.strip("-") or "person"
    return next(
        each
        for each in (stem, *(f"{stem}-{number}" for number in range(2, MOST_PEOPLE * 2)))
        if each not in taken
    )
