"""Hold the frames between planner and route process to a round trip."""

from __future__ import annotations

from dataclasses import asdict

from hypothesis import given
from hypothesis import strategies as st

from planner.navigation import RouteLimits, RoutePoint, RouteRequest, RouteResult
from planner.navigation.ipc import limits_text, read_limits, read_request, read_result, result_frame
from processes.worker_protocol import HEADER, Frame, pack, read_lengths, unpack
from wire import Pose2, RobotDescription

numbers = st.floats(-1e4, 1e4)
poses = st.builds(Pose2, numbers, numbers, st.floats(-6, 6))
requests = st.builds(
    RouteRequest,
    *(poses, poses, st.lists(st.tuples(numbers, numbers), max_size=5).map(tuple)),
    st.booleans(),
)
results = st.builds(
    RouteResult,
    points=st.lists(st.builds(RoutePoint, numbers, numbers, numbers), max_size=5).map(tuple),
    length_m=numbers,
    moved_goal_m=numbers,
    start_escaped=st.booleans(),
    took_s=numbers,
)


def sent(frame: Frame) -> Frame:
    """Return a frame as it comes out of a pipe."""
    packed = pack(*frame)
    text, _ = read_lengths(packed[: HEADER.size])
    return unpack(packed[HEADER.size : HEADER.size + text]), packed[HEADER.size + text :]


@given(requests)
def test_a_request_comes_back_as_it_was(request: RouteRequest) -> None:
    assert read_request(sent((asdict(request), b""))) == request


@given(results)
def test_a_result_comes_back_as_it_was(result: RouteResult) -> None:
    assert read_result(sent(result_frame(result))) == result


def test_limits_come_from_the_robots_description() -> None:
    robot = RobotDescription()
    limits = RouteLimits.of(robot)
    assert limits.max_speed_mps == robot.limits.max_speed_mps
    assert limits.radius_m == robot.base.radius_m
    assert read_limits(limits_text(limits)) == limits
