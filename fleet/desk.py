"""Take orders, give each mission a robot, pass answers on, and stop. The fleet's one centre.

All that must survive is a row (``fleet.store``); here live the watches and who waits for whom.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import logging
import re
import uuid
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from sqlalchemy.exc import SQLAlchemyError

from fleet import workflow
from fleet.addressee import STOPS, Addressee, is_stop, read_addressee, to_names
from fleet.carrier import keep_lock
from fleet.dispatch import Dispatcher
from fleet.errors import FleetError
from fleet.link import RobotAway, RobotBusy, RobotRefusal
from fleet.records import ASKING, GIVEN_UP, UNKNOWN, MissionRow, RobotRow
from fleet.robots import link_of
from fleet.watch import SOURCE, STOP_S, RobotWatch, show_robot

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from fleet.carrier import CarrierLock
    from fleet.store import FleetStore

log = logging.getLogger(__name__)

NOTE_S = 1.0
"""A stop waits no longer for its row."""
THREADS = 64
"""For the database and for names of hosts: one that hangs must not keep a stop from its robot."""
ROBOTS_S = 2.0
"""So often robots are looked for that ``pons fleet add`` has added."""
_CHINESE = re.compile(r"[\u4e00-\u9fff]")


class Desk:
    """Hold the robots' watches, and move missions on."""

    def __init__(self, store: FleetStore, home: Path) -> None:
        self.store, self.home = store, home
        self.watches: dict[str, RobotWatch] = {}
        self.running: dict[str, asyncio.Event] = {}
        """Missions that a workflow of this process carries, and what wakes it."""
        self.swept = 0
        self.is_carrier = False
        """It watches robots, chooses and offers; else it reads, accepts and stops."""
        self._rows: dict[str, RobotRow] = {}
        self._tokens: dict[str, str] = {}
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self.dispatcher = Dispatcher(store, self.watches, self._rows)

    # Life -----------------------------------------------------------------------------------------

    async def start(self, url: str, lock: CarrierLock) -> None:
        """Take up the robots, and the missions of before where no other service carries them."""
        self._loop = asyncio.get_running_loop()
        self._loop.set_default_executor(ThreadPoolExecutor(THREADS))
        await self._take_up_robots()
        if await asyncio.to_thread(lock.take):
            self.carry(url)
        for name, loop in (("robots", self._look_for_robots()),
                           ("carrier", keep_lock(self, url, lock))):  # fmt: skip
            self._tasks[f" {name}"] = asyncio.create_task(loop)

    def carry(self, url: str) -> None:
        """Watch robots and carry missions from here on. Call it in the loop."""
        workflow.launch(self, url)
        self.is_carrier = True
        for name, watch in self.watches.items():
            watch.trouble = None
            self._tasks[name] = asyncio.create_task(watch.run())
        for name, loop in (("dispatch", self.dispatcher.run()), ("sweep", workflow.sweep(self))):
            self._tasks[f" {name}"] = asyncio.create_task(loop)

    async def close(self) -> None:
        """End all tasks; rows stay as they are."""
        for task in self._tasks.values():
            task.cancel()
        await asyncio.gather(*self._tasks.values(), return_exceptions=True)
        for watch in self.watches.values():
            await watch.link.close()
        if self.is_carrier:
            await asyncio.to_thread(workflow.shut_down)

    async def _look_for_robots(self) -> None:
        while True:
            await asyncio.sleep(ROBOTS_S)
            try:
                await self._take_up_robots()
            except SQLAlchemyError as error:
                log.warning("store_unavailable: %s", error)

    async def _take_up_robots(self) -> None:
        """Watch robots that are new, and anew those whose address, certificate or token is."""
        for row in await asyncio.to_thread(self.store.robots):
            link = link_of(row, self.home)
            known = self.watches.get(row.name)
            same = known is not None and (known.link.url, known.link.pin, known.link.token) == (
                link.url, link.pin, link.token,
            )  # fmt: skip
            self._rows[row.name] = row
            if same:
                continue
            if known is not None:
                if row.name in self._tasks:
                    self._tasks[row.name].cancel()
                await known.link.close()
            watch = self.watches[row.name] = RobotWatch(link, self.store, self.wake)
            if self.is_carrier:
                self._tasks[row.name] = asyncio.create_task(watch.run())
            else:
                watch.trouble = "watched_elsewhere"

    def watch_of(self, name: str) -> RobotWatch:
        """Return the watch of a robot.

        Raises:
            FleetError: ``unknown_robot``.
        """
        watch = self.watches.get(name)
        if watch is None:
            raise FleetError("unknown_robot", name=name, known=", ".join(sorted(self.watches)))
        return watch

    def wake(self, missions: Iterable[str]) -> None:
        """Let the workflows of these go on, and the dispatch look again. From any thread."""
        names = list(missions)
        try:
            asyncio.get_running_loop()
        except RuntimeError:
            self._loop.call_soon_threadsafe(self._wake, names)
        else:
            self._wake(names)

    def _wake(self, missions: Sequence[str]) -> None:
        for mission_id in missions:
            if (waiter := self.running.get(mission_id)) is not None:
                waiter.set()
        self.dispatcher.work.set()

    async def wait_for(self, mission_id: str, seconds: float) -> None:
        """Return when something has come to a mission, or after a time."""
        waiter = self.running[mission_id]
        with suppress(TimeoutError):
            await asyncio.wait_for(waiter.wait(), seconds)
        waiter.clear()

    # Orders ---------------------------------------------------------------------------------------

    async def order(
        self,
        text: str | None,
        steps: list[dict[str, Any]] | None,
        to: Addressee | None,
        key: str | None,
        *,
        confirm: bool = False,
    ) -> list[MissionRow]:
        """Accept an order: on return its missions are written down.

        Raises:
            FleetError: nothing was accepted.
        """  # fmt: skip
        if not self.watches:
            raise FleetError("no_robots")
        addressee, order = to, (text or "").strip()
        if text is not None and to is None:
            addressee, order = read_addressee(text, self.watches)
        if steps is None and not order:
            raise FleetError("no_order")
        addressee = addressee or Addressee("nearest")
        whom = [addressee]
        if addressee.way == "each":
            whom = [Addressee("each", (name,)) for name in addressee.names]
        language = "zh" if _CHINESE.search(order) else "en"
        body: dict[str, Any] = {"language": language, "source": SOURCE, "confirm": confirm}
        body |= {"text": order} if steps is None else {"steps": steps}
        order_id = f"o-{uuid.uuid4().hex[:20]}"
        is_urgent = steps is None and STOPS.search(order) is not None
        wanted = [(f"m-{uuid.uuid4().hex}", who, body, is_urgent) for who in whom]
        asked = json.dumps(
            [text, steps, addressee.way, addressee.names, confirm], ensure_ascii=True
        )
        asked_hash = hashlib.sha256(asked.encode()).hexdigest()
        missions = await asyncio.to_thread(
            self.store.accept, order_id, text or "", asked_hash, key, wanted, order
        )
        self.dispatcher.work.set()
        return missions

    def stop_of(self, text: str) -> tuple[str, ...] | None:
        """Return whom a sentence stops; None: it is no bare stop."""
        addressee, order = read_addressee(text, self.watches)
        if not is_stop(order):
            return None
        named = addressee is not None and addressee.way in ("named", "each")
        return addressee.names if addressee is not None and named else tuple(sorted(self.watches))

    async def stop(self, names: Sequence[str] | None) -> dict[str, Any]:
        """Stop these robots, or all, and tell who has confirmed. It is repeated to the others.

        Raises:
            FleetError: ``unknown_robot``.
        """
        known = tuple(sorted(self.watches))
        asked = known if names is None else to_names(names, known)
        stop_id, is_all = f"s-{uuid.uuid4().hex[:20]}", set(asked) == set(known)
        try:
            noting = asyncio.to_thread(self.store.stop, stop_id, asked, forever=is_all)
            ended = await asyncio.wait_for(noting, NOTE_S)
        except (SQLAlchemyError, TimeoutError):  # a stop waits for no disk
            return await self._stop_unwritten(stop_id, asked, forever=is_all)
        acts = [asyncio.create_task(self._stop_one(name)) for name in asked]
        if acts:
            await asyncio.wait(acts, timeout=STOP_S)
        self.wake([*ended, *self.running])
        confirmed, missing = await asyncio.to_thread(self.store.stop_state, stop_id)
        return _tell_stop(stop_id, confirmed, missing)

    async def stop_state(self, stop_id: str) -> dict[str, Any]:
        """Tell who has confirmed a stop by now."""
        return _tell_stop(stop_id, *await asyncio.to_thread(self.store.stop_state, stop_id))

    async def _stop_one(self, name: str) -> None:
        try:
            await self.watches[name].stop_now()
        except (RobotAway, RobotBusy, RobotRefusal, SQLAlchemyError) as trouble:
            log.warning("stop of %s: %s", name, trouble)
        self.watches[name].nudge()  # it is repeated there until confirmed

    async def _stop_unwritten(
        self, stop_id: str, names: Sequence[str], *, forever: bool
    ) -> dict[str, Any]:
        """Stop by the wires alone, where the database is away; its row is owed."""
        acts = {}
        for name in names:
            self.watches[name].is_ready = False  # nothing is offered before the row is there
            acts[name] = self.watches[name].link.post("/v1/stop", {"source": SOURCE})
        done = await asyncio.gather(*acts.values(), return_exceptions=True)
        heard = [name for name, answer in zip(acts, done, strict=True) if isinstance(answer, dict)]
        self.store.owe_stop(stop_id, names, forever=forever, heard=heard)
        return _tell_stop(stop_id, heard, [name for name in names if name not in heard])

    async def answer(self, mission_id: str, text: str) -> MissionRow:
        """Pass a person's answer on to the robot that asked.

        Raises:
            FleetError: ``unknown_mission``, ``not_asking``, ``robot_silent`` or ``robot_refused``.
        """
        mission = await asyncio.to_thread(self.store.mission, mission_id)
        if mission.state != ASKING or mission.robot is None:
            raise FleetError("not_asking", name=mission_id)
        watch = self.watch_of(mission.robot)
        try:
            body = {"text": text, "source": SOURCE}
            goal = await watch.link.post(f"/v1/goals/{mission.goal_id}/answer", body)
        except (RobotAway, RobotBusy):
            raise FleetError("robot_silent", name=mission.robot) from None
        except RobotRefusal as refused:
            why = refused.message["en"]
            raise FleetError("robot_refused", str(refused), name=mission.robot, why=why) from None
        self.wake(await asyncio.to_thread(self.store.apply_goals, mission.robot, [goal]))
        return await asyncio.to_thread(self.store.mission, mission_id)

    async def cancel(self, mission_id: str, *, give_up: bool = False) -> MissionRow:
        """End a mission: where it waits at once, else at its robot, which hears until it confirms.

        With ``give_up`` a mission whose robot is silent ends here, and there when it is back.

        Raises:
            FleetError: ``unknown_mission``, ``mission_ended`` or ``not_silent``.
        """
        mission = await asyncio.to_thread(self.store.mission, mission_id)
        if give_up and mission.robot is not None and not mission.is_over:
            watch = self.watch_of(mission.robot)
            answers = watch.is_ready if self.is_carrier else mission.state != UNKNOWN
            if answers and mission.reason != "goal_lost":
                raise FleetError("not_silent", name=mission.robot)
            wish = "cancel" if mission.is_sent else None
            ended = await asyncio.to_thread(
                self.store.end, mission_id, GIVEN_UP, "ended_by_person", wish=wish
            )
        else:
            ended = await asyncio.to_thread(self.store.cancel, mission_id)
        self.wake([mission_id])
        return ended

    # Looking --------------------------------------------------------------------------------------

    async def find(self, mission_id: str) -> MissionRow:
        """Return one mission; raises as ``FleetStore.mission``."""
        return await asyncio.to_thread(self.store.mission, mission_id)

    async def newest(self, limit: int) -> list[MissionRow]:
        """Return the open and the newest missions."""
        return await asyncio.to_thread(self.store.newest, limit)

    async def changed_since(self, cursor: int, limit: int) -> tuple[list[MissionRow], int]:
        """Return what has changed after a cursor."""
        return await asyncio.to_thread(self.store.changed_since, cursor, limit)

    async def show_robots(self) -> list[dict[str, Any]]:
        """Return all robots as the API shows them."""
        held = await asyncio.to_thread(self.store.missions_at_robots)
        return [show_robot(row, self.watches[name], held.get(name))
                for name, row in sorted(self._rows.items()) if name in self.watches]  # fmt: skip


def _tell_stop(stop_id: str, confirmed: list[str], missing: list[str]) -> dict[str, Any]:
    """Say who has confirmed a stop: "7 of 8 confirmed, r4 not reached"."""
    count, names = f"{len(confirmed)} of {len(confirmed) + len(missing)}", ", ".join(missing)
    english = f"{count} confirmed" + (f", {names} not reached" if missing else "")
    chinese = f"{len(confirmed) + len(missing)} 台中 {len(confirmed)} 台已确认" + (
        f"，未联系上 {names}" if missing else ""
    )
    return {"id": stop_id, "confirmed": confirmed, "not_reached": missing,
            "message": {"en": english, "zh": chinese}}  # fmt: skip
