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
from functools import partial
from typing import TYPE_CHECKING, Any

from sqlalchemy.exc import SQLAlchemyError

from fleet import workflow
from fleet.addressee import STOPS, Addressee, read_addressee
from fleet.carrier import keep_lock
from fleet.charging import look_after_batteries
from fleet.dispatch import Dispatcher, robots_meant
from fleet.errors import FleetError
from fleet.link import RobotAway, RobotBusy, RobotRefusal
from fleet.records import ASKING, GIVEN_UP, UNKNOWN, WAITING, MissionRow, RobotRow
from fleet.robots import link_of
from fleet.standing import keep_time
from fleet.stops import Stops
from fleet.watch import CONNECTING, SOURCE, RobotWatch, show_robot

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable, Sequence
    from pathlib import Path

    from fleet.carrier import CarrierLock
    from fleet.store import FleetStore

    Loop = Callable[[], Awaitable[None]]

log = logging.getLogger(__name__)

AGAIN_S = 1.0
"""After that a loop that has failed begins again."""
THREADS = 64
"""For the database and for names of hosts: one that hangs must not keep a stop from its robot."""
ROBOTS_S = 2.0
"""So often robots are looked for that ``pons fleet add`` has added."""
PROOF_NEEDED = frozenset({"operator_proof_needed", "person_needed", "operator_needed"})
"""Of a robot of metal: its operator's key alone clears what a stop has held."""
_CHINESE = re.compile(r"[\u4e00-\u9fff]")


async def keep_going(name: str, loop: Loop) -> None:
    """Run a loop until cancelled: one that ended for good would keep orders and stops for ever."""
    while True:
        try:
            await loop()
        except SQLAlchemyError as error:
            log.warning("store_unavailable: %s: %s", name, error)
        except Exception:
            log.exception("%s failed; it begins again in %g s", name, AGAIN_S)
        await asyncio.sleep(AGAIN_S)


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
        self.stops = Stops(store, self.watches, self.running, self.wake)

    # Life -----------------------------------------------------------------------------------------

    async def start(self, url: str, lock: CarrierLock) -> None:
        """Take up the robots, and the missions of before where no other service carries them."""
        self._loop = asyncio.get_running_loop()
        self._loop.set_default_executor(ThreadPoolExecutor(THREADS))
        await self._take_up_robots()
        if await asyncio.to_thread(lock.take):
            self.carry(url)
        self._keep_going(" robots", self._look_for_robots)
        self._keep_going(" carrier", partial(keep_lock, self, url, lock))

    def carry(self, url: str) -> None:
        """Watch robots and carry missions from here on. Call it in the loop."""
        workflow.launch(self, url)
        self.is_carrier = True
        for name, watch in self.watches.items():
            watch.trouble = CONNECTING
            self._keep_going(name, watch.run)
        self._keep_going(" dispatch", self.dispatcher.run)
        self._keep_going(" sweep", partial(workflow.sweep, self))
        self._keep_going(" standing", partial(keep_time, self))
        self._keep_going(" charging", partial(look_after_batteries, self))

    def _keep_going(self, name: str, loop: Loop) -> None:
        self._tasks[name] = asyncio.create_task(keep_going(name.strip(), loop))

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
            await self._take_up_robots()

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
                self._keep_going(row.name, watch.run)
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
        order_id: str | None = None,
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
        order_id = order_id or f"o-{uuid.uuid4().hex[:20]}"
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

    async def answer(self, mission_id: str, text: str) -> MissionRow:
        """Pass a person's answer on to the robot that asked, or take it where the fleet asks.

        Raises:
            FleetError: ``unknown_mission``, ``not_asking``, ``robot_silent``, ``robot_refused`` or
                ``which_home``.
        """
        mission = await asyncio.to_thread(self.store.mission, mission_id)
        if mission.state == WAITING and mission.question:
            who = robots_meant(mission.question, text)
            return await self._readdress(mission, mission.way, who)
        if mission.state != ASKING or mission.robot is None:
            raise FleetError("not_asking", name=mission_id)
        return await self._act(mission, "answer", {"text": text, "source": SOURCE})

    async def readdress(self, mission_id: str, to: Addressee) -> MissionRow:
        """Give an order that waits to others instead.

        Raises:
            FleetError: ``unknown_mission``, or ``not_waiting``.
        """
        mission = await asyncio.to_thread(self.store.mission, mission_id)
        return await self._readdress(mission, to.way, to.names)

    async def _readdress(self, mission: MissionRow, way: str, names: Sequence[str]) -> MissionRow:
        values = {"way": way, "names": json.dumps(list(names)), "question": None}
        if not await asyncio.to_thread(self.store.change_waiting, mission.id, **values):
            raise FleetError("not_waiting", name=mission.id)
        self.dispatcher.work.set()
        return await asyncio.to_thread(self.store.mission, mission.id)

    async def pause(self, mission_id: str) -> MissionRow:
        """Let the robot keep a mission's place, standing; raises as ``resume``."""
        return await self._act(await self._find_at_robot(mission_id), "pause", {})

    async def resume(self, mission_id: str) -> MissionRow:
        """Let a robot go on with a mission that it paused: after a stop, or a restart there.

        Raises:
            FleetError: ``unknown_mission``, ``not_at_robot``, ``robot_silent``, ``robot_refused``,
                or ``resume_at_robot`` where a person's key is needed there.
        """
        return await self._act(await self._find_at_robot(mission_id), "resume", {"source": SOURCE})

    async def _find_at_robot(self, mission_id: str) -> MissionRow:
        mission = await asyncio.to_thread(self.store.mission, mission_id)
        if mission.is_over or mission.goal_id is None:
            raise FleetError("not_at_robot", name=mission_id)
        return mission

    async def _act(self, mission: MissionRow, act: str, body: dict[str, Any]) -> MissionRow:
        """Ask the robot for an act on a mission's goal, and take up what it tells."""
        robot = mission.robot or ""
        watch = self.watch_of(robot)
        try:
            if not watch.link.is_proven:  # as where this service stands by
                await watch.link.prove()
            goal = await watch.link.post(f"/v1/goals/{mission.goal_id}/{act}", body)
        except (RobotAway, RobotBusy):
            raise FleetError("robot_silent", name=robot) from None
        except RobotRefusal as refused:
            if refused.code in PROOF_NEEDED:
                raise FleetError("resume_at_robot", name=robot, known=watch.link.url) from None
            why = refused.message["en"]
            raise FleetError("robot_refused", str(refused), name=robot, why=why) from None
        self.wake(await asyncio.to_thread(self.store.apply_goals, robot, [goal]))
        return await asyncio.to_thread(self.store.mission, mission.id)

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

    def rows(self) -> list[RobotRow]:
        """Return the robots that are watched, by name."""
        return [row for name, row in sorted(self._rows.items()) if name in self.watches]

    async def show_robots(self) -> list[dict[str, Any]]:
        """Return all robots as the API shows them."""
        held = await asyncio.to_thread(self.store.missions_at_robots)
        return [show_robot(row, self.watches[name], held.get(name))
                for name, row in sorted(self._rows.items()) if name in self.watches]  # fmt: skip
