"""Ask the route process for ways, and hold what becomes of it to the codes of the route search."""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from planner.navigation import RouteFailure, RouteLimits, RouteRequest, RouteWorker
from planner.site import Site
from processes.parent_death import WORKER_NICE
from tests.processes.small_worker import LIMIT_S, code_of, pid_of, story

pytestmark = pytest.mark.nightly(keep=3)


def across(site: Site) -> RouteRequest:
    return RouteRequest(site.places[0].pose, site.places[1].pose)


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


@story
async def test_routes_come_from_another_process_that_yields_to_us(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    goals = [place.pose for place in two_room.places]
    start = two_room.home.pose
    asked = [worker.route(RouteRequest(start, goal)) for goal in goals]
    for goal, result in zip(goals, await asyncio.gather(*asked), strict=True):
        end = result.points[-1]
        assert (end.x_m, end.y_m) == (goal.x_m, goal.y_m)
    child = psutil.Process(pid_of(worker))
    assert child.pid != os.getpid()
    assert child.nice() >= WORKER_NICE


@story
async def test_a_failure_to_find_a_way_is_typed_and_the_process_lives(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    first, request = pid_of(worker), across(two_room)
    far = RouteRequest(request.start, type(request.goal)(99.0, 0.0, 0.0))
    assert await code_of(worker.route(far)) == "goal_outside_map"
    await worker.route(request)
    assert pid_of(worker) == first


@story
async def test_frozen_it_fails_whoever_asked_and_comes_back(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    first = pid_of(worker)
    os.kill(first, signal.SIGSTOP)
    beside = asyncio.create_task(worker.route(across(two_room), LIMIT_S))
    assert await code_of(worker.route(across(two_room), 0.05)) == "route_timed_out"
    assert await code_of(worker.route(across(two_room), 0.0)) == "route_worker_unavailable"
    assert await code_of(beside) == "route_worker_died"
    assert len((await worker.route(across(two_room), LIMIT_S)).points) > 10
    assert pid_of(worker) != first


@story
async def test_a_number_that_is_not_finite_is_refused_before_it_leaves(
    two_room: Site, worker: RouteWorker, loop: asyncio.Runner
) -> None:
    request = across(two_room)
    nowhere = type(request.goal)(float("nan"), 0.0, 0.0)
    asked = worker.route(RouteRequest(request.start, nowhere))
    assert await code_of(asked) == "route_request_malformed"


@pytest.mark.parametrize("found", [True, False])
@story
async def test_a_site_that_is_not_the_planners_own_is_refused(
    two_room: Site, tmp_path: Path, found: bool
) -> None:
    worker = RouteWorker(two_room.folder if found else tmp_path, "0" * 16, RouteLimits())
    with pytest.raises(RouteFailure, match=two_room.map_id if found else str(tmp_path)) as caught:
        await worker.start()
    assert caught.value.code == "route_worker_unavailable"
    assert worker.pid is None


@story
async def test_what_is_not_up_in_time_is_not_started_any_more(two_room: Site) -> None:
    before = psutil.Process().children()
    worker = RouteWorker(two_room.folder, two_room.map_id, RouteLimits())
    assert await code_of(worker.start(0.001)) == "route_worker_unavailable"
    assert psutil.Process().children() == before
    assert await code_of(worker.route(across(two_room))) == "route_worker_unavailable"
