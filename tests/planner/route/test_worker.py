"""Kill, freeze and mislead the route process; the caller gets a route or a typed failure."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager
from pathlib import Path

import psutil
import pytest

from planner.route import RouteFailure, RouteLimits, RouteRequest, RouteWorker
from planner.route.child import NICE
from planner.world import Site

LIMIT_S = 30.0


@asynccontextmanager
async def running(site: Site) -> AsyncIterator[RouteWorker]:
    worker = RouteWorker(site.folder, site.map_id, RouteLimits())
    await worker.start()
    try:
        yield worker
    finally:
        await worker.close()


def across(site: Site) -> RouteRequest:
    return RouteRequest(site.places[0].pose, site.places[1].pose)


def pid(worker: RouteWorker) -> int:
    assert worker.pid is not None
    return worker.pid


async def code_of(asked: Awaitable[object]) -> str:
    with pytest.raises(RouteFailure) as caught:
        await asked
    return caught.value.code


def run(story: Callable[[], Awaitable[None]], loop: asyncio.Runner | None = None) -> None:
    async def bounded() -> None:
        async with asyncio.timeout(LIMIT_S):
            await story()

    if loop is None:
        asyncio.run(bounded())
    else:
        loop.run(bounded())


@pytest.fixture(scope="module")
def loop() -> Iterator[asyncio.Runner]:
    with asyncio.Runner() as runner:
        yield runner


@pytest.fixture(scope="module")
def worker(loop: asyncio.Runner, two_room: Site) -> Iterator[RouteWorker]:
    """Start one worker, a second of a processor, for all who leave its process as it is."""
    made = RouteWorker(two_room.folder, two_room.map_id, RouteLimits())
    loop.run(made.start())
    yield made
    loop.run(made.close())


def test_a_route_comes_from_another_process_that_yields_to_us(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        result = await worker.route(across(two_room))
        assert len(result.points) > 10
        child = psutil.Process(pid(worker))
        assert child.pid != os.getpid()
        assert child.nice() >= NICE

    run(story, loop)


def test_many_at_once_are_each_answered_with_their_own(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        goals = [place.pose for place in two_room.places]
        start = two_room.home.pose
        asked = [worker.route(RouteRequest(start, goal)) for goal in goals * 3]
        for goal, result in zip(goals * 3, await asyncio.gather(*asked), strict=True):
            end = result.points[-1]
            assert (end.x_m, end.y_m) == (goal.x_m, goal.y_m)

    run(story, loop)


def test_a_failure_to_find_a_way_is_typed_and_the_process_lives(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        first, request = pid(worker), across(two_room)
        far = RouteRequest(request.start, type(request.goal)(99.0, 0.0, 0.0))
        assert await code_of(worker.route(far)) == "goal_outside_map"
        await worker.route(request)
        assert pid(worker) == first

    run(story, loop)


def test_killed_in_the_middle_of_a_request_or_frozen_it_fails_typed_and_comes_back(
    two_room: Site,
) -> None:
    async def story() -> None:
        async with running(two_room) as worker:
            first = pid(worker)
            os.kill(first, signal.SIGSTOP)  # so that the request is surely unanswered
            asked = asyncio.create_task(worker.route(across(two_room)))
            await asyncio.sleep(0)
            os.kill(first, signal.SIGKILL)
            assert await code_of(asked) == "route_worker_died"
            result = await worker.route(across(two_room), timeout_s=LIMIT_S)
            assert len(result.points) > 10
            second = pid(worker)
            assert second != first

            os.kill(second, signal.SIGSTOP)
            assert await code_of(worker.route(across(two_room), 0.05)) == "route_timed_out"
            await worker.route(across(two_room), timeout_s=LIMIT_S)
            assert not psutil.pid_exists(second)

    run(story)


def test_who_gives_up_waiting_leaves_the_next_answer_whole(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        first = pid(worker)
        os.kill(first, signal.SIGSTOP)
        try:
            asked = asyncio.create_task(worker.route(across(two_room)))
            await asyncio.sleep(0)
            asked.cancel()
            with pytest.raises(asyncio.CancelledError):
                await asked
        finally:
            os.kill(first, signal.SIGCONT)
        home = two_room.home.pose
        result = await worker.route(RouteRequest(home, home))
        assert len(result.points) == 1
        assert pid(worker) == first

    run(story, loop)


def test_a_number_that_is_not_finite_is_refused_before_it_leaves(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    async def story() -> None:
        request = across(two_room)
        nowhere = type(request.goal)(float("nan"), 0.0, 0.0)
        asked = worker.route(RouteRequest(request.start, nowhere))
        assert await code_of(asked) == "route_request_malformed"

    run(story, loop)


def test_a_site_that_cannot_be_loaded_is_refused_at_start(tmp_path: Path) -> None:
    async def story() -> None:
        worker = RouteWorker(tmp_path, "0" * 16, RouteLimits())
        assert await code_of(worker.start()) == "route_worker_unavailable"
        assert worker.pid is None

    run(story)


def test_a_site_that_changed_since_the_planner_loaded_it_is_refused(two_room: Site) -> None:
    async def story() -> None:
        worker = RouteWorker(two_room.folder, "0" * 16, RouteLimits())
        with pytest.raises(RouteFailure, match=two_room.map_id) as caught:
            await worker.start()
        assert caught.value.code == "route_worker_unavailable"

    run(story)


def test_it_answers_nothing_before_its_start_and_after_its_end(two_room: Site) -> None:
    async def story() -> None:
        worker = RouteWorker(two_room.folder, two_room.map_id, RouteLimits())
        assert await code_of(worker.route(across(two_room))) == "route_worker_unavailable"
        await worker.start()
        child = pid(worker)
        await worker.close()
        await worker.close()
        assert not psutil.pid_exists(child)
        assert await code_of(worker.route(across(two_room))) == "route_worker_unavailable"

    run(story)


PARENT = """
import asyncio, sys
from pathlib import Path
from planner.route import RouteLimits, RouteWorker

async def main():
    worker = RouteWorker(Path(sys.argv[1]), sys.argv[2], RouteLimits())
    await worker.start()
    print(worker.pid, flush=True)
    await asyncio.sleep(60)

asyncio.run(main())
"""


def test_it_dies_with_a_planner_that_is_killed(two_room: Site) -> None:
    arguments = [sys.executable, "-c", PARENT, str(two_room.folder), two_room.map_id]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as parent:
        try:
            assert parent.stdout is not None
            child = int(parent.stdout.readline())
            assert psutil.pid_exists(child)
        finally:
            parent.kill()
    until_s = time.monotonic() + 5.0
    while psutil.pid_exists(child) and time.monotonic() < until_s:
        time.sleep(0.01)
    assert not psutil.pid_exists(child)


def test_the_planners_own_process_loads_no_array_library() -> None:
    code = "import sys, planner.route, planner.world; print('numpy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True, timeout=LIMIT_S
    )
    assert done.stdout.strip() == "False"
