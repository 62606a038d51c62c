"""Give a skill of your own its words: types for what it takes, and the steps that it may return.

A file ``$PONS_HOME/skills/NAME.py`` with ``from pons.skill import Place, go_to, say`` is a skill;
docs/skills.md shows one whole. Standard library alone: the process that runs skills loads this.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

Place = str
"""The id of a room or place."""
Thing = str
Person = str
Words = str
Duration = float
"""Seconds."""
Step = dict[str, Any]
"""One step of the closed vocabulary, as the plan holds it."""


@dataclass(frozen=True)
class SkillWorld:
    """Tell a skill where things stand, as far as the robot knows."""

    places: dict[str, dict[str, str | None]]
    """By their id: ``en`` and ``zh`` names, ``kind`` (room or place) and ``room``."""
    room: str | None
    """The id of the room that the robot is in."""
    battery: float | None
    """0 to 1."""
    now: str
    """People's own time, ISO 8601."""
    language: str
    """``en`` or ``zh``: of the sentence that called the skill."""

    def rooms(self) -> list[str]:
        """Return the ids of all rooms."""
        return [id_ for id_, place in self.places.items() if place["kind"] == "room"]

    def name(self, place: str) -> str:
        """Return how people call a place, in the language of the sentence."""
        return str(self.places[place][self.language])


World = SkillWorld


def go_to(place: Place) -> Step:
    """Drive to a room or place."""
    return {"kind": "go_to", "place": place}


def go_home() -> Step:
    """Drive home."""
    return {"kind": "return_home"}


def patrol(places: list[Place], *, look: bool = False) -> Step:
    """Drive to places in turn; ``look``: look round at each."""
    return {"kind": "patrol", "places": places, "look": look}


def say(text: str) -> Step:
    """Say words aloud."""
    return {"kind": "say", "text": text}


def ask(question: str) -> Step:
    """Ask the person; only a yes leads on."""
    return {"kind": "ask", "question": question}


def wait(seconds: Duration) -> Step:
    """Stand still [s]."""
    return {"kind": "wait", "seconds": seconds}


def find(thing: Thing, place: Place | None = None) -> Step:
    """Search for a thing, everywhere or in one place."""
    return {"kind": "find", "object": thing, "place": place}


def look(question: str, place: Place | None = None) -> Step:
    """Look, and answer a question by it."""
    return {"kind": "look", "question": question, "place": place}
