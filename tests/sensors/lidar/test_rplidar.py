"""RPLidars' three answers become beams, and bytes read from the wrong place become none."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.lidar.rplidar import MODELS, RplidarDecoder, motor_pwm, motor_speed, request
from tests.sensors.lidar.frames import (
    RP_DENSE_HEAD,
    RP_EXPRESS_HEAD,
    RP_STANDARD_HEAD,
    rp_beam,
    rp_cabins,
    rp_frame,
)


def test_requests_are_those_of_the_protocol() -> None:
    assert request(0x82, bytes(5)) == bytes.fromhex("a58205000000000022")
    assert request(0x25) == bytes.fromhex("a525")
    assert motor_speed(600) == bytes.fromhex("a5a802580255")
    assert motor_pwm(660) == bytes.fromhex("a5f0029402c1")


ANGLES = st.floats(0, 359.9).map(lambda angle: round(angle * 64) / 64)
RANGES = st.integers(0, 16_000).map(lambda mm: mm / 1000)


@given(st.lists(st.tuples(ANGLES, RANGES), min_size=3, max_size=30), st.integers(1, 40))
def test_standard_beams_are_read_however_they_are_cut(
    beams: list[tuple[float, float]], size: int
) -> None:
    data = RP_STANDARD_HEAD + b"".join(rp_beam(angle, far) for angle, far in beams)
    decoder = RplidarDecoder(MODELS["a1"])
    found = [
        pair
        for at in range(0, len(data), size)
        for got in decoder.feed(data[at : at + size], 1.0 + at * 1e-4)
        for pair in zip(got.angles_deg, got.distances_m, strict=True)
    ]
    assert found == beams


@given(st.integers(1, 4))
def test_lost_bytes_cost_no_more_than_what_follows_them(lost: int) -> None:
    decoder = RplidarDecoder(MODELS["a1"])
    beams = [rp_beam(2.0 * k, 1.0 + k / 100) for k in range(40)]
    data = RP_STANDARD_HEAD + b"".join(beams[:20]) + b"".join(beams[20:])[lost:]
    found = [far for got in decoder.feed(data, 1.0) for far in got.distances_m]
    assert found[:20] == pytest.approx([1.0 + k / 100 for k in range(20)])
    assert found[-15:] == pytest.approx([1.0 + k / 100 for k in range(25, 40)])


def test_express_beams_lie_between_two_frames_less_their_offsets() -> None:
    decoder = RplidarDecoder(MODELS["a2"])
    far = [0.2 + k / 10 for k in range(32)]
    offsets = [k / 8 for k in range(32)]
    first = rp_frame(350.0, rp_cabins(far, offsets), anew=True)
    second = rp_frame(14.0, rp_cabins(far, offsets))
    assert decoder.feed(RP_EXPRESS_HEAD + first, 1.0) == []
    (beams,) = decoder.feed(second, 1.01)
    assert list(beams.distances_m) == pytest.approx(far)
    wanted = [(350.0 + 0.75 * k - k / 8) % 360.0 for k in range(32)]
    assert list(beams.angles_deg) == pytest.approx(wanted)


def test_dense_beams_lie_evenly_between_two_frames() -> None:
    decoder = RplidarDecoder(MODELS["c1"])
    body = b"".join((1000 + k).to_bytes(2, "little") for k in range(40))
    decoder.feed(RP_DENSE_HEAD + rp_frame(0.0, body, anew=True), 1.0)
    (beams,) = decoder.feed(rp_frame(30.0, body), 1.01)
    assert list(beams.distances_m) == [(1000 + k) / 1000 for k in range(40)]
    assert list(beams.angles_deg) == pytest.approx([0.75 * k for k in range(40)])


@given(bit=st.integers(0, 84 * 8 - 1))
def test_a_flipped_bit_of_a_frame_gives_no_beams_of_it(bit: int) -> None:
    decoder = RplidarDecoder(MODELS["a2"])
    frames = [rp_frame(20.0 * k, rp_cabins([1.0] * 32, [0.0] * 32)) for k in range(6)]
    spoilt = bytearray(frames[2])
    spoilt[bit // 8] ^= 1 << bit % 8
    data = RP_EXPRESS_HEAD + frames[0] + frames[1] + bytes(spoilt) + b"".join(frames[3:])
    found = decoder.feed(data, 1.0)
    starts = [round(beams.angles_deg[0]) for beams in found]
    assert starts == [0, 60, 80]
    assert all(far == 1.0 for beams in found for far in beams.distances_m)


@given(st.binary(max_size=600))
def test_noise_raises_nothing(noise: bytes) -> None:
    for model in ("a1", "a2"):
        decoder = RplidarDecoder(MODELS[model])
        decoder.feed(RP_EXPRESS_HEAD + noise, 1.0)
        assert len(decoder._kept) < 92  # that memory is bounded shows nowhere else


def test_an_answer_to_another_question_is_passed_over() -> None:
    decoder = RplidarDecoder(MODELS["a1"])
    health = bytes.fromhex("a55a0300000006000000")
    found = decoder.feed(health + RP_STANDARD_HEAD + rp_beam(1.0, 2.0) * 3, 1.0)
    assert [beams.distances_m for beams in found] == [(2.0, 2.0, 2.0)]
