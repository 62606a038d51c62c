"""An LD19's bytes become beams, and what does not check becomes none."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.lidar import Beams, LdRobotDecoder
from tests.sensors.lidar.frames import ld_frame

MANUAL = bytes.fromhex(
    "542c6808ab7ee000e4dc00e2d900e5d500e3d300e4d000e9cd00e4ca00e2c700e9c500e5c200e5c000e5be823a1a50"
)
"""The example of the LD19's development manual."""


def decode(data: bytes, sizes: int = 1000, arrival_s: float = 5.0) -> list[Beams]:
    decoder = LdRobotDecoder()
    pieces = [data[at : at + sizes] for at in range(0, len(data), sizes)]
    return [beams for piece in pieces for beams in decoder.feed(piece, arrival_s)]


def test_the_manuals_example_reads_as_the_manual_says() -> None:
    (beams,) = decode(MANUAL)
    assert beams.angles_deg[0] == pytest.approx(324.27)
    assert beams.angles_deg[-1] == pytest.approx(334.70)
    assert beams.distances_m[0] == 0.224
    assert beams.distances_m[-1] == 0.192
    assert beams.period_s == pytest.approx((334.70 - 324.27) / 11 / 2152)


@given(
    frames=st.lists(
        st.tuples(
            st.floats(0, 359.99),
            st.lists(st.integers(0, 12_000).map(lambda mm: mm / 1000), min_size=12, max_size=12),
        ),
        min_size=1,
        max_size=6,
    ),
    size=st.integers(1, 60),
)
def test_frames_are_read_however_they_are_cut(
    frames: list[tuple[float, list[float]]], size: int
) -> None:
    data = b"".join(ld_frame(start, 0.8, far, 3 * k) for k, (start, far) in enumerate(frames))
    found = decode(data, size)
    assert [list(beams.distances_m) for beams in found] == [far for _, far in frames]
    for beams, (start, _) in zip(found, frames, strict=True):
        assert beams.angles_deg[0] == pytest.approx(start, abs=0.006) or start > 359.99


@given(bit=st.integers(0, 47 * 8 - 1))
def test_a_flipped_bit_costs_its_frame_alone(bit: int) -> None:
    spoilt = bytearray(MANUAL)
    spoilt[bit // 8] ^= 1 << bit % 8
    decoder = LdRobotDecoder()
    found = decoder.feed(bytes(spoilt) + MANUAL + MANUAL, 1.0)
    assert len(found) == 2
    assert all(beams.distances_m[0] == 0.224 for beams in found)


@given(st.binary(max_size=400))
def test_noise_raises_nothing_and_is_not_kept(noise: bytes) -> None:
    decoder = LdRobotDecoder()
    decoder.feed(noise, 1.0)
    assert len(decoder._kept) < 47  # that memory is bounded shows nowhere else
    assert len(decoder.feed(bytes(46) + MANUAL, 1.0)) == 1


def test_times_are_the_sensors_own_though_bytes_come_in_bursts() -> None:
    decoder = LdRobotDecoder()
    far = [1.0] * 12
    firsts = []
    for k in range(40):
        arrival_s = 100.0 + 0.003 * k + (0.050 if k % 7 == 3 else 0.0)
        (beams,) = decoder.feed(ld_frame(9.6 * k % 360, 0.8, far, 29_990 + 3 * k), arrival_s)
        firsts.append(beams.first_s)
        assert beams.first_s < arrival_s
    steps = [later - earlier for earlier, later in pairwise(firsts)]
    assert steps == pytest.approx([0.003] * 39)
