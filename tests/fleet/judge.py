"""Judge from outside: read the robots' journals and the fleet's rows by plain SQL alone."""

from __future__ import annotations

import sqlite3
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import sqlalchemy as sa


@dataclass(frozen=True, slots=True)
class Verdict:
    """Hold what became of a set of missions."""

    lost: tuple[str, ...]
    """Accepted, and in no journal although told as done; or in no row at all."""
    twice: tuple[str, ...]
    """Begun more than once, over all robots."""
    stateless: tuple[str, ...]
    """Not ended."""


CLEAN = Verdict((), (), ())


def judge(accepted: list[str], journals: list[Path], database: str) -> Verdict:
    """Return what became of the missions with these ids."""
    begun: Counter[str] = Counter()
    for file in journals:
        with sqlite3.connect(file) as disk:
            begun.update(row[0] for row in disk.execute("SELECT key FROM acts WHERE act='begun'"))
        disk.close()
    url = database.replace("postgresql://", "postgresql+psycopg://")
    engine = sa.create_engine(url)
    with engine.connect() as connection:
        rows = connection.execute(sa.text("SELECT id, state FROM fleet_missions")).all()
    engine.dispose()
    states = {row.id: row.state for row in rows}
    ended = {"succeeded", "failed", "refused", "cancelled", "given_up"}
    return Verdict(
        lost=tuple(each for each in accepted
                   if each not in states or (states[each] == "succeeded" and not begun[each])),
        twice=tuple(key for key, count in begun.items() if count > 1),
        stateless=tuple(each for each in accepted if states.get(each) not in ended),
    )  # fmt: skip
