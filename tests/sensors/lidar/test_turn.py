"""A scan shows each direction that was looked at, never farther than it was, or there is none."""

from __future__ import annotations

from math import cos, degrees, isclose, pi, sin, tau
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.lidar import Beams, LidarTurn, ScanShape, TurnCollector
from sensors.lidar.turn import MAX_GAP_DEG
from wire import Scan
from wire.lidar_config import LidarConfig

LIDAR = LidarConfig(range_max_m=8.0)
STEP_DEG = 0.8
ANGLES = tuple(STEP_DEG * k for k in range(450))


def beams(angles: tuple[float, ...], first_s: float = 0.0, far: float = 1.0) -> Beams:
    return Beams(angles, angles, (far,) * len(angles), first_s, 0.1 / 450)


def directions(scan: Scan) -> list[float]:
    return [scan.angle_min_rad + k * scan.angle_increment_rad for k in range(len(scan.ranges_m))]


def test_turns_are_cut_at_the_sensors_zero_and_the_first_is_left_out() -> None:
    collector = TurnCollector()
    stream = ANGLES[200:] + ANGLES * 3 + ANGLES[:10]
    found = []
    for at in range(0, len(stream), 12):
        piece = stream[at : at + 12]
        found += collector.add(beams(piece, at * 0.1 / 450))
    assert [turn.angles_deg for turn in found] == [ANGLES] * 3
    assert found[0].first_s == pytest.approx(250 * 0.1 / 450)
    assert found[0].last_s - found[0].first_s == pytest.approx(449 * 0.1 / 450)
    assert (collector.turns, collector.broken) == (3, 0)


@given(lost=st.integers(4, 300), at=st.integers(0, 449))
def test_a_turn_in_which_beams_are_missing_makes_no_scan(lost: int, at: int) -> None:
    """A direction nobody looked at must not read as one from which nothing came back."""
    turned = ANGLES[at:] + ANGLES[:at]
    rest = tuple(sorted(turned[lost:]))
    collector = TurnCollector()
    found = collector.add(beams(ANGLES + rest + ANGLES + ANGLES[:1]))
    assert all(set(turn.angles_deg) == set(ANGLES) for turn in found)
    assert len(found) + collector.broken == (2 if rest[0] < 340.0 else 1)


@given(
    seed=st.integers(0, 2**32),
    clockwise=st.booleans(),
    count=st.integers(200, 720),
)
def test_no_return_is_lost_and_none_is_shown_farther(
    seed: int, clockwise: bool, count: int
) -> None:
    draws = Random(seed)
    angles = tuple(angle + draws.uniform(0.0, 0.79) for angle in ANGLES)
    far = tuple(draws.choice((0.0, draws.uniform(0.0, 9.0))) for _ in ANGLES)
    shape = ScanShape(count, LIDAR, clockwise=clockwise)
    scan = shape.scan(LidarTurn(angles, far, 5.0, 5.1), "b", 1)
    for angle, distance in zip(angles, far, strict=True):
        if not 0.0 < distance <= LIDAR.range_max_m:
            continue
        direction = (-angle if clockwise else angle) * pi / 180.0
        index = int((direction % tau) / tau * count) % count
        shown = [scan.ranges_m[(index + k) % count] for k in (-1, 0, 1)]
        assert any(r is not None and r <= distance + 1e-4 for r in shown)
    returned = {round(distance, 4) for distance in far if 0.0 < distance <= LIDAR.range_max_m}
    assert {r for r in scan.ranges_m if r is not None} <= returned


@pytest.mark.parametrize("clockwise", [True, False])
def test_a_post_stands_where_the_sensor_saw_it(clockwise: bool) -> None:
    """At 90 degrees of its own count: right of a clockwise sensor, left of one upside down."""
    far = tuple(2.0 if 88.0 < angle < 92.0 else 0.0 for angle in ANGLES)
    scan = ScanShape(450, LIDAR, clockwise=clockwise).scan(LidarTurn(ANGLES, far, 0.0, 0.1), "b", 1)
    seen = [at for at, r in zip(directions(scan), scan.ranges_m, strict=True) if r is not None]
    middle = sum(seen) / len(seen)
    side = -1.0 if clockwise else 1.0
    assert isclose(sin(middle), side, abs_tol=0.01)
    assert isclose(cos(middle), 0.0, abs_tol=0.02)
    assert len(seen) == pytest.approx(5, abs=1)


@pytest.mark.parametrize("clockwise", [True, False])
def test_the_first_beam_taken_is_the_one_at_the_stamp(clockwise: bool) -> None:
    """Beam k was taken at stamp + k steps, counted from the end where the sensor is clockwise."""
    far = tuple(1.0 + k / 1000 for k in range(450))
    scan = ScanShape(450, LIDAR, clockwise=clockwise).scan(LidarTurn(ANGLES, far, 7.0, 7.1), "b", 1)
    assert scan.stamp_s == 7.0
    taken = scan.ranges_m[::-1] if scan.clockwise else scan.ranges_m
    assert list(taken) == pytest.approx([round(r, 4) for r in far])
    assert scan.time_increment_s * 449 == pytest.approx(0.1)
    assert all(0.0 <= degrees(at) <= 360.0 for at in directions(scan))


def test_scans_always_have_the_same_directions() -> None:
    shape = ScanShape(360, LIDAR)
    shifted = tuple((angle + 0.3) % 360 for angle in ANGLES)
    first = shape.scan(LidarTurn(ANGLES, (1.0,) * 450, 0.0, 0.1), "b", 1)
    second = shape.scan(LidarTurn(shifted, (1.0,) * 450, 0.1, 0.19), "b", 2)
    assert directions(first) == directions(second)


def test_the_gap_that_is_let_through_is_less_than_a_lost_frame_of_an_ld19() -> None:
    assert MAX_GAP_DEG < 12 * STEP_DEG
