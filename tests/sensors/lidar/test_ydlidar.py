"""YDLidars' packets become beams that look where triangulation puts them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.lidar.ydlidar import MODELS, YdlidarDecoder, packet_check
from tests.sensors.lidar.frames import yd_packet, yd_shift_deg

GOLDEN = bytes.fromhex("aa55010153ae53aeab540000")
"""The zero packet of the X4's development manual."""


def test_the_manuals_packet_checks_and_reads() -> None:
    assert packet_check(GOLDEN) == 0
    (beams,) = YdlidarDecoder(MODELS["x4"]).feed(GOLDEN, 1.0)
    assert list(beams.angles_deg) == pytest.approx([0x5729 / 64])
    assert beams.distances_m == (0.0,)


@given(
    start=st.floats(0, 340).map(lambda angle: round(angle * 64) / 64),
    far=st.lists(st.integers(0, 8000).map(lambda mm: mm / 1000), min_size=2, max_size=40),
    model=st.sampled_from(["x2", "g2"]),
    size=st.integers(1, 60),
)
def test_packets_are_read_however_they_are_cut(
    start: float, far: list[float], model: str, size: int
) -> None:
    decoder = YdlidarDecoder(MODELS[model])
    width = MODELS[model].sample_bytes
    data = yd_packet(start, 0.5, far, begins=False, sample_bytes=width)
    pieces = [data[at : at + size] for at in range(0, len(data), size)]
    (beams,) = [got for piece in pieces for got in decoder.feed(piece, 1.0)]
    assert list(beams.distances_m) == pytest.approx(far)
    for k, (angle, distance) in enumerate(zip(beams.angles_deg, far, strict=True)):
        wanted = start + 0.5 * k + yd_shift_deg(distance)
        assert (angle - wanted + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=1e-6)


@given(bit=st.integers(0, 34 * 8 - 1))
def test_a_flipped_bit_costs_its_packet_and_at_most_the_next(bit: int) -> None:
    good = yd_packet(10.0, 0.5, [1.0 + k / 10 for k in range(12)], begins=False)
    spoilt = bytearray(good)
    spoilt[bit // 8] ^= 1 << bit % 8
    decoder = YdlidarDecoder(MODELS["x4"])
    found = decoder.feed(bytes(spoilt) + good * 30, 1.0)
    assert len(found) >= 8  # a length read as 255 beams swallows what it spans
    wanted = YdlidarDecoder(MODELS["x4"]).feed(good, 1.0)[0].distances_m
    assert all(beams.distances_m == wanted for beams in found)


@given(st.binary(max_size=600))
def test_noise_raises_nothing(noise: bytes) -> None:
    decoder = YdlidarDecoder(MODELS["g2"])
    decoder.feed(noise, 1.0)
    assert len(decoder._kept) < 10 + 255 * 3  # bounded memory shows nowhere else
