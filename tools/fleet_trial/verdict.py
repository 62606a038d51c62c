"""Judge from outside: open the robots' journals and the fleet's rows, and count. Pure SQL.

Shares no code with the planner or the fleet. Each order's sentence ends with a number of its own,
by which it is found wherever it went, whatever the keys say.
"""

from __future__ import annotations

import json
import re
import sqlite3
from collections import defaultdict
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import sqlalchemy as sa

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

ENDED = frozenset({"succeeded", "failed", "refused", "cancelled", "given_up"})
NUMBER = re.compile(r"say (\d+)$")


@dataclass(frozen=True, slots=True)
class TrialVerdict:
    """Hold the numbers of the orders that went wrong, by how."""

    lost: tuple[int, ...]
    """Accepted; not among the fleet's rows, or ended in no journal and in no row."""
    begun_twice: tuple[int, ...]
    """Two goals ran, over all journals."""
    given_twice: tuple[int, ...]
    """Two goals or two missions were made, begun or not, but for goals that were taken back."""
    without_end: tuple[int, ...]
    """Not ended, or a robot is not told as done with it."""
    told_wrong: tuple[int, ...]
    """The fleet tells another end than the robot's journal."""
    taken_back: tuple[int, ...]
    """No fault: a robot's disk was too slow for an offer. See ``_is_taken_back``."""

    @property
    def is_clean(self) -> bool:
        """Return whether nothing went wrong."""
        faults = (field.name for field in fields(self) if field.name != "taken_back")
        return not any(getattr(self, name) for name in faults)


@dataclass(frozen=True, slots=True)
class JournalGoal:
    """Hold what a robot's journal says of one goal, over all its transitions."""

    state: str
    has_run: bool
    did_anything: bool
    """A metre was driven, or a step came to an end, in whichever record."""
    has_key: bool
    """A key leads to it: it is what the robot answers to whoever asks again."""
    first_unix_s: float
    last_unix_s: float


def judge(
    accepted: Mapping[int, Sequence[str]], homes: Sequence[Path], database: str
) -> TrialVerdict:
    """Return what became of the orders.

    Args:
        accepted: of each number, the missions' ids that came with its 202.
        homes: of the robots.
        database: of the fleet, as a URL.
    """
    goals: dict[int, list[JournalGoal]] = defaultdict(list)
    taken_back = []
    for home in homes:
        for number, found in _read_journal(home / "missions.db").items():
            kept = [goal for goal in found if not _is_taken_back(goal, found)]
            goals[number] += kept
            taken_back += [number] * (len(found) - len(kept))
    missions: dict[int, dict[str, str]] = defaultdict(dict)
    for mission_id, text, state in _read_rows(database):
        if (said := NUMBER.search(text)) is not None:
            missions[int(said[1])][mission_id] = state
    lost, open_, wrong = [], [], []
    for number, ids in accepted.items():
        states = {missions[number].get(each) for each in ids}
        taken = goals[number]
        told = {goal.state for goal in taken if goal.has_run} or {goal.state for goal in taken}
        if None in states or not ids or (not told and not states <= ENDED):
            lost.append(number)
        elif not states <= ENDED:
            open_.append(number)
        elif states != {"given_up"} and (states != told if told else "succeeded" in states):
            wrong.append(number)
    return TrialVerdict(
        tuple(lost),
        tuple(number for number, found in goals.items() if sum(g.has_run for g in found) > 1),
        tuple(number for number in {*goals, *missions}
              if len(goals[number]) > 1 or len(missions[number]) > 1),
        tuple(open_),
        tuple(wrong),
        tuple(taken_back),
    )  # fmt: skip


def _is_taken_back(goal: JournalGoal, same: Sequence[JournalGoal]) -> bool:
    """Return whether a robot took a goal back as one that its disk could not keep in time.

    A planner answers 503 then, cancels the goal and forgets its key, so that the offer comes again
    and makes a second goal; the first is written as soon as the disk can. Not excused is a goal
    that did anything, that a key still leads to, that was not followed by another of the same
    sentence in the same journal, or that had not ended when that one began. So two goals under two
    keys, or at two robots, are always told, also where one of them stood still.
    """
    return (
        goal.state == "cancelled"
        and not goal.did_anything
        and not goal.has_key
        and any(other.has_key and goal.last_unix_s <= other.first_unix_s for other in same)
    )


def written_at(homes: Sequence[Path]) -> dict[int, float]:
    """Return when each order was first written down by a robot [unix s]."""
    first: dict[int, float] = {}
    for home in homes:
        with sqlite3.connect(f"file:{home / 'missions.db'}?mode=ro", uri=True) as disk:
            asked = "SELECT mission, MIN(at_unix_s) FROM transitions GROUP BY mission"
            began = dict(disk.execute(asked).fetchall())
            for goal, record in disk.execute("SELECT id, record FROM missions"):
                if (found := NUMBER.search(json.loads(record)["text"])) is not None:
                    first[int(found[1])] = began[goal]
        disk.close()
    return first


def _read_journal(file: Path) -> dict[int, list[JournalGoal]]:
    """Return the goals of each order's number."""
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as disk:
        keyed = {row[0] for row in disk.execute("SELECT goal FROM idempotency_keys")}
        newest = [json.loads(row[0]) for row in disk.execute("SELECT record FROM missions")]
        passed: dict[str, list[tuple[str, float, dict[str, Any]]]] = defaultdict(list)
        asked = "SELECT mission, state, at_unix_s, record FROM transitions ORDER BY seq"
        for goal, state, at_unix_s, text in disk.execute(asked):
            passed[goal].append((state, at_unix_s, json.loads(text)))
    disk.close()
    goals: dict[int, list[JournalGoal]] = defaultdict(list)
    for record in newest:
        if (said := NUMBER.search(record["text"])) is None:
            continue
        states, times, records = zip(*passed[record["id"]], strict=True)
        goals[int(said[1])].append(JournalGoal(
            record["state"], "running" in states, any(map(_did_anything, (record, *records))),
            record["id"] in keyed, min(times), max(times),
        ))  # fmt: skip
    return goals


def _did_anything(record: dict[str, Any]) -> bool:
    """Return whether a record tells of a metre, or of a step that came to an end."""
    steps = (record.get("plan") or {}).get("steps") or ()
    return record.get("metres") != 0.0 or any(
        step.get("state") not in ("pending", "running", "skipped") for step in steps
    )


def _read_rows(database: str) -> list[tuple[str, str, str]]:
    engine = sa.create_engine(database.replace("postgresql://", "postgresql+psycopg://"))
    with engine.connect() as connection:
        rows = connection.execute(sa.text("SELECT id, text, state FROM fleet_missions")).all()
    engine.dispose()
    return [(row.id, row.text, row.state) for row in rows]
