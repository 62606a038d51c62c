"""Give waiting missions their robots, the oldest first; one that none may take ends, told why."""

from __future__ import annotations

import asyncio
import logging
from contextlib import suppress
from typing import TYPE_CHECKING

from sqlalchemy.exc import SQLAlchemyError

from fleet import workflow
from fleet.choice import is_able, rank
from fleet.records import CANCELLED, REFUSED, WAITING, MissionRow, RobotRow

if TYPE_CHECKING:
    from fleet.store import FleetStore
    from fleet.watch import RobotWatch

log = logging.getLogger(__name__)

DISPATCH_S = 2.0


class Dispatcher:
    """Hold what is known of the robots, and choose."""

    def __init__(
        self, store: FleetStore, watches: dict[str, RobotWatch], rows: dict[str, RobotRow]
    ) -> None:
        self._store, self._watches, self._rows = store, watches, rows
        self.work = asyncio.Event()

    async def run(self) -> None:
        """Choose whenever there is work, until cancelled."""
        while True:
            with suppress(TimeoutError):
                await asyncio.wait_for(self.work.wait(), DISPATCH_S)
            self.work.clear()
            try:
                await self._give_robots()
            except SQLAlchemyError as error:
                log.warning("store_unavailable: %s", error)

    def waits_for(self, mission: MissionRow) -> str | None:
        """Return what a waiting mission waits for, by code."""
        if mission.state != WAITING:
            return None
        answering = [name for name in self._candidates(mission) if self._watches[name].is_ready]
        return "robots_busy" if answering else "nobody_answers"

    async def _give_robots(self) -> None:
        self._rows.update({row.name: row for row in await asyncio.to_thread(self._store.robots)})
        held = set(await asyncio.to_thread(self._store.missions_at_robots))
        for mission in await asyncio.to_thread(self._store.waiting):
            await self._give_robot(mission, held)

    async def _give_robot(self, mission: MissionRow, held: set[str]) -> None:
        may = self._candidates(mission)
        if not may:
            await asyncio.to_thread(self._store.end, mission.id, CANCELLED, "stopped_first")
            return
        cards = {name: row.capabilities for name, row in self._rows.items()}
        able = [name for name in may if is_able(mission.text, name, cards)]
        if not able:
            await asyncio.to_thread(self._store.end, mission.id, REFUSED, "nobody_can")
            return
        free = [
            name
            for name in able
            if self._watches[name].is_ready and (mission.is_urgent or name not in held)
        ]
        if not free:
            return
        watches = [self._watches[name] for name in free]
        used = {name: self._rows[name].used_seq for name in free}
        best = (await rank(mission, watches, cards, used))[0]
        claimed = await asyncio.to_thread(self._store.claim, mission, best)
        if claimed is not None:
            held.add(best)
            await workflow.begin(claimed)

    def _candidates(self, mission: MissionRow) -> list[str]:
        """Return who may go: an order of before a robot's stop moves it no more."""
        return [
            name
            for name in mission.candidates or tuple(self._rows)
            if name in self._rows
            and name in self._watches
            and mission.seq > self._rows[name].stopped_seq
        ]
