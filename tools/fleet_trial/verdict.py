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
    """Two goals or two missions were made, begun or not."""
    without_end: tuple[int, ...]
    """Not ended, or a robot is not told as done with it."""
    told_wrong: tuple[int, ...]
    """The fleet tells another end than the robot's journal."""

    @property
    def is_clean(self) -> bool:
        """Return whether nothing went wrong."""
        return not any(getattr(self, field.name) for field in fields(self))


def judge(
    accepted: Mapping[int, Sequence[str]], homes: Sequence[Path], database: str
) -> TrialVerdict:
    """Return what became of the orders.

    Args:
        accepted: of each number, the missions' ids that came with its 202.
        homes: of the robots.
        database: of the fleet, as a URL.
    """
    goals: dict[int, dict[tuple[str, str], tuple[str, bool]]] = defaultdict(dict)
    for home in homes:
        for number, goal, state, has_run in _read_journal(home / "missions.db"):
            goals[number][home.name, goal] = (state, has_run)
    missions: dict[int, dict[str, str]] = defaultdict(dict)
    for mission_id, text, state in _read_rows(database):
        if (found := NUMBER.search(text)) is not None:
            missions[int(found[1])][mission_id] = state
    lost, open_, wrong = [], [], []
    for number, ids in accepted.items():
        states = {missions[number].get(each) for each in ids}
        taken = goals[number].values()
        told = {state for state, has_begun in taken if has_begun} or {state for state, _ in taken}
        if None in states or not ids or (not told and not states <= ENDED):
            lost.append(number)
        elif not states <= ENDED:
            open_.append(number)
        elif states != {"given_up"} and (states != told if told else "succeeded" in states):
            wrong.append(number)
    began = {number: sum(b for _, b in found.values()) for number, found in goals.items()}
    return TrialVerdict(
        tuple(lost),
        tuple(number for number, count in began.items() if count > 1),
        tuple(number for number in {*goals, *missions}
              if len(goals[number]) > 1 or len(missions[number]) > 1),
        tuple(open_),
        tuple(wrong),
    )  # fmt: skip


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


def _read_journal(file: Path) -> list[tuple[int, str, str, bool]]:
    """Return of each numbered goal its number, id, newest state, and whether it ever began.

    One that a robot answered with 503, for a disk that was slow, is written later as one that ran,
    and cancelled with all its steps skipped and no metre driven: it did not begin.
    """
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as disk:
        ran = {row[0] for row in disk.execute("SELECT mission FROM transitions "
                                              "WHERE state='running'")}  # fmt: skip
        records = [json.loads(row[0]) for row in disk.execute("SELECT record FROM missions")]
    disk.close()
    return [
        (int(found[1]), record["id"], record["state"], record["id"] in ran and not _is_idle(record))
        for record in records
        if (found := NUMBER.search(record["text"])) is not None
    ]


def _is_idle(record: dict[str, Any]) -> bool:
    """Return whether a goal ended without a step or a metre."""
    steps = (record.get("plan") or {}).get("steps") or [{}]
    idle = all(step.get("state") in ("skipped", "pending") for step in steps)
    return record["state"] == "cancelled" and idle and record.get("metres") == 0.0


def _read_rows(database: str) -> list[tuple[str, str, str]]:
    engine = sa.create_engine(database.replace("postgresql://", "postgresql+psycopg://"))
    with engine.connect() as connection:
        rows = connection.execute(sa.text("SELECT id, text, state FROM fleet_missions")).all()
    engine.dispose()
    return [(row.id, row.text, row.state) for row in rows]
