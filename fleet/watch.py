"""Watch one robot: deliver stops and withdrawals first, then follow its journal by the cursor.

A robot that is silent makes its missions ``unknown``; they are neither failed nor given to another.
"""

from __future__ import annotations

import asyncio
import json
import logging
import random
import time
from contextlib import suppress
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from fleet.link import FleetLink, RobotAway, RobotBusy, RobotRefusal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from fleet.records import MissionRow, RobotRow
    from fleet.store import FleetStore

log = logging.getLogger(__name__)

POLL_S, IDLE_S = 0.5, 3.0
"""From one round to the next: while a journal changes, and at most while it doesn't."""
SILENT_S = 10.0
"""A robot that has not answered for so long is told as silent; Wi-Fi roams in a few seconds."""
LOOK_S = 2.0
METER_S = 10.0
RECONCILE_S = 30.0
"""So often each open goal is asked for by its id: a cursor of a journal that was replaced tells
nothing."""
PAGE, MOST_PAGES = 30, 10
"""Of one round: a journal that never ends leaves the others their turns."""
STOP_S = 2.0
SOURCE = "fleet"
CONNECTING = "connecting"
"""The trouble of a robot that has not answered its first round yet."""
CLOSING = {"points": [{"x_m": 0.0, "y_m": 0.0}], "map_id": "0" * 16, "language": "en",
           "source": SOURCE}  # fmt: skip
"""Offered under a mission's key to close it: a robot that has not got the mission makes a goal of
it that ends refused (no map has this id) and takes nothing else under that key any more; one that
has it answers ``idempotency_conflict``."""
CONFLICT = "idempotency_conflict"
LOST = frozenset({"unknown_goal", "goal_forgotten"})


class RobotWatch:
    """Hold what is known of one robot now, and keep its rows true."""

    def __init__(
        self, link: FleetLink, store: FleetStore, wake: Callable[[Iterable[str]], None]
    ) -> None:
        self.link, self._store, self._wake = link, store, wake
        self.name = link.name
        self.is_ready = False
        """It answers as the one that was added, and has heard all stops and withdrawals."""
        self.trouble: str | None = CONNECTING
        self.told: dict[str, Any] = {}
        self.usage: dict[str, Any] = {}
        """What its model has spent today; empty: not told yet."""
        self.heard_unix_s: float | None = None
        self.rehearses_again_s = float("-inf")
        """It is asked for no rehearsal before that."""
        self._began_s = time.monotonic()
        self._heard_s: float | None = None
        self._looked_s = self._metered_s = self._reconciled_s = float("-inf")
        self._is_marked = False
        self._cursor: int | None = None
        self._nudged = asyncio.Event()

    @property
    def is_silent(self) -> bool:
        """Return whether nothing was heard for longer than a roam takes."""
        since_s = self._began_s if self._heard_s is None else self._heard_s
        return time.monotonic() - since_s > SILENT_S

    @property
    def state(self) -> str:
        """Return ``ready`` or its trouble; a stop on its way is none."""
        return self.trouble or "ready"

    def nudge(self) -> None:
        """Let the next round begin at once."""
        self._nudged.set()

    async def run(self) -> None:
        """Make rounds until cancelled. Raises SQLAlchemyError; a later call goes on."""
        pause_s = POLL_S
        while True:
            pause_s = await self._round_or_trouble(pause_s)
            with suppress(TimeoutError):
                spread_s = pause_s * random.uniform(0.8, 1.2)  # many do not come back at once
                await asyncio.wait_for(self._nudged.wait(), spread_s)
            self._nudged.clear()

    async def _round_or_trouble(self, pause_s: float) -> float:
        """Make one round, or note why there was none; return the pause before the next."""
        try:
            has_changed = await self._round()
        except RobotAway as away:
            await self._note_away(str(away))
        except RobotBusy as busy:
            self._note_heard()
            log.info("%s: %s", self.name, busy)
            return pause_s
        except RobotRefusal as refused:
            self.is_ready = self.link.is_proven = False
            self.trouble = refused.code
            await asyncio.to_thread(self._mark_silent_if_due)
        except (KeyError, TypeError, ValueError) as odd:
            # What no shape of fleet/answers.py foresaw: a dead watch would repeat no stop.
            log.exception("%s answers what is not read", self.name)
            await self._note_away(f"an answer that is not read: {odd!r}")
        else:
            return POLL_S if has_changed else min(pause_s * 1.2, IDLE_S)
        return min(pause_s * 1.5, 5.0)

    async def ring_stop(self) -> None:
        """Stop the robot. It needs no proof of who answers: a stop harms nobody.

        Nothing is offered until the next round has seen that all stops are confirmed. Raises as
        ``FleetLink.ask``.
        """
        self.is_ready = False
        await self.link.post("/v1/stop", {"source": SOURCE})

    async def reconcile(self, mission: MissionRow) -> None:
        """Ask for a mission's goal by its id. Raises as ``FleetLink.ask``."""
        if mission.goal_id is None:
            return
        try:
            goal = await self.link.get(f"/v1/goals/{mission.goal_id}")
        except RobotRefusal as refused:
            if refused.code not in LOST:
                raise
            await asyncio.to_thread(self._store.mark_lost, mission.id)
        else:
            await asyncio.to_thread(self._store.apply_goals, self.name, [goal])
        self._wake([mission.id])

    async def close_key(self, mission: MissionRow) -> bool:
        """Make sure that a mission which may have been sent never begins; False: the robot has it.

        Then its goal is bound to it. Raises as ``FleetLink.ask``.
        """
        try:
            await self.link.post("/v1/goals", CLOSING, key=mission.id)
        except RobotRefusal as refused:
            if refused.code != CONFLICT:
                raise
        else:
            return True
        goal = await self.link.post("/v1/goals", mission_body(mission), key=mission.id)
        await asyncio.to_thread(self._store.bind, mission.id, goal)
        return False

    async def cancel(self, goal_id: str) -> None:
        """End a goal at the robot; one that has ended is left as it is. Raises as ``ask``."""
        try:
            goal = await self.link.post(f"/v1/goals/{goal_id}/cancel")
        except RobotRefusal as refused:
            if refused.code not in {*LOST, "bad_state"}:
                raise
        else:
            await asyncio.to_thread(self._store.apply_goals, self.name, [goal])

    async def _round(self) -> bool:
        """Do all that is due at the robot; return whether its journal has changed."""
        unconfirmed = await asyncio.to_thread(self._store.unconfirmed_stops)
        if ids := unconfirmed.get(self.name):
            await self.ring_stop()
            await asyncio.to_thread(self._store.confirm_stops, {self.name: ids})
        await self._prove()
        if self._is_marked or self._reconciled_s == float("-inf"):
            await asyncio.to_thread(self._store.mark_heard, self.name)
            self._is_marked = False
        await self._withdraw()
        has_changed = await self._follow()
        self._note_heard()
        await self._look()
        await self._prove()  # a connection may have been made since
        is_first, self.is_ready, self.trouble = not self.is_ready, True, None
        if is_first:
            self._wake(())
        return has_changed or is_first

    async def _prove(self) -> None:
        """Read the card of the robot at the other end, where that may be another than before."""
        if self.link.is_proven:
            return
        card = await self.link.prove()
        card["skills"] = (await self._ask_of_old("/v1/skills")).get("skills", [])
        await asyncio.to_thread(self._store.update_card, self.name, card)
        self._reconciled_s = float("-inf")

    async def _withdraw(self) -> None:
        """Tell the robot of missions that people ended while it was silent."""
        for mission in await asyncio.to_thread(self._store.withdrawals, self.name):
            if mission.goal_id is None and await self.close_key(mission):
                await asyncio.to_thread(self._store.clear_wish, mission.id)
                continue
            bound = await asyncio.to_thread(self._store.mission, mission.id)
            await self.cancel(bound.goal_id or "")
            await self.reconcile(bound)
            await asyncio.to_thread(self._store.clear_wish, mission.id)

    async def _follow(self) -> bool:
        """Take up changes of the journal, if any; now and then ask for each open goal by its id."""
        has_changed = False
        if self._cursor is None:
            rows = await asyncio.to_thread(self._store.robots)
            self._cursor = next(row.cursor for row in rows if row.name == self.name)
        for _ in range(MOST_PAGES):
            before = self._cursor
            page = await self.link.get("/v1/goals", after=self._cursor, limit=PAGE)
            goals, cursor = page["goals"], int(page["next"])
            if goals:  # where a robot stands is asked after its goal ended, before rooms are free
                self._looked_s = float("-inf")
                await self._look()
            if goals or cursor != self._cursor:
                has_changed = True
                touched = await asyncio.to_thread(self._store.apply_goals, self.name, goals, cursor)
                self._cursor = cursor
                self._wake(touched)
            if len(goals) < PAGE or not cursor > before:
                break
        if time.monotonic() - self._reconciled_s > RECONCILE_S:
            for mission in await asyncio.to_thread(self._store.at_work, self.name):
                await self.reconcile(mission)
            self._reconciled_s = time.monotonic()
        return has_changed

    async def _look(self) -> None:
        if time.monotonic() - self._looked_s > LOOK_S:
            self.told = await self.link.get("/v1/robot")
            self._looked_s = time.monotonic()
        if time.monotonic() - self._metered_s > METER_S:
            told = await self._ask_of_old("/v1/usage")
            # The day is this service's: a robot whose clock is off would hide what it spends.
            self.usage = {**told, "day": f"{datetime.now(UTC):%Y-%m-%d}"} if told else {}
            self._metered_s = time.monotonic()

    async def _ask_of_old(self, path: str) -> dict[str, Any]:
        """Return what a robot tells there; nothing of one of before that has no such route."""
        try:
            told = await self.link.get(path)
        except RobotRefusal as refused:
            if refused.status != 404:
                raise
            told = None
        return told if isinstance(told, dict) else {}

    def _note_heard(self) -> None:
        self._heard_s, self.heard_unix_s = time.monotonic(), time.time()

    async def _note_away(self, why: str) -> None:
        if self.is_ready:
            log.warning("%s does not answer: %s", self.name, why)
        self.is_ready, self.trouble = False, "robot_silent"
        await asyncio.to_thread(self._mark_silent_if_due)

    def _mark_silent_if_due(self) -> None:
        is_silent = self.is_silent  # asked once: time goes on
        if is_silent and not self._is_marked:
            since = self.heard_unix_s if self.heard_unix_s is not None else time.time()
            self._wake(self._store.mark_silent(self.name, since))
        self._is_marked = is_silent


def mission_body(mission: MissionRow) -> dict[str, Any]:
    """Return what is offered of a mission, each time the same."""
    body: dict[str, Any] = json.loads(mission.body)
    return body


def show_robot(robot: RobotRow, watch: RobotWatch, mission_id: str | None) -> dict[str, Any]:
    """Return a robot as the API shows it."""
    card, status = robot.capabilities, watch.told.get("status") or {}
    return {
        "name": robot.name, "robot_id": robot.robot_id, "url": robot.url,
        "state": watch.state,
        "heard_unix_s": watch.heard_unix_s, "mission": mission_id,
        "mode": status.get("mode"), "base_in_map": status.get("base_in_map"),
        "room": watch.told.get("room"), "map_id": card.get("map_id"), "site": card.get("site"),
        "release": card.get("release"), "camera": card.get("camera"),
        "battery": battery_of(watch.told),
        "pin": {"kind": robot.pin_kind, "sha256": robot.pin_sha256},
    }  # fmt: skip


def battery_of(told: Mapping[str, Any]) -> float | None:
    """Return a battery's charge from 0 to 1 as its robot told last; None: it has no gauge."""
    status: Mapping[str, Any] = told.get("status") or {}
    charge: float | None = (status.get("drive") or {}).get("battery")
    return charge
