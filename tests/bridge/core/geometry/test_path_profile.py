"""Hold the prepared path: lengths, regulated corners, and speeds that brake in time."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.path_profile import PLANNED_DECEL, Path, prepare, regulate
from wire.commands import Waypoint
from wire.robot import Limits

LIMITS = Limits()


def point(x: float, y: float, speed: float = 0.5) -> Waypoint:
    return Waypoint(x_m=x, y_m=y, speed_mps=speed)


# nav2's regulated pure pursuit, requested 1.0 m/s, its radius 2.7 m and floor 0.25 m/s.
@pytest.mark.parametrize(("curve", "speed"), [(0.7407, 0.5), (1000.0, 0.25), (0.0, 1.0)])
def test_curves_are_taken_slower(curve: float, speed: float) -> None:
    assert regulate(1.0, curve, 2.7, 0.25) == pytest.approx(speed, abs=0.01)


def test_nothing_is_the_empty_path() -> None:
    path = prepare((), LIMITS)
    assert path.length_m == 0.0
    assert path.heading_rad is None


def test_the_end_is_a_stop_and_corners_are_slow() -> None:
    there = [point(i / 10, 0.0) for i in range(11)]
    path = prepare([*there, *(point(1.0, i / 10) for i in range(1, 11))], LIMITS)
    assert path.length_m == pytest.approx(2.0)
    assert path.exits_mps[-1] == 0.0
    assert path.exits_mps[10] < 0.25
    assert path.exits_mps[2] == 0.5


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
