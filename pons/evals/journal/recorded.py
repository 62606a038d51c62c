"""Read a journal's decisions about each sentence. The journal itself is never touched.

A copy is read, so that a running planner is not held and a file on a stick needs no right to write.
What a black box holds is motion, no words: its sentences are in the journal of the same home.
"""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from pydantic import ValidationError

from planner.brain.interface import Exchange
from planner.language.stop import is_stop
from planner.mission.conversation import exchanges_of
from planner.mission.journal_records import read_mission
from planner.mission.state import Mission
from planner.plan import Language, PlanRecord

NAME = "missions.db"
MAX_ROWS = 200_000
_MAGIC = b"SQLite format 3\x00"


class NoJournal(Exception):
    """The file holds no sentences; the message begins with a stable code."""


@dataclass(frozen=True, slots=True)
class RecordedDecision:
    """Hold one sentence and the plan that the brain of then made of it."""

    goal: str
    text: str
    language: Language
    brain: str
    plan: PlanRecord
    start: tuple[float, float, float] | None
    """Where the robot stood: x [m], y [m], yaw [rad] in ``map``."""
    map_id: str
    order: str = ""
    exchanges: tuple[Exchange, ...] = ()
    """Where the sentence answers a brain's question: what was ordered, asked and answered."""


@dataclass(frozen=True, slots=True)
class RecordedDecisions:
    """Hold a journal's decisions."""

    decisions: tuple[RecordedDecision, ...]
    """Newest first."""
    without: int
    """Goals that no brain planned: stops, words to the planner itself, models that failed."""
    unreadable: int


def read(path: Path) -> RecordedDecisions:
    """Return the decisions of a journal, or of the one in a home folder.

    Raises:
        NoJournal: ``journal_missing``, ``no_sentences``.
    """
    path = path / NAME if path.is_dir() else path
    if not path.is_file():
        raise NoJournal(f"journal_missing: there is no {path}")
    with path.open("rb") as file:
        if file.read(len(_MAGIC)) != _MAGIC:
            raise NoJournal(
                f"no_sentences: {path} is no journal; a black box holds motion and no words, "
                f"give the {NAME} of the same home"
            )
    with TemporaryDirectory(prefix="pons-replay-") as folder:
        copy = Path(folder) / NAME
        for end in ("", "-wal"):  # what was written last may still be in the log beside it
            part = path.with_name(path.name + end)
            if part.is_file():
                shutil.copyfile(part, copy.with_name(copy.name + end))
        try:
            return _first_plans(_records(copy))
        except sqlite3.Error as error:
            raise NoJournal(f"no_sentences: {path}: {error}") from None


def _records(path: Path) -> list[str]:
    with closing(sqlite3.connect(path)) as base:
        rows = base.execute(
            "SELECT record FROM transitions ORDER BY seq DESC LIMIT ?", (MAX_ROWS,)
        ).fetchall()
    return [str(row[0]) for row in reversed(rows)]


def _first_plans(records: list[str]) -> RecordedDecisions:
    """Take each sentence's first plan; one made again after a failed step saw more."""
    first: dict[tuple[str, int], RecordedDecision] = {}
    goals: set[str] = set()
    unreadable = 0
    for record in records:
        try:
            mission = read_mission(record)
        except ValidationError:
            unreadable += 1
            continue
        goals.add(mission.id)
        decision = _decision(mission)
        if decision is not None and not (mission.replans or mission.decides):
            first.setdefault((mission.id, len(mission.replies)), decision)
    without = len(goals - {goal for goal, _ in first})
    return RecordedDecisions(tuple(reversed(first.values())), without, unreadable)


def _decision(mission: Mission) -> RecordedDecision | None:
    if mission.plan is None or mission.brain is None or is_stop(mission.text):
        return None
    text = mission.replies[-1] if mission.replies else mission.text
    return RecordedDecision(
        goal=mission.id,
        text=text,
        language=mission.language,
        brain=mission.brain.name,
        plan=mission.plan,
        start=mission.accepted_at,
        map_id=mission.map_id,
        order=mission.text,
        exchanges=exchanges_of(mission),
    )
