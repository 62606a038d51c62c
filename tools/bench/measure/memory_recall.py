"""Ask a memory of 10 000 sightings and 400 facts nine kinds of questions, a thousand in all."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from planner.memory import FACT, PERSON, MemoryQuery, MemoryStore, ObjectSighting
from planner.state_database import StateDatabase
from tools.bench.report import row_of

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from tools.bench.report import ReportRow

NAME = "memory_recall"
TITLE = "memory: recall at 10 000 sightings"
LONG_ONLY = False
SIGHTINGS, FACTS, EACH = 10_000, 400, 112
NOW_S = 1_800_000_000.0
DAY_S = 86_400.0
GOAL_MS = "p99 <= 20"
_LABELS = ("person", "cup", "chair", "bottle", "book", "sofa", "laptop", "potted_plant", "cat")
_COLORS = (None, "red", "blue", "green", "white")
_ROOMS = ("kitchen", "study", "bedroom", "living_room", "hallway")
QUESTIONS = (
    MemoryQuery("red cup"),
    MemoryQuery("红色的杯子"),
    MemoryQuery("person", kinds=(PERSON,)),
    MemoryQuery("somebody", place="kitchen", since_unix_s=NOW_S - DAY_S),
    MemoryQuery("keys on the sofa"),
    MemoryQuery("thing number 7", kinds=(FACT,)),
    MemoryQuery("unicorn"),
    MemoryQuery(place="study", since_unix_s=NOW_S - 3600.0),
    MemoryQuery(),
)


def fill(store: MemoryStore, seed: int) -> None:
    """Fill a memory with things of a week, spread over five rooms."""
    random = Random(seed)
    batch: list[ObjectSighting] = []
    for number in range(SIGHTINGS):
        label, age_s = random.choice(_LABELS), random.random() * 6.9 * DAY_S
        batch.append(
            ObjectSighting(
                label, random.choice(_COLORS), "m", random.choice(_ROOMS),
                random.uniform(-20, 20), random.uniform(-20, 20), 0.9,
                NOW_S - age_s, NOW_S - age_s, f"{label}_{number}",
            )
        )  # fmt: skip
        if len(batch) == 500:
            store.see(batch)
            batch = []
    for number in range(FACTS):
        spot = random.choice(("sofa", "desk", "shelf"))
        store.teach(f"thing number {number} is on the {spot}", NOW_S - number, said_by="bench")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Return a row for each kind of question."""
    rows: list[ReportRow] = []
    with tempfile.TemporaryDirectory(prefix="pons-memory-") as home:
        database = StateDatabase(Path(home))
        store = MemoryStore(database)
        fill(store, 1)
        for query in QUESTIONS:
            took = [_ask(store, query) for _ in range(lab.count(EACH, 10 * EACH))]
            what = query.words or query.place or "everything"
            for at, clock in enumerate(("by the wall", "of a processor")):
                took_ms = [1e3 * each[at] for each in took]
                rows.append(row_of(f"recall of {what!r}, {clock}", "ms", GOAL_MS, took_ms))
        database.close()
    return rows


def _ask(store: MemoryStore, query: MemoryQuery) -> tuple[float, float]:
    """Return the seconds by the wall and those of a processor: others may hold it meanwhile."""
    began_s, worked_s = time.perf_counter(), time.thread_time()
    store.find(query, NOW_S)
    return time.perf_counter() - began_s, time.thread_time() - worked_s
