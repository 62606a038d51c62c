"""Carry each mission through: a durable workflow of DBOS, whose mission's id is the robot's key.

``durable_step`` is the one way to a step here: a bare step that raises ends its workflow for good.
What falls through all the same (a version of before, an executor that died in a recovery) is found
by the sweeper, which begins it again by the same key; so nothing is done twice.
"""

from __future__ import annotations

import asyncio
import json
import logging
import time
from typing import TYPE_CHECKING, Protocol

from dbos import DBOS, DBOSConfig, SetWorkflowID, StepOptions
from sqlalchemy.exc import SQLAlchemyError

from fleet.link import TOKEN_REFUSED, RobotAway, RobotBusy, RobotRefusal
from fleet.records import CANCELLED, GOAL_ENDED, REFUSED
from fleet.watch import LOST, RobotWatch, mission_body

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable

    from fleet.records import MissionRow
    from fleet.store import FleetStore

log = logging.getLogger(__name__)

APPLICATION_VERSION = "fleet-1"
"""Ours, so that an upgrade strands nothing: to be raised when the steps of a mission change."""
EXECUTOR = "fleet"
SWEEP_S = 5.0
STANDS_STILL_S = 15.0
"""A mission at work that no workflow here carries for so long is begun again."""
WAIT_S = 20.0
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.2, 5.0
WRONG_ROBOT = frozenset({"pin_mismatch", "robot_mismatch"})


class MissionDesk(Protocol):
    """Be where missions are carried: what their workflows ask of it."""

    store: FleetStore
    running: dict[str, asyncio.Event]
    swept: int

    def watch_of(self, name: str) -> RobotWatch: ...

    def wake(self, missions: Iterable[str]) -> None: ...

    async def wait_for(self, mission_id: str, seconds: float) -> None: ...


_desks: list[MissionDesk] = []


def launch(desk: MissionDesk, url: str) -> None:
    """Start the engine on a database; it takes up the workflows of before. Call it in the loop."""
    _desks[:] = [desk]
    config: DBOSConfig = {
        "name": "pons-fleet", "system_database_url": url, "executor_id": EXECUTOR,
        "application_version": APPLICATION_VERSION, "log_level": "WARNING", "enable_otlp": False,
    }  # fmt: skip
    DBOS(config=config)
    DBOS.launch()


def shut_down() -> None:
    """End the engine; what runs stays pending, and is taken up by the next process."""
    DBOS.destroy()


async def begin(mission: MissionRow) -> None:
    """Start the workflow of a mission that has its robot.

    Raises:
        ValueError: an empty id, which the engine would take for none and run for ever.
    """
    if not mission.id.strip():
        raise ValueError("a mission without an id")
    with SetWorkflowID(_workflow_id(mission)):
        await DBOS.start_workflow_async(run_mission, mission.id)


def _workflow_id(mission: MissionRow) -> str:
    return mission.id if mission.attempt == 1 else f"{mission.id}~{mission.attempt}"


@DBOS.workflow(name="run_mission")
async def run_mission(mission_id: str) -> str:
    """Offer a mission until its robot's journal has it, watch it to its end, and tell of it."""
    desk = _desks[0]
    if mission_id in desk.running:
        return "elsewhere"  # the sweeper was quicker than a recovery; the other one goes on
    desk.running[mission_id] = asyncio.Event()
    try:
        await durable_step("offer", _offer, mission_id)
        await durable_step("watch", _watch, mission_id)
        return await durable_step("tell", _tell, mission_id)
    finally:
        del desk.running[mission_id]


async def durable_step(name: str, act: Callable[[str], Awaitable[str]], mission_id: str) -> str:
    """Do a step that is written down when it is done; a database that is away is waited for."""

    async def patiently() -> str:
        pause_s = FIRST_PAUSE_S
        while True:
            try:
                return await act(mission_id)
            except SQLAlchemyError as error:
                log.warning("store_unavailable: %s of %s: %s", name, mission_id, error)
                await asyncio.sleep(pause_s)
                pause_s = min(2.0 * pause_s, LONGEST_PAUSE_S)

    options: StepOptions = {
        "name": name, "retries_allowed": True, "max_attempts": 20, "interval_seconds": 0.5,
    }  # fmt: skip
    return await DBOS.run_step_async(options, patiently)


async def _offer(mission_id: str) -> str:
    """Offer a mission until the journal has it, or it is known never to begin."""
    desk, pause_s = _desks[0], FIRST_PAUSE_S
    while True:
        mission = await asyncio.to_thread(desk.store.mission, mission_id)
        if mission.is_over or mission.goal_id is not None or mission.robot is None:
            return mission.state
        watch = desk.watch_of(mission.robot)
        try:
            if await _offer_once(desk, watch, mission):
                continue
        except RobotAway:
            watch.link.is_proven = watch.is_ready = False
            watch.nudge()
        except RobotBusy as busy:
            log.info("%s: %s", mission.robot, busy)
        await desk.wait_for(mission_id, pause_s)
        pause_s = min(2.0 * pause_s, LONGEST_PAUSE_S if watch.is_ready else 1.0)


async def _offer_once(desk: MissionDesk, watch: RobotWatch, mission: MissionRow) -> bool:
    """Try once; return whether something has come of it."""
    barred = await asyncio.to_thread(desk.store.is_barred, mission)
    reason = "cancelled_first" if mission.wish else "stopped_first"
    if (barred or mission.wish) and not mission.is_sent:
        await asyncio.to_thread(desk.store.end, mission.id, CANCELLED, reason)
        return True
    if not watch.is_ready:
        return False
    try:
        if barred or mission.wish:
            if await watch.close_key(mission):
                await asyncio.to_thread(desk.store.end, mission.id, CANCELLED, reason)
            return True
        await asyncio.to_thread(desk.store.change, mission.id, is_sent=True)
        goal = await watch.link.post("/v1/goals", mission_body(mission), key=mission.id)
    except RobotRefusal as refused:
        return await _judge_refusal(desk, watch, mission, refused)
    await asyncio.to_thread(desk.store.bind, mission.id, goal)
    watch.nudge()  # from now on its journal changes
    return True


async def _judge_refusal(
    desk: MissionDesk, watch: RobotWatch, mission: MissionRow, refused: RobotRefusal
) -> bool:
    if refused.status in TOKEN_REFUSED or refused.code in WRONG_ROBOT:  # a person can mend it
        watch.is_ready, watch.trouble = False, refused.code
        await asyncio.to_thread(desk.store.change, mission.id, reason=refused.code)
        return False
    if refused.code in LOST:
        await asyncio.to_thread(desk.store.mark_lost, mission.id)
        return False
    outcome = {"code": refused.code, "message": dict(refused.message)}
    await asyncio.to_thread(
        desk.store.end,
        mission.id,
        REFUSED,
        refused.code,
        outcome=json.dumps(outcome, ensure_ascii=False),
    )
    return True


async def _watch(mission_id: str) -> str:
    """Wait for the end of a mission at its robot; hand a person's cancel on."""
    desk, is_first = _desks[0], True
    while True:
        mission = await asyncio.to_thread(desk.store.mission, mission_id)
        if mission.is_over or mission.goal_state in GOAL_ENDED or mission.robot is None:
            return mission.state
        watch, wait_s = desk.watch_of(mission.robot), WAIT_S
        if watch.is_ready and mission.goal_id is not None:
            try:
                if mission.wish:
                    await watch.cancel(mission.goal_id)
                    await asyncio.to_thread(desk.store.clear_wish, mission_id)
                    is_first = True
                if is_first:  # a goal that ended before it was bound is in no later change
                    await watch.reconcile(mission)
                    is_first = False
                    continue
            except (RobotAway, RobotBusy, RobotRefusal) as trouble:
                log.info("%s: %s", mission.robot, trouble)
                wait_s = 1.0
        elif mission.wish or is_first:
            wait_s = 1.0
        await desk.wait_for(mission_id, wait_s)


async def _tell(mission_id: str) -> str:
    """End the mission as its goal ended, and let the robot take the next."""
    desk = _desks[0]
    mission = await asyncio.to_thread(desk.store.mission, mission_id)
    state = mission.goal_state if mission.goal_state in GOAL_ENDED else None
    if not mission.is_over and state is not None:
        mission = await asyncio.to_thread(desk.store.end, mission_id, state, mission.reason)
    desk.wake([mission_id])
    return mission.state


async def sweep(desk: MissionDesk) -> None:
    """Begin missions at work again that stand still, until cancelled. Raises SQLAlchemyError."""
    idle_since: dict[str, float] = {}
    while True:
        await asyncio.sleep(SWEEP_S)
        rows = await asyncio.to_thread(desk.store.at_work)
        idle = {row.id: row for row in rows if row.id not in desk.running}
        idle_since = {each: idle_since.get(each, time.monotonic()) for each in idle}
        for mission_id, since_s in list(idle_since.items()):
            if time.monotonic() - since_s >= STANDS_STILL_S:
                await _begin_again(desk, idle[mission_id])
                del idle_since[mission_id]


async def _begin_again(desk: MissionDesk, mission: MissionRow) -> None:
    status = await DBOS.get_workflow_status_async(_workflow_id(mission))
    desk.swept += 1
    log.warning("mission %s stood still (%s)", mission.id, status.status if status else "unbegun")
    if status is not None:
        await DBOS.cancel_workflow_async(_workflow_id(mission))
        attempt = mission.attempt + 1
        await asyncio.to_thread(desk.store.change, mission.id, attempt=attempt)
        mission = await asyncio.to_thread(desk.store.mission, mission.id)
    await begin(mission)
