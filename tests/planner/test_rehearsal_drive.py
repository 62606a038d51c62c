"""One plan is driven in the simulator at a time, in a process that ends with it, or with us."""

from __future__ import annotations

import asyncio
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from maps.growing_map import GROWING_MAP
from planner.driven_rehearsal import LeftOut
from planner.mission.state import MissionState
from planner.plan import (
    Find,
    GoTo,
    PlanRecord,
    Repeat,
    ReturnHome,
    Step,
    StepPlan,
    Wait,
    plan_record,
)
from planner.rehearsal import RehearsalError, Rehearser
from planner.rehearsal_drive import RehearsalDrives
from planner.site import KnownPlaces
from tests.planner.api.fakes import StraightRoutes, two_room
from tests.processes.small_worker import LIMIT_S
from tests.wire.examples import STATUS
from wire import Pose2, RobotDescription, Status

AT_HERE = STATUS.model_copy(update={"base_in_map": Pose2(2.0, 1.0, 0.0)})
WAITS = GoTo(place="living_room")
"""The small process tells of it, and then waits to be killed."""


@asynccontextmanager
async def drives_of(status: Status | None = AT_HERE) -> AsyncIterator[RehearsalDrives]:
    site = KnownPlaces(two_room())
    book = MissionState(site.facts, status=status)
    rehearser = Rehearser(site, RobotDescription(), StraightRoutes(), lambda: book)
    drives = RehearsalDrives(
        rehearser, site, RobotDescription(), module="tests.planner.small_rehearsal"
    )
    try:
        yield drives
    finally:
        await drives.close()


def plan(*steps: Step) -> PlanRecord:
    return plan_record(StepPlan(steps=steps))


async def until(drives: RehearsalDrives, *, seconds: float = 0.0, state: str = "") -> None:
    async with asyncio.timeout(LIMIT_S):
        while not has_come(drives, seconds, state):  # noqa: ASYNC110  # it is polled, as by a page
            await asyncio.sleep(0.02)


def has_come(drives: RehearsalDrives, seconds: float, state: str) -> bool:
    newest = drives.newest
    return newest is not None and newest.driven.seconds >= seconds and state in newest.state


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


async def test_it_is_told_step_by_step_and_is_over_with_its_process() -> None:
    async with drives_of() as drives:
        begun = await drives.of_plan(plan(Wait(seconds=1.0), Find(object="cup"), ReturnHome()))
        assert (begun.state, begun.map_id) == ("running", two_room().map_id)
        assert [s.outcome for s in begun.driven.steps] == ["pending", "left_out", "pending"]
        await until(drives, state="done")
        newest = drives.newest
        assert newest is not None
        assert [s.outcome for s in newest.driven.steps] == ["running", "left_out", "running"]
        assert LeftOut.PICTURES in newest.left_out
        assert 0.0 <= newest.took_s < 60.0  # told to a tenth of a second
        assert '"end":{"x_m":1.0' in newest.model_dump_json(), "as the API tells it"
        assert not drives.is_busy


async def test_a_second_one_is_refused_while_one_runs_and_taken_after_it_was_cancelled() -> None:
    async with drives_of() as drives:
        await drives.of_plan(plan(WAITS))
        await until(drives, seconds=9.0)
        with pytest.raises(RehearsalError, match="rehearsal_running"):
            await drives.of_text("go home")
        cancelled = await drives.cancel()
        assert cancelled is not None
        assert (cancelled.state, cancelled.driven.length_m) == ("cancelled", 1.0)
        await drives.of_plan(plan(Wait(seconds=1.0)))
        await until(drives, state="done")


async def test_two_at_once_are_one_and_a_refusal() -> None:
    async with drives_of() as drives:
        both = await asyncio.gather(
            *(drives.of_plan(plan(WAITS)) for _ in range(2)), return_exceptions=True
        )
        assert sorted(type(one).__name__ for one in both) == ["DrivenRehearsal", "RehearsalError"]


async def test_no_process_is_left_when_the_planner_closes() -> None:
    async with drives_of() as drives:
        await drives.of_plan(plan(WAITS))
        await until(drives, seconds=9.0)
        pid = drives.pid
        assert pid is not None
    assert not is_alive(pid)


async def test_a_process_that_dies_is_told_and_another_may_begin() -> None:
    async with drives_of() as drives:
        await drives.of_plan(plan(ReturnHome()))
        await until(drives, state="failed")
        assert drives.newest is not None
        assert drives.newest.code == "rehearsal_died"
        assert drives.newest.message is not None
        assert not drives.is_busy


async def test_what_has_nothing_to_drive_and_where_nobody_knows_is_refused() -> None:
    async with drives_of() as drives:
        with pytest.raises(RehearsalError, match="rehearsal_no_plan"):
            await drives.of_plan(plan(Find(object="cup")))
        with pytest.raises(RehearsalError, match="rehearsal_no_plan"):
            await drives.of_text("hello")
        assert drives.newest is None
    async with drives_of(None) as lost:
        with pytest.raises(RehearsalError, match="rehearsal_without_pose"):
            await lost.of_text("go home")


async def test_what_repeats_for_ever_is_driven_once() -> None:
    async with drives_of() as drives:
        begun = await drives.of_plan(plan(Repeat(steps=(Wait(seconds=1.0),), times=20)))
        assert len(begun.driven.steps) == 1
        assert LeftOut.ROUNDS in begun.left_out


async def test_a_map_that_is_being_made_is_not_driven_on(tmp_path: Path) -> None:
    (tmp_path / GROWING_MAP).write_bytes(b"")
    async with drives_of() as drives:
        drives._site.site = replace(drives._site.site, folder=tmp_path)
        with pytest.raises(RehearsalError, match="rehearsal_map_grows"):
            await drives.of_plan(plan(WAITS))
