"""Drive paths by pursuit, late as a real drive is, and hold it to where it arrives."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, hypot, inf, nan, pi, sin, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import along_arc
from bridge.core.geometry.path_profile import Path, prepare, residuals
from bridge.core.motion import pursuit
from bridge.core.motion.limiter import shape
from bridge.core.motion.pursuit import PursuitCommand, carry_over, follow
from bridge.core.state_motion import NEW, FollowState, LimiterState
from tests.bridge.core.table import table
from wire import STILL, Pose2, Twist2, Waypoint
from wire.geometry import MAX_COORDINATE_M
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


BASE, BRAKES, LAG_S = Base(), Limits(max_decel_mps2=0.8), 0.06
LATE_S = LAG_S + 0.8 / 20 + 0.02
"""Lag, the time that the jerk limit takes, and a tick."""
DECEL = 0.56
"""m/s2: 0.7 of it is planned with."""
EPS = 1e-9


def path_of(*places: tuple[float, float], speed: float = 0.5, heading: float | None = None) -> Path:
    points = [Waypoint(x_m=x, y_m=y, speed_mps=speed) for x, y in places]
    points[-1] = points[-1].model_copy(update={"heading_rad": heading})
    return prepare(points, BRAKES)


AHEAD = path_of(*((i / 10, 0.0) for i in range(21)))
BENT = path_of((0, 0), (0.2, 0), (0.3, 0), (0.3, 0.25), (0.3, 0.3), (0.1, 0.3))
"""0.2 m and 0.1 m along x, 0.25 and 0.05 along y, 0.2 back."""
L_SHAPED = path_of((0, 0), (0.2, 0), (0.2, 0.2))


def settled(tries: int = 0, *, done: bool = False) -> FollowState:
    return FollowState(0.0, False, True, done, tries)


def going(tries: int = 0, *, turning: bool = False) -> FollowState:
    return FollowState(0.0, turning, False, False, tries)


@table(
    ("state", "aside", "ending", "away", "off_rad", "after"),
    [
        (settled(1), 0.0, True, 0.10, 0.5, settled(1)),
        (settled(1), 0.0, True, 0.10 + EPS, 0.5, going(1)),
        (settled(2), 0.0, True, 0.10 + EPS, 0.5, going(2)),
        (settled(1), 0.0, True, 0.30, 0.5, going(1)),
        (settled(1), 0.0, True, 0.30 + EPS, 0.5, going(0)),
        (settled(3), 0.0, True, 0.30, 0.5, settled(3)),
        (settled(3), 0.0, True, 0.30 + EPS, 0.5, going(0)),
        (settled(4), 0.0, True, 0.30, 0.5, settled(4)),
        (settled(), 0.0, True, 0.05, 0.02, settled(done=True)),
        (settled(), 0.0, True, 0.05, 0.02 + EPS, settled()),
        (settled(done=True), 0.0, True, 0.05, 0.06, settled(done=True)),
        (settled(done=True), 0.0, True, 0.05, 0.06 + EPS, settled()),
        (going(), 0.0, True, 0.03, 0.5, settled()),
        (going(2), 0.0, True, 0.03, 0.02, settled(2, done=True)),
        (going(turning=True), 0.5, True, 0.03, 0.5, settled()),
        (going(), 0.0, True, 0.03 + EPS, 0.5, going()),
        (going(), 0.0, False, 0.01, 0.5, going()),
        (going(), 1.05, False, 9.0, 0.5, going()),
        (going(), 1.05 + EPS, False, 9.0, 0.5, going(turning=True)),
        (going(), -1.05 - EPS, False, 9.0, 0.5, going(turning=True)),
        (going(3), 1.05 + EPS, False, 9.0, 0.5, going(3, turning=True)),
        (going(turning=True), 0.15, False, 9.0, 0.5, going()),
        (going(turning=True), 0.15 + EPS, False, 9.0, 0.5, going(turning=True)),
        (going(1, turning=True), -0.15 - EPS, True, 0.05, 0.5, going(1, turning=True)),
        (going(3, turning=True), 0.2, True, 0.2, 0.5, going(3, turning=True)),
        (going(), 1.1, True, 0.07, 0.02, settled(done=True)),
        (going(1), 1.1, True, 0.07, 0.02 + EPS, settled(1)),
        (going(), 1.1, True, 0.07 + EPS, 0.5, going(1, turning=True)),
        (going(2), -1.1, True, 0.2, 0.5, going(3, turning=True)),
        (going(3), 1.1, True, 0.2, 0.01, settled(3, done=True)),
        (going(4), 1.1, True, 0.2, 0.5, settled(4)),
        (going(3), 1.0, True, 0.2, 0.5, going(3)),
    ],
)
def test_it_turns_drives_or_has_settled(
    state: FollowState, aside: float, ending: bool, away: float, off_rad: float, after: FollowState
) -> None:
    view = pursuit._View(0.3, aside, ending, away, 0.3)
    assert pursuit._judge(state, view, 1.5, off_rad) == replace(after, along_m=1.5)


@table(
    ("robot", "along", "aim_m", "aside", "ending", "rest"),
    [
        (Pose2(0, 0, 0), 0.0, 0.25, 0.0, False, 2.0),
        (Pose2(0, 0.25, 0.5), 0.0, 0.25 * sqrt(2), -pi / 4 - 0.5, False, 2.0),
        (Pose2(1.9, 0, 0), 1.9, 0.1, 0.0, False, 0.1),
        (Pose2(1.9, 0.1, 0), 1.949, hypot(0.1, 0.1), -pi / 4, False, 0.051),
        (Pose2(1.9, 0.1, 0), 1.951, hypot(0.1, 0.1), -pi / 4, True, 0.1),
        (Pose2(1.95, 0.0, pi), 1.96, 0.05, -pi, True, 0.0),
        (Pose2(2.1, 0.0, 0.0), 2.0, 0.1, pi, True, 0.0),
    ],
)
def test_what_it_aims_at(
    robot: Pose2, along: float, aim_m: float, aside: float, ending: bool, rest: float
) -> None:
    away = hypot(2.0 - robot.x_m, robot.y_m)
    view = pursuit._view(AHEAD, along, away, robot, STILL)
    assert (view.aim_m, view.rest_m) == pytest.approx((aim_m, rest), abs=1e-9)
    assert cos(view.aside_rad - aside) == pytest.approx(1.0)
    assert (view.ending, view.away_m) == (ending, away)


def test_backwards_it_looks_behind_itself_and_further_when_faster() -> None:
    back = path_of(*((-i / 10, 0.0) for i in range(21)), speed=-0.5)
    view = pursuit._view(back, 0.0, 2.0, Pose2(0.0, 0.0, 0.0), Twist2(-0.5, 0.0))
    assert (view.aim_m, view.aside_rad) == pytest.approx((0.4, 0.0))
    answer = follow(FollowState(), back, Pose2(0.0, 0.0, 0.0), STILL, BASE, BRAKES, LAG_S)
    assert answer.target == Twist2(-0.5, 0.0)
    aside = follow(FollowState(), back, Pose2(0.0, 0.1, 0.0), STILL, BASE, BRAKES, LAG_S)
    assert aside.target.v_mps < 0.0 < aside.target.w_radps


@table(
    ("aim_m", "aside", "rest", "speed", "curve"),
    [
        (0.4, 0.0, 2.0, 0.5, 0.0),
        (0.4, 0.2, 2.0, 0.5 * cos(0.2), 5 * sin(0.2)),
        (0.1, -0.1, 2.0, 0.5 * cos(0.1), -8 * sin(0.1)),
        (0.25, 0.5, 2.0, 0.5 / (4.8 * sin(0.5)) * cos(0.5), 8 * sin(0.5)),
        (0.25, 1.55, 2.0, 0.5 / 4.8 / sin(1.55) * 0.25, 8 * sin(1.55)),
        (0.05, 0.0, 0.05, (sqrt(LATE_S**2 + 0.1 / DECEL) - LATE_S) * DECEL, 0.0),
    ],
)
def test_it_drives_the_circle_to_its_aim(
    aim_m: float, aside: float, rest: float, speed: float, curve: float
) -> None:
    view = pursuit._View(aim_m, aside, False, 2.0, rest)
    twist = pursuit._drive(AHEAD, view, 0.5, BRAKES, LATE_S)
    assert (twist.v_mps, twist.w_radps) == pytest.approx((speed, speed * curve))
    back = replace(AHEAD, backwards=True)
    assert pursuit._drive(back, view, 0.5, BRAKES, LATE_S) == Twist2(-twist.v_mps, twist.w_radps)


@table(
    ("along", "speed"),
    [
        (0.0, 0.3),
        (0.09, sqrt(0.1**2 + 1.12 * 0.01)),
        (0.05, sqrt(0.1**2 + 1.12 * 0.05)),
        (0.1, 0.5),  # its own slow speed is behind it: the faster of two neighbours counts
        (0.15, 0.5),
        (0.25, sqrt(0.2**2 + 1.12 * 0.05)),
        (0.3, 0.4),
        (0.35, 0.4),
        (0.4, 0.4),
        (0.45, 0.4),
    ],
)
def test_the_path_allows_what_brakes_in_time_for_its_next_point(along: float, speed: float) -> None:
    speeds, exits = (0.3, 0.1, 0.5, 0.4, 0.2), (0.3, 0.1, 0.5, 0.2, 0.0)
    zero = (0.0,) * 5
    path = Path(zero, zero, (0.0, 0.1, 0.2, 0.3, 0.4), speeds, exits, False, None)
    assert pursuit._speed(path, along, BRAKES) == pytest.approx(speed)


def test_a_path_of_one_point_allows_its_speed() -> None:
    assert pursuit._speed(path_of((1.0, 0.0), speed=0.3), 0.0, BRAKES) == 0.3


SPIN = 2.24  # rad/s2: 0.56 m/s2 at wheels 0.25 m from the middle
SMALL = SPIN * (sqrt(LATE_S**2 + 2 * 0.1 / SPIN) - LATE_S)


@table(
    ("error", "sent", "w"),
    [
        (0.1, STILL, SMALL),
        (-0.1, STILL, -SMALL),
        (0.1, Twist2(0.1, 0.0), SMALL),
        (0.1, Twist2(-0.1, -1.0), SMALL),
        (0.1, Twist2(0.1 + EPS, 0.0), 0.0),
        (0.1, Twist2(-0.1 - EPS, 0.0), 0.0),
        (0.1, Twist2(nan, 0.0), 0.0),
        (0.0, Twist2(0.0, 0.5), 0.0),
        (1.0, STILL, 1.0),
        (pi - 0.31, Twist2(0.0, -0.5), 1.0),
        (pi - 0.3, Twist2(0.0, -0.5), 1.0),
        (2.9, Twist2(0.0, -0.5), -1.0),
        (2.9, Twist2(0.0, 0.5), 1.0),
        (2.9, STILL, 1.0),
        (-2.8, Twist2(0.0, 0.5), -1.0),
        (-2.9, Twist2(0.0, 0.5), 1.0),
        (-2.9, Twist2(0.0, -0.5), -1.0),
        (-2.9, STILL, -1.0),
    ],
)
def test_it_turns_in_place_and_brakes_in_time(error: float, sent: Twist2, w: float) -> None:
    twist = pursuit._turn(error, sent, BASE, BRAKES, LATE_S)
    assert twist.v_mps == 0.0
    assert twist.w_radps == pytest.approx(w)


@table(
    ("along", "place"),
    [
        (0.0, (0.0, 0.0)),
        (0.05, (0.05, 0.0)),
        (0.2, (0.2, 0.0)),
        (0.28, (0.28, 0.0)),
        (0.4, (0.3, 0.1)),
        (0.575, (0.3, 0.275)),
        (0.65, (0.25, 0.3)),
        (0.8, (0.1, 0.3)),
        (0.9, (0.1, 0.3)),
        (inf, (0.1, 0.3)),
    ],
)
def test_points_along_the_path(along: float, place: tuple[float, float]) -> None:
    assert pursuit._point(BENT, along) == pytest.approx(place)
    assert pursuit._point(L_SHAPED, 0.1) == pytest.approx((0.1, 0.0))
    assert pursuit._point(L_SHAPED, 0.3) == pytest.approx((0.2, 0.1))
    assert pursuit._point(L_SHAPED, inf) == (0.2, 0.2)


@table(
    ("along", "robot", "found"),
    [
        (0.0, (-0.1, 0.02), 0.0),
        (0.0, (0.07, -0.02), 0.07),
        (0.0, (0.25, 0.01), 0.25),
        (0.0, (0.35, -0.05), 0.3),
        (0.0, (0.29, 0.12), 0.42),
        (0.0, (0.31, 0.31), 0.55),
        (0.0, (0.2, 0.28), 0.55),  # the last piece begins 0.6 m along: beyond the window
        (0.11, (0.2, 0.28), 0.7),
        (0.15, (0.2, 0.28), 0.7),
        (0.3, (0.2, -0.01), 0.3),
        (0.3, (0.32, 0.2), 0.5),
        (0.31, (0.25, 0.04), 0.34),  # nearer to what is behind it
        (0.55, (0.05, 0.3), 0.8),
        (0.8, (0.05, 0.3), 0.8),
    ],
)
def test_progress_is_the_nearest_place_of_what_lies_ahead(
    along: float, robot: tuple[float, float], found: float
) -> None:
    here = Pose2(*robot, 0.0)
    assert max(along, pursuit._progress(BENT, along, here)) == pytest.approx(found)


def test_of_two_places_as_near_the_first_counts_and_no_length_is_no_piece() -> None:
    there_and_back = path_of((0, 0), (0.2, 0), (0.2, 0), (0.0, 0.0))
    assert pursuit._progress(there_and_back, 0.0, Pose2(0.1, 0.05, 0.0)) == pytest.approx(0.1)
    edge = path_of((0, 0), (0.25, 0), (0.5, 0), (0.5, 0.125))
    assert pursuit._progress(edge, 0.0, Pose2(0.6, 0.125, 0.0)) == 0.625  # begins at its very end
    assert pursuit._progress(there_and_back, 0.15, Pose2(0.3, 0.0, 0.0)) == pytest.approx(0.2)


@table("x", [3.1, -3.1])
def test_a_robot_outside_the_world_is_not_followed(x: float) -> None:
    within = Pose2(-3 * MAX_COORDINATE_M, 0.0, 0.0)
    assert follow(FollowState(0.5), AHEAD, within, STILL, BASE, BRAKES, LAG_S).residual_m > 9.0
    for here in (Pose2(x * MAX_COORDINATE_M, 0, 0), Pose2(0, nan, 0), Pose2(0, 0, inf)):
        answer = follow(FollowState(0.5), AHEAD, here, STILL, BASE, BRAKES, LAG_S)
        assert answer == pursuit.PursuitCommand(FollowState(0.5), STILL, 0.0, 0.0, False)


def test_what_is_left_is_the_longer_of_path_and_distance() -> None:
    answer = follow(FollowState(), AHEAD, Pose2(0.5, 0.2, 0.0), STILL, BASE, BRAKES, LAG_S)
    assert answer.residual_m == pytest.approx(hypot(1.5, 0.2))
    assert (answer.residual_rad, answer.at_end) == (0.0, False)
    aside = follow(FollowState(), L_SHAPED, Pose2(0.1, 0.9, 0.0), STILL, BASE, BRAKES, LAG_S)
    assert aside.residual_m == pytest.approx(hypot(0.1, 0.7))
    bent = follow(FollowState(), BENT, Pose2(0.1, 0.0, 0.0), STILL, BASE, BRAKES, LAG_S)
    assert bent.residual_m == pytest.approx(0.7)


def test_residuals_are_distance_and_turn_and_a_tenth_of_each_is_there() -> None:
    here = Pose2(0.4, 1.2, 0.3)
    assert residuals(1.0, 2.0, 0.5, here) == pytest.approx((1.0, 0.2))
    assert residuals(1.0, 2.0, None, here) == pytest.approx((1.0, 0.0))
    assert pursuit.is_reached(0.1, 0.1)
    assert not pursuit.is_reached(0.1 + EPS, 0.1)
    assert not pursuit.is_reached(0.1, 0.1 + EPS)


def test_the_last_5_cm_lead_to_the_end() -> None:
    short = path_of((0.0, 0.0), (0.05, 0.0))
    assert pursuit._view(short, 0.0, 0.05, Pose2(0.0, 0.0, 0.0), STILL).ending


@table(
    ("heading", "yaw", "done", "w"),
    [
        (None, 0.3, False, 0.0),
        (0.4, 0.3, False, SMALL),
        (0.2, 0.3, False, -SMALL),
        (0.35, 0.3, True, 0.0),
        (3.1, -3.1, False, -SPIN * (sqrt(LATE_S**2 + 2 * (2 * pi - 6.2) / SPIN) - LATE_S)),
    ],
)
def test_settled_it_turns_to_the_heading_and_no_more(
    heading: float | None, yaw: float, done: bool, w: float
) -> None:
    path = path_of((0, 0), (0.1, 0), (0.2, 0), heading=heading)
    state = FollowState(0.2, False, True, done)
    answer = follow(state, path, Pose2(0.2, 0.01, yaw), STILL, BASE, BRAKES, LAG_S)
    assert answer.target.v_mps == 0.0
    assert answer.target.w_radps == pytest.approx(w)
    assert answer.at_end is (answer.residual_rad <= 0.1)
