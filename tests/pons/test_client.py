"""The client of Python programs uses the planner's own routes, and costs ``pons stop`` nothing."""

from __future__ import annotations

import subprocess
import sys
from typing import cast

import httpx
import pytest

import pons
from pons import Robot, RobotError, RobotUnreachable
from tests.planner.api.fakes import FakeServices
from tests.planner.api.served import client_of


@pytest.fixture
def services() -> FakeServices:
    return FakeServices()


def sending(services: FakeServices) -> httpx.Client:
    """Return a client of these routes: starlette's is one of httpx2 where that is installed."""
    return cast("httpx.Client", client_of(services))


@pytest.fixture
def robot(services: FakeServices) -> Robot:
    return Robot(client=sending(services), sleep=lambda _: None)


def test_an_order_is_given_and_followed(robot: Robot) -> None:
    given = robot.say("go to the kitchen")
    assert given.text == "go to the kitchen"
    assert not given.has_ended
    assert robot.goal(given) == robot.goal(given.id)


def test_waiting_ends_with_the_time(services: FakeServices) -> None:
    seconds = iter(range(100))
    robot = Robot(client=sending(services), clock=lambda: next(seconds), sleep=lambda _: None)
    given = robot.say("go to the kitchen")
    assert robot.wait(given, limit_s=3.0).id == given.id


def test_it_stops_and_tells_where_the_robot_is(robot: Robot, services: FakeServices) -> None:
    assert robot.stop() in (True, False)
    status = robot.status()
    assert status.mode == services.robot.status.mode.value  # type: ignore[union-attr]
    names = {place.id for place in robot.places()}
    assert names == set(services.memory.vocabulary.by_id)


def test_a_refusal_has_its_code_in_both_languages(robot: Robot) -> None:
    with pytest.raises(RobotError, match="unknown_goal") as refused:
        robot.goal("nosuch")
    assert refused.value.code == "unknown_goal"
    assert refused.value.en
    assert refused.value.zh


def test_silence_is_told() -> None:
    def fail(request: httpx.Request) -> httpx.Response:
        raise httpx.ConnectError("refused", request=request)

    client = httpx.Client(transport=httpx.MockTransport(fail), base_url="http://robot")
    with Robot(client=client) as robot, pytest.raises(RobotUnreachable, match="planner_down"):
        robot.stop()


def test_the_package_loads_the_client_for_its_users_alone() -> None:
    light = (
        "import sys, pons, pons.stop; print(*{'httpx', 'pons.client', 'pydantic'} & {*sys.modules})"
    )
    ran = subprocess.run([sys.executable, "-c", light], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == []
    with pytest.raises(AttributeError, match="nothing_there"):
        pons.nothing_there  # noqa: B018
