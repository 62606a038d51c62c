"""Hold the frames between planner and route process to a round trip."""

from __future__ import annotations

from dataclasses import asdict

from hypothesis import given
from hypothesis import strategies as st

from planner.navigation import (
    FloorReport,
    Mover,
    ObstacleReport,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
    RouteSurvey,
    ScanObservation,
)
from planner.navigation.ipc import (
    is_observation,
    limits_text,
    read_limits,
    read_observation,
    read_report,
    read_request,
    read_result,
    report_frame,
    result_frame,
)
from processes.worker_protocol import HEADER, Frame, pack, read_lengths, unpack
from wire import Pose2, RobotDescription

numbers = st.floats(-1e4, 1e4)
poses = st.builds(Pose2, numbers, numbers, st.floats(-6, 6))
requests = st.builds(
    RouteRequest,
    *(poses, poses, st.lists(st.tuples(numbers, numbers), max_size=5).map(tuple)),
    *(st.booleans() for _ in range(4)),
)
results = st.builds(
    RouteResult,
    points=st.lists(st.builds(RoutePoint, numbers, numbers, numbers), max_size=5).map(tuple),
    length_m=numbers,
    moved_goal_m=numbers,
    start_escaped=st.booleans(),
    took_s=numbers,
    floor=st.none() | st.builds(FloorReport, numbers, st.booleans()),
    survey=st.sampled_from(
        [None, RouteSurvey(None, None, 0.0), RouteSurvey(0.84, (1.0, 2.0), 0.3, hoped=True)]
    ),
)
observations = st.builds(
    ScanObservation,
    *(poses, poses, numbers, numbers, numbers),
    st.lists(st.none() | st.floats(0, 30), max_size=8).map(tuple),
    numbers,
    st.lists(st.tuples(numbers, numbers), max_size=5).map(tuple),
)
reports = st.builds(
    ObstacleReport,
    version=st.integers(0, 10**6),
    blocked_ahead_m=st.none() | numbers,
    movers=st.lists(st.builds(Mover, st.integers(1, 99), *(numbers,) * 5), max_size=3).map(tuple),
    cells=st.binary(max_size=40),
    suspicions=st.binary(max_size=40),
)


def sent(frame: Frame) -> Frame:
    """Return a frame as it comes out of a pipe."""
    packed = pack(*frame)
    text, _ = read_lengths(packed[: HEADER.size])
    return unpack(packed[HEADER.size : HEADER.size + text]), packed[HEADER.size + text :]


@given(requests)
def test_a_request_comes_back_as_it_was_and_is_no_observation(request: RouteRequest) -> None:
    frame = sent((asdict(request), b""))
    assert read_request(frame) == request
    assert not is_observation(frame)


@given(results)
def test_a_result_comes_back_as_it_was(result: RouteResult) -> None:
    assert read_result(sent(result_frame(result))) == result


def test_limits_come_from_the_robots_description() -> None:
    robot = RobotDescription()
    limits = RouteLimits.of(robot)
    assert limits.max_speed_mps == robot.limits.max_speed_mps
    assert limits.radius_m == robot.base.radius_m
    assert read_limits(limits_text(limits)) == limits


@given(observations)
def test_an_observation_comes_back_as_it_was(seen: ScanObservation) -> None:
    frame = sent((asdict(seen), b""))
    assert is_observation(frame)
    assert read_observation(frame) == seen


@given(reports)
def test_a_report_comes_back_as_it_was(report: ObstacleReport) -> None:
    assert read_report(sent(report_frame(report))) == report
