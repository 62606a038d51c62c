"""Define the dialogue of a trial between a person's page and what turns the wheels.

``trial/state`` is a level: each one says all of the trial, so that a page that comes late or missed
some knows as much. ``trial/order`` is one too: a page that watches repeats how far it has answered,
and its silence means that nobody watches. Spoken at the bridge's door while no bridge drives.
"""

from __future__ import annotations

import hashlib
from typing import Annotated, Final, Literal

from pydantic import Field

from wire.base import Record
from wire.bounded_types import Code, Count, Name, Text
from wire.commands import Proof

EXIT_SET_UP: Final = 4
"""A planner ends with it where an operator asked for set-up, and set-up where one asked to drive:
``pons up`` then starts the other."""
EXIT_MAP: Final = 5
"""A planner ends with it where its owner asked to map this home, or to drive on the map that was
saved: ``pons up`` then starts everything for the one or the other."""
UNWATCHED_S: Final = 1.5
"""A page that says nothing for so long is gone; pages speak three times a second."""

TrialPhase = Literal["idle", "finding", "trying", "proved", "refused"]
TrialAct = Literal["watch", "begin", "find", "leave"]


class Sentence(Record):
    """Say one thing in both languages."""

    en: Text
    zh: Text


def mark_of(order_id: str) -> str:
    """Return the sign by which the page that made an order's id knows it again.

    The id itself is shown to nobody: it is what a watch must name, so that only the page which
    began a trial keeps its wheels turning.
    """
    return hashlib.sha256(order_id.encode()).hexdigest()[:32]


class TrialOrder(Record):
    """Ask set-up for something, or show that the page which began a trial still watches."""

    id: Name
    """Of this request; of a watch: that of the begin which it belongs to."""
    source: Name
    act: TrialAct
    answered: Count = 0
    """Of a watch: the number of the newest question whose answer is "done"."""
    proof: Proof | None = None
    """Of a begin: nothing turns without it."""


class TrialStep(Record):
    """Show one step and what was seen in it."""

    step: Code
    seen: Text


class PortReport(Record):
    """Show one serial port and what answers there."""

    path: Text
    adapter: Text
    code: Code
    device: Text
    """Part, kind, speed and its own words; empty where nothing answered."""
    cure: Sentence | None


class TrialState(Record):
    """Say all of set-up: the robot, the trial under way or ended, and what is plugged in."""

    boot: Name
    seq: Count
    robot: Name
    drive: Name
    port: Text
    tried: Text | None
    """The date of a trial of the present wiring; null where there is none."""
    phase: TrialPhase
    by: Name | None
    """The mark of the id of the present or newest begin (:func:`mark_of`)."""
    plan: Annotated[tuple[Code, ...], Field(max_length=16)]
    """All steps, in order."""
    steps: Annotated[tuple[TrialStep, ...], Field(max_length=16)]
    """Those begun; the newest runs, or is where it ended."""
    ask: Count
    """The question that waits for a person; 0 where none does."""
    question: Sentence | None
    code: Code | None
    """Why it was refused."""
    detail: Text
    cure: Sentence | None
    wrote: Annotated[tuple[Text, ...], Field(max_length=16)]
    """Lines of robot.toml that the trial wrote."""
    ports: Annotated[tuple[PortReport, ...], Field(max_length=32)] | None
    """Null: not looked yet."""
    part: Annotated[tuple[Text, ...], Field(max_length=64)]
    """What robot.toml should say of the ports."""
