"""Give the standing orders of the house at their times, each run once.

A run's key is made of its order and its instant, so that a crash between its missions and the line
that they were given finds the same missions again. What is due is told even where nothing came of
it: a time that passed while nobody served, a day left out, an order that was refused.
"""

from __future__ import annotations

import asyncio
import json
import logging
import time
from dataclasses import dataclass, fields
from datetime import datetime
from itertools import islice, pairwise
from typing import TYPE_CHECKING, Any, Protocol

from cronsim import CronSim, CronSimError

from fleet.addressee import is_stop, read_addressee
from fleet.errors import WORDS, FleetError, tell
from fleet.house import zone_of
from fleet.records import STANDING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    import sqlalchemy as sa

    from fleet.house import HouseRules
    from fleet.records import MissionRow

log = logging.getLogger(__name__)

LOOK_S = 2.0
LEAST_APART_S = 300.0
"""As at a robot: what comes oftener is no errand but a state."""
RUNS_JUDGED = 50


@dataclass(frozen=True, slots=True)
class StandingRow:
    """Hold a sentence with the times at which it is said to the house."""

    id: str
    text: str
    cron: str
    zone: str
    skipped: str
    handled_unix_s: float
    last: str | None
    fired: int
    missed: int
    created_unix_s: float

    @property
    def days_skipped(self) -> tuple[str, ...]:
        """Return the days that are left out, as ``2026-12-24``."""
        return tuple(json.loads(self.skipped))

    def runs(self, after_unix_s: float) -> Iterator[float]:
        """Yield the instants after this one at which it is due."""
        return runs_of(self.cron, self.zone, after_unix_s)


class StandingBook(Protocol):
    """Be where standing orders are kept."""

    def rules(self) -> HouseRules: ...

    def standing_orders(self) -> list[StandingRow]: ...

    def note_run(self, order_id: str, until_unix_s: float, told: Mapping[str, Any]) -> None: ...


class OrderTaker(Protocol):
    """Be where orders are given."""

    @property
    def store(self) -> StandingBook: ...

    async def order(
        self, text: str | None, steps: list[dict[str, Any]] | None, to: None, key: str | None,
        *, order_id: str,
    ) -> list[MissionRow]: ...  # fmt: skip


def standing_row(row: sa.RowMapping) -> StandingRow:
    """Return a standing order of its row."""
    return StandingRow(**{field.name: row[field.name] for field in fields(StandingRow)})


def runs_of(cron: str, zone: str, after_unix_s: float) -> Iterator[float]:
    """Yield when a cron line is due, by a zone's clock. Raises CronSimError: it is no such line."""
    for due in CronSim(cron, datetime.fromtimestamp(after_unix_s, zone_of(zone))):
        if (due_s := due.timestamp()) > after_unix_s:  # of two equal hours it counts the first
            yield due_s


def judge_standing(text: str, when: str, zone: str, known: Sequence[str]) -> str:
    """Return a standing order's cron line: five fields as given, or a time of day as ``19:00``.

    Raises:
        FleetError: ``standing_time``, ``standing_often``, ``standing_stop`` or ``no_order``.
    """
    hour, colon, minute = when.strip().partition(":")
    cron = f"{minute} {hour} * * *" if colon and " " not in when.strip() else when.strip()
    try:
        if len(cron.split()) != 5:
            raise CronSimError("five fields")
        first = list(islice(runs_of(cron, zone, time.time()), RUNS_JUDGED))
    except (CronSimError, RuntimeError, OverflowError, ValueError):
        first = []
    if not first:
        raise FleetError("standing_time", name=when[:60])
    if any(not later - due >= LEAST_APART_S for due, later in pairwise(first)):
        raise FleetError("standing_often", name=when[:60])
    _, order = read_addressee(text, known)
    if is_stop(order):
        raise FleetError("standing_stop")
    if not order:
        raise FleetError("no_order")
    return cron


def show_standing(order: StandingRow, rules: HouseRules) -> dict[str, Any]:
    """Return a standing order as the API shows it."""
    zone = zone_of(order.zone)
    due_s = next(order.runs(max(order.handled_unix_s, time.time())), None)
    last = json.loads(order.last) if order.last is not None else None
    if last is not None:
        last["message"] = tell(last["code"]) if last["code"] in WORDS else None
    is_quiet = due_s is not None and rules.is_quiet(due_s)
    return {
        "id": order.id, "text": order.text, "cron": order.cron, "timezone": zone.key,
        "skipped": list(order.days_skipped), "fired": order.fired, "missed": order.missed,
        "next": due_s and datetime.fromtimestamp(due_s, zone).isoformat(timespec="minutes"),
        "last": last, "warning": tell("standing_quiet") if is_quiet else None,
    }  # fmt: skip


async def keep_time(desk: OrderTaker) -> None:
    """Give each order at its times, until cancelled. Raises SQLAlchemyError."""
    while True:
        await asyncio.sleep(LOOK_S)
        rules = await asyncio.to_thread(desk.store.rules)
        for order in await asyncio.to_thread(desk.store.standing_orders):
            await give_due(desk, order, time.time(), rules.late_min * 60.0)


async def give_due(desk: OrderTaker, order: StandingRow, now_s: float, late_s: float) -> None:
    """Give an order if it is due, or tell why not. A run over ``late_s`` ago is not made up."""
    due_s = next(order.runs(order.handled_unix_s), None)
    if due_s is None or due_s > now_s:
        return
    day = f"{datetime.fromtimestamp(due_s, zone_of(order.zone)):%Y-%m-%d}"
    code, missions, until_s = "fired", [], due_s
    if day in order.days_skipped:
        code = "day_skipped"
    elif due_s < now_s - late_s:
        code, until_s = "was_off", now_s - late_s  # however many there were, they are told as one
    else:
        run = f"{STANDING}{order.id}-{int(due_s)}"
        try:  # no header's value begins with a space, so that no client has this key
            given = await desk.order(order.text, None, None, f" {run}", order_id=run)
            missions = [each.id for each in given]
        except FleetError as refused:  # a robot came or went since a crash: they were given
            code = "fired" if refused.code == "idempotency_conflict" else refused.code
    if code != "fired":
        log.warning("standing order %s of %s: %s", order.id, day, code)
    told = {"code": code, "due_unix_s": due_s, "missions": missions}
    await asyncio.to_thread(desk.store.note_run, order.id, until_s, told)
