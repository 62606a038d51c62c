"""Hold the frames between planner and route process to a round trip, and to clear refusals."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.route import RouteFailure, RouteLimits, RoutePoint, RouteRequest, RouteResult
from planner.route.frames import (
    HEADER,
    MAX_FRAME_BYTES,
    body_length,
    limits_text,
    pack_failure,
    pack_request,
    pack_result,
    read_answer,
    read_limits,
    read_request,
    unpack,
)
from planner.route.request import REASONS
from wire import Pose2, RobotDescription

numbers = st.floats(-1e4, 1e4)
poses = st.builds(Pose2, numbers, numbers, st.floats(-6, 6))
requests = st.builds(
    RouteRequest, poses, poses, st.lists(st.tuples(numbers, numbers), max_size=5).map(tuple)
)
results = st.builds(
    RouteResult,
    points=st.lists(st.builds(RoutePoint, numbers, numbers, numbers), max_size=5).map(tuple),
    length_m=numbers,
    moved_goal_m=numbers,
    start_escaped=st.booleans(),
    took_s=numbers,
)


def body(frame: bytes) -> bytes:
    length = body_length(frame[: HEADER.size])
    assert len(frame) == HEADER.size + length
    return frame[HEADER.size :]


@given(st.integers(0, 2**53), requests)
def test_a_request_comes_back_as_it_was(number: int, request: RouteRequest) -> None:
    assert read_request(unpack(body(pack_request(number, request)))) == (number, request)


@given(results)
def test_a_result_comes_back_as_it_was(result: RouteResult) -> None:
    message = unpack(body(pack_result(7, result)))
    assert message["number"] == 7
    assert read_answer(message) == result


@pytest.mark.parametrize("code", REASONS)
def test_a_failure_comes_back_with_its_sentence_in_both_languages(code: str) -> None:
    message = unpack(body(pack_failure(7, RouteFailure(code, "a detail"))))
    with pytest.raises(RouteFailure) as caught:
        read_answer(message)
    assert caught.value.code == code
    assert "a detail" in caught.value.message["en"]
    assert "a detail" in caught.value.message["zh"]


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_a_number_that_is_not_finite_never_leaves(bad: float) -> None:
    with pytest.raises(RouteFailure) as caught:
        pack_request(1, RouteRequest(Pose2(bad, 0, 0), Pose2(0, 0, 0)))
    assert caught.value.code == "route_request_malformed"


def test_a_frame_out_of_step_is_refused() -> None:
    with pytest.raises(ValueError, match=str(MAX_FRAME_BYTES)):
        body_length(b"\xff\xff\xff\xff")
    with pytest.raises(ValueError, match="list"):
        unpack(b"[]")


def test_limits_come_from_the_robots_description() -> None:
    robot = RobotDescription()
    limits = RouteLimits.of(robot)
    assert limits.max_speed_mps == robot.limits.max_speed_mps
    assert limits.radius_m == robot.base.radius_m
    assert read_limits(limits_text(limits)) == limits
