"""Hold the speeds along a path to a law written plainly."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, hypot, sqrt
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.path_profile import PLANNED_DECEL, Path, prepare, regulate
from tests.bridge.core.table import table
from wire import Waypoint
from wire.robot import Limits

LIMITS = Limits()


def point(x: float, y: float, speed: float = 0.5) -> Waypoint:
    return Waypoint(x_m=x, y_m=y, speed_mps=speed)


# nav2's regulated pure pursuit, requested 1.0 m/s, its radius 2.7 m and floor 0.25 m/s.
@pytest.mark.parametrize(("curve", "speed"), [(0.7407, 0.5), (1000.0, 0.25), (0.0, 1.0)])
def test_curves_are_taken_slower(curve: float, speed: float) -> None:
    assert regulate(1.0, curve, 2.7, 0.25) == pytest.approx(speed, abs=0.01)


@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(0.05, 2)), max_size=50))
def test_speeds_can_be_braked_from_point_to_point(points: list[tuple[float, float, float]]) -> None:
    path = prepare([point(*p) for p in points], LIMITS)
    decel = PLANNED_DECEL * LIMITS.max_decel_mps2
    for (a, b), (start, end) in zip(pairwise(path.exits_mps), pairwise(path.along_m), strict=True):
        assert a * a - b * b <= 2 * decel * (end - start) + 1e-9
    assert all(e <= s for e, s in zip(path.exits_mps, path.speeds_mps, strict=True))
    adapter = TypeAdapter(Path)
    assert adapter.validate_json(adapter.dump_json(path)) == path


any_point = st.builds(
    Waypoint.model_construct,
    x_m=st.floats(),
    y_m=st.floats(),
    speed_mps=st.floats(),
    heading_rad=st.none(),
)


@given(st.lists(any_point, max_size=5))
def test_no_float_raises(points: list[Waypoint]) -> None:
    assert len(prepare(points, LIMITS).xs_m) == len(points)


WEAK = Limits(max_decel_mps2=0.8)
DECEL = 0.7 * WEAK.max_decel_mps2
Place = tuple[float, float, float]
"""x, y [m], and the speed that the sender allows there [m/s]."""


def points_every(count: int, gap_m: float, *speeds: float) -> list[Place]:
    return [(i * gap_m, 0.0, speeds[i % len(speeds)]) for i in range(count)]


def corner(turn_x: float, turn_y: float, speed: float = 0.5) -> list[Place]:
    """Go 0.6 m straight on, then 0.6 m in another direction."""
    there = [(i / 10, 0.0, speed) for i in range(7)]
    return [*there, *((0.6 + turn_x * i / 10, turn_y * i / 10, speed) for i in range(1, 7))]


def wander(seed: int) -> list[Place]:
    random = Random(seed)
    x = y = 0.0
    places = []
    for _ in range(30):
        places.append((x, y, random.choice([0.1, 0.3, 0.5])))
        x, y = x + random.uniform(-0.1, 0.2), y + random.uniform(-0.15, 0.15)
    return places


ROUTES = {
    "one": [(1.0, 2.0, 0.4)],
    "two": points_every(2, 0.2, 0.5),
    "even": points_every(20, 0.1, 0.5),
    "short": points_every(4, 0.05, 0.5),
    "one slow in the middle": [(i / 10, 0.0, 0.1 if i == 9 else 0.5) for i in range(20)],
    "first slow": [(i / 10, 0.0, 0.1 if i == 0 else 0.5) for i in range(20)],
    "to and fro": points_every(20, 0.1, 0.5, 0.2, 0.4),
    "left": corner(0.0, 1.0),
    "right": corner(0.0, -1.0),
    "back": corner(-1.0, 0.0),
    "slow back": corner(-1.0, 0.0, 0.1),
    "0.49 rad": corner(0.88, 0.47),
    "0.55 rad": corner(0.85, 0.52),
    "exactly 0.15 m before": [(0.0, 0.0, 0.5), (0.15, 0.0, 0.5), (0.15, 0.15, 0.5)],
    "exactly 0.15 m after": [(0.0, 0.0, 0.5), (0.1, 0.0, 0.5), (0.1, 0.15, 0.5), (0.1, 0.3, 0.5)],
    **{f"wandering {seed}": wander(seed) for seed in range(5)},
}


def exits_of(places: list[Place]) -> list[float]:
    """Return the speeds, braking from the end, of curves told by all turns within 0.15 m."""
    steps = [(bx - ax, by - ay) for (ax, ay, _), (bx, by, _) in pairwise(places)]
    along = [0.0]
    for dx, dy in steps:
        along.append(along[-1] + hypot(dx, dy))
    turns = [abs(atan2(a * d - b * c, a * c + b * d)) for (a, b), (c, d) in pairwise(steps)]
    turns = [0.0, *turns, 0.0]
    exits = []
    for (_, _, speed), here in zip(places, along, strict=True):
        near = [t for t, m in zip(turns, along, strict=False) if here - 0.15 <= m <= here + 0.15]
        tight = sum(near) / 0.3 * 0.6
        exits.append(speed if tight <= 1.0 else max(speed / tight, 0.05, 0.25 * speed))
    exits[-1] = 0.0
    for i in range(len(places) - 2, -1, -1):
        exits[i] = min(exits[i], sqrt(exits[i + 1] ** 2 + 2 * DECEL * (along[i + 1] - along[i])))
    return exits


@table("name", ROUTES)
def test_speeds_are_those_of_the_plain_way(name: str) -> None:
    places = ROUTES[name]
    path = prepare([Waypoint(x_m=x, y_m=y, speed_mps=v) for x, y, v in places], WEAK)
    assert path.exits_mps == pytest.approx(exits_of(places), abs=1e-9)
    assert path.speeds_mps == tuple(v for _, _, v in places)
    assert (path.xs_m, path.ys_m) == tuple(zip(*[(x, y) for x, y, _ in places], strict=True))
    gone = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(places)]
    assert path.along_m == pytest.approx([sum(gone[:i]) for i in range(len(places))])
    assert path.length_m == pytest.approx(sum(gone))


@table(("sign", "backwards"), [(1, False), (-1, True)])
def test_the_sign_of_speed_is_the_direction(sign: int, backwards: bool) -> None:
    points = [Waypoint(x_m=i / 10, y_m=0.0, speed_mps=sign * 0.3) for i in range(3)]
    turned = Waypoint(x_m=0.3, y_m=0.0, speed_mps=sign * 0.3, heading_rad=1.0)
    path = prepare([*points, turned], WEAK)
    assert (path.backwards, path.heading_rad) == (backwards, 1.0)
    assert path.speeds_mps == (0.3,) * 4
    assert prepare((), WEAK).backwards is False
