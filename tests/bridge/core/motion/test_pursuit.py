"""Drive paths by pursuit, late as a real drive is, and hold it to where it arrives."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, pi, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import along_arc
from bridge.core.geometry.path_profile import prepare
from bridge.core.motion.limiter import shape
from bridge.core.motion.pursuit import PursuitCommand, carry_over, follow
from bridge.core.state_motion import NEW, FollowState, LimiterState
from wire import STILL, Pose2, Twist2, Waypoint
from wire.robot import Base, Limits

BASE, LIMITS, LAG = Base(), Limits(), 0.06
Corners = list[tuple[float, float]]


def route(corners: Corners, speed: float = 0.5, heading: float | None = None) -> list[Waypoint]:
    """Return points 0.1 m apart along straight lines."""
    places: Corners = []
    for (xa, ya), (xb, yb) in pairwise(corners):
        steps = max(1, round(hypot(xb - xa, yb - ya) / 0.1))
        places += [(xa + (xb - xa) * i / steps, ya + (yb - ya) * i / steps) for i in range(steps)]
    places.append(corners[-1])
    last = len(places) - 1
    return [
        Waypoint(x_m=x, y_m=y, speed_mps=speed, heading_rad=heading if i == last else None)
        for i, (x, y) in enumerate(places)
    ]


Piece = tuple[float, float, float, float]
"""Where a straight piece of a route begins, and how far it goes in x and y [m]."""


def pieces(points: list[Waypoint]) -> list[Piece]:
    return [(a.x_m, a.y_m, b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(points)]


def beside(route: list[Piece], x: float, y: float) -> float:
    """Return how far a place is from a route."""
    best = 1e9
    for ax, ay, dx, dy in route:
        px, py = x - ax, y - ay
        on = (px * dx + py * dy) / (dx * dx + dy * dy)
        if on >= 1.0:
            px, py = px - dx, py - dy
        elif on > 0.0:
            px, py = px - on * dx, py - on * dy
        best = min(best, px * px + py * py)
    return sqrt(best)


@dataclass
class Drive:
    """Hold what a simulated drive came to."""

    pose: Pose2
    last: PursuitCommand
    seconds: float
    strayed_m: float
    fastest_mps: float
    turned_rad: float


def drive(
    points: list[Waypoint], pose: Pose2, *, cut_every: int = 0, limit_s: float = 60.0
) -> Drive:
    """Follow on a robot that answers 60 ms late, optionally with a new horizon every few ticks."""
    state, path = NEW, prepare(points, LIMITS)
    memory, pipe = LimiterState(), deque([STILL] * round(LAG / 0.01))
    strayed = fastest = turned = 0.0
    way = pieces(points)
    answer = follow(state, path, pose, STILL, BASE, LIMITS, LAG)
    for tick in range(round(limit_s / 0.01)):
        if cut_every and tick and tick % cut_every == 0:
            near = min(
                range(len(points)),
                key=lambda i: hypot(points[i].x_m - pose.x_m, points[i].y_m - pose.y_m),
            )
            points = points[near:]
            way = pieces(points)
            state, path = carry_over(state), prepare(points, LIMITS)
        answer = follow(state, path, pose, memory.sent, BASE, LIMITS, LAG)
        state = answer.state
        memory = shape(answer.target, memory, BASE, LIMITS, 0.01)
        pipe.append(memory.sent)
        moving = pipe.popleft()
        pose = along_arc(pose, moving.v_mps * 0.01, moving.w_radps * 0.01)
        if len(points) > 1:
            strayed = max(strayed, beside(way, pose.x_m, pose.y_m))
        fastest, turned = max(fastest, abs(moving.v_mps)), turned + abs(moving.w_radps) * 0.01
        if answer.at_end and memory.sent == STILL and moving == STILL:
            return Drive(pose, answer, tick * 0.01, strayed, fastest, turned)
    return Drive(pose, answer, limit_s, strayed, fastest, turned)


STRAIGHT: Corners = [(0, 0), (2, 0)]
CORNER: Corners = [(0, 0), (1, 0), (1, 1)]
U_TURN: Corners = [(0, 0), (1, 0), (1, 0.4), (0, 0.4)]
ZIGZAG: Corners = [(0, 0), (0.8, 0), (1.2, 0.6), (2, 0.6)]


@pytest.mark.parametrize(("speed", "cut_every"), [(0.5, 0), (0.5, 10), (0.2, 10), (-0.3, 0)])
@pytest.mark.parametrize("corners", [STRAIGHT, CORNER, U_TURN, ZIGZAG])
def test_it_arrives_and_stays_near(corners: Corners, speed: float, cut_every: int) -> None:
    start = Pose2(0.0, 0.0, 0.0 if speed > 0 else pi)
    done = drive(route(corners, speed), start, cut_every=cut_every)
    assert done.last.at_end
    assert done.last.residual_m <= 0.05
    assert done.strayed_m <= 0.15 if not cut_every else done.strayed_m <= 0.2
    assert done.fastest_mps <= abs(speed) + 1e-9


@settings(max_examples=12, deadline=None)
@given(
    st.sampled_from([STRAIGHT, CORNER, U_TURN, ZIGZAG]),
    st.floats(-pi, pi),
    st.floats(-0.12, 0.12),
    st.sampled_from([None, 0.0, 2.0, pi, -pi / 2]),
)
def test_it_arrives_from_any_heading(
    corners: Corners, yaw: float, y: float, heading: float | None
) -> None:
    done = drive(route(corners, 0.5, heading), Pose2(0.0, y, yaw))
    assert done.last.at_end
    assert done.strayed_m <= 0.15
    if heading is not None:
        assert done.last.residual_rad <= 0.1


def test_a_missed_end_is_made_good_not_orbited() -> None:
    # 0.3 m beside the end of a short path, pointing along it: a pursuit alone would circle.
    done = drive(route([(0, 0), (0.3, 0)]), Pose2(0.35, 0.3, 0.0))
    assert done.last.at_end
    assert done.turned_rad < 2 * pi
    assert done.seconds < 15.0


def test_a_single_point_is_driven_to() -> None:
    done = drive(route(STRAIGHT)[:1], Pose2(-0.3, 0.2, 0.0))
    assert done.last.at_end
    assert done.last.residual_m <= 0.05


def test_the_start_of_a_loop_is_not_its_end() -> None:
    # nav2's goal checker: start and end 1 cm apart, the whole loop still to go.
    loop = route([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0.01)])
    answer = follow(NEW, prepare(loop, LIMITS), Pose2(0.0, 0.0, 0.0), STILL, BASE, LIMITS, LAG)
    assert not answer.at_end
    assert answer.residual_m > 3.9


def test_progress_never_falls() -> None:
    path = prepare(route(STRAIGHT), LIMITS)
    state = follow(NEW, path, Pose2(0.45, 0, 0), STILL, BASE, LIMITS, LAG).state
    back = follow(state, path, Pose2(0.1, 0, 0), STILL, BASE, LIMITS, LAG).state
    assert back.along_m == state.along_m == pytest.approx(0.45)


def test_a_path_without_points_asks_for_standstill() -> None:
    answer = follow(NEW, prepare((), LIMITS), Pose2(0, 0, 0), STILL, BASE, LIMITS, LAG)
    assert answer.target == STILL
    assert not answer.at_end


wild = st.builds(Twist2, st.floats(), st.floats())
states = st.builds(
    FollowState, st.floats(0, 9), st.booleans(), st.booleans(), st.booleans(), st.integers(0, 5)
)


@given(states, st.builds(Pose2, st.floats(), st.floats(), st.floats()), wild)
def test_no_number_raises_or_asks_too_much(state: FollowState, pose: Pose2, sent: Twist2) -> None:
    path = prepare(route(U_TURN, 0.5, 1.0), LIMITS)
    answer = follow(state, path, pose, sent, BASE, LIMITS, LAG)
    assert abs(answer.target.v_mps) <= 0.5
    assert abs(answer.target.w_radps) <= 1.0
    adapter = TypeAdapter(FollowState)
    assert adapter.validate_json(adapter.dump_json(answer.state)) == answer.state
