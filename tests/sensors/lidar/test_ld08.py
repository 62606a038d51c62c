"""An LDS-02's bytes become beams around its axis, as ROBOTIS' own driver reckons them."""

from __future__ import annotations

from itertools import pairwise
from math import atan, cos, degrees, radians, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.lidar.kinds import kind_of, recognize
from sensors.lidar.ld08 import Ld08Decoder, recognise, seen_from_the_axis
from tests.conftest import ROOT
from tests.sensors.lidar.frames import ld_frame
from tests.sensors.lidar.test_ldrobot import MANUAL
from wire import load_robot
from wire.lidar_config import LidarConfig

CONFIG = LidarConfig(kind="ld08", port="/dev/x", scan_s=0.2)


def test_the_example_of_the_e_manual_reads_as_the_manual_says() -> None:
    """Its packet is the one that the LD19's manual shows: 2 152 degrees/s, 12 beams from 324.27."""
    (beams,) = Ld08Decoder().feed(MANUAL, 5.0)
    assert beams.swept_deg[0] == pytest.approx(324.27)
    assert beams.swept_deg[-1] == pytest.approx(334.70)
    assert beams.period_s == pytest.approx((334.70 - 324.27) / 11 / 2152)
    # Point 1 is 224 mm along the beam: x = 224 + 5.9, y = 224 * 0.11923 - 20.14 (transform.cpp).
    x_mm, y_mm = 229.9, 224 * 0.11923 - 20.14
    assert beams.distances_m[0] == pytest.approx(sqrt(x_mm**2 + y_mm**2) / 1000)
    assert beams.angles_deg[0] == pytest.approx(324.27 - degrees(atan(y_mm / x_mm)))


def test_what_did_not_come_back_stays_nothing() -> None:
    assert seen_from_the_axis(12.0, 0.0) == (12.0, 0.0)


@given(st.floats(0.16, 8.0), st.floats(0.0, 359.99))
def test_a_far_thing_is_turned_by_the_tilt_and_no_further(far_m: float, angle_deg: float) -> None:
    seen_deg, seen_m = seen_from_the_axis(angle_deg, far_m)
    assert far_m - 0.001 <= seen_m <= far_m * 1.01 + 0.006
    turned_deg = (angle_deg - seen_deg + 180.0) % 360.0 - 180.0
    assert -0.6 <= turned_deg <= degrees(atan(0.11923))


def test_a_flat_wall_stays_flat() -> None:
    """Rays as the lens sends them meet a wall 1 m ahead; from the axis it stands at 1 m again."""
    for head_deg in range(-40, 41, 5):
        head, tilt = radians(head_deg), atan(0.11923)
        lens = 0.0059 * cos(head) + 0.02014 * sin(head)
        along_m = (1.0 - lens) / cos(head + tilt) * cos(tilt)
        angle_deg, far_m = seen_from_the_axis(-head_deg % 360.0, along_m)
        assert far_m * cos(radians(angle_deg)) == pytest.approx(1.0, abs=1e-9)


def test_times_go_on_where_its_milliseconds_begin_again_at_a_number_nobody_told() -> None:
    decoder, firsts = Ld08Decoder(), []
    for k in range(40):
        arrival_s = 100.0 + 0.005 * k
        time_ms = 29_900 + 5 * k if k < 20 else 5 * (k - 20)
        (beams,) = decoder.feed(ld_frame(9.4 * k % 360, 0.78, [1.0] * 12, time_ms), arrival_s)
        firsts.append(beams.first_s)
        assert beams.first_s < arrival_s
    steps = [later - earlier for earlier, later in pairwise(firsts)]
    assert steps == pytest.approx([0.005] * 39)


def test_it_is_told_from_its_faster_kin_by_its_rate() -> None:
    slow = b"".join(ld_frame(9.4 * k % 360, 3600 / 2300, [1.0] * 12, 5 * k) for k in range(8))
    fast = b"".join(ld_frame(9.6 * k % 360, 0.8, [1.0] * 12, 3 * k) for k in range(8))
    assert (recognize(slow), recognize(fast)) == ("ld08", "ld19")
    answer = recognise(slow)
    assert answer is not None
    assert answer.words.startswith("lidar LDS-02 (LD08)")


def test_turtlebots_preset_reads_it() -> None:
    lidar = load_robot(ROOT / "robots" / "turtlebot3_burger.toml").lidar
    assert lidar.kind == "ld08"
    assert kind_of(lidar).baud == 115_200
    assert kind_of(CONFIG).shape.beams >= 460
