"""Lines of a UGV base are read as they are, and nothing else is."""

from __future__ import annotations

import json
from math import radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.waveshare import (
    LONGEST,
    UgvEcho,
    UgvReader,
    UgvReport,
    UgvSetting,
    UgvText,
    encode_settings,
    encode_speed,
    recognise,
)

REPORT = (
    b'{"T":1001,"L":0.25,"R":-0.125,"ax":12,"ay":-40,"az":8192,"gx":0,"gy":0,"gz":1,'
    b'"mx":100,"my":-20,"mz":7,"odl":153,"odr":-7,"v":1187}\r\n'
)
GENERAL = b'{"T":1001,"L":0,"R":0,"r":7.005664349,"p":0.1,"y":2.0,"temp":41.0,"v":11.11301041}\r\n'
"""Of the General Driver's firmware, as published."""
OLD = b'{"T":1001,"L":0,"R":0,"odl":0.4375,"odr":1.5,"v":11.1}\r\n'


def test_a_report_is_read() -> None:
    (line,) = UgvReader().read(REPORT)
    assert isinstance(line, UgvReport)
    assert line.inertial is not None
    assert line.inertial.gyro_radps == pytest.approx((0.0, 0.0, radians(1 / 16.4)))
    assert line.inertial.accel_mps2 == pytest.approx((0.01437, -0.04788, 9.80665), abs=1e-5)
    assert line == UgvReport(0.25, -0.125, (153, -7), False, 11.87, line.inertial, len(REPORT))


@pytest.mark.parametrize("spoilt", [b'"x"', b"40000", b"null", b"1e400", b"true"])
def test_a_gyro_that_says_what_16_bits_do_not_hold_is_none(spoilt: bytes) -> None:
    (line,) = UgvReader().read(REPORT.replace(b'"gz":1', b'"gz":' + spoilt))
    assert isinstance(line, UgvReport)
    assert line.inertial is None


def test_bases_that_count_nothing_or_in_metres_are_told_apart() -> None:
    general, old = UgvReader().read(GENERAL + OLD)
    assert isinstance(general, UgvReport)
    assert isinstance(old, UgvReport)
    assert (general.ways_cm, general.is_old) == (None, False)
    assert (old.ways_cm, old.is_old) == (None, True)


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.text("abc-09", min_size=1, max_size=12))
def test_a_command_is_one_line_and_comes_back_as_its_tag(
    left: float, right: float, tag: str
) -> None:
    left, right = round(left, 4), round(right, 4)
    data = encode_speed(left, right, tag)
    assert json.loads(data) == {"T": 1, "L": left, "R": right, "s": tag}
    assert UgvReader().read(data) == [UgvEcho(tag, left, right)]
    assert len(data) < 64


def test_settings_are_read_back_one_by_one() -> None:
    lines = UgvReader().read(encode_settings(200))
    assert UgvSetting(136, 200) in lines
    assert {line.kind for line in lines if isinstance(line, UgvSetting)} == {
        605, 143, 136, 131, 142,
    }  # fmt: skip


@given(st.lists(st.sampled_from([REPORT, GENERAL, encode_speed(0.1, 0.2, "a-1-1")])), st.data())
def test_lines_may_come_in_any_pieces(lines: list[bytes], data: st.DataObject) -> None:
    whole, reader = b"".join(lines), UgvReader()
    cuts = sorted(data.draw(st.lists(st.integers(0, len(whole)), max_size=8)))
    pieces = [whole[a:b] for a, b in zip([0, *cuts], [*cuts, len(whole)], strict=True)]
    assert [line for piece in pieces for line in reader.read(piece)] == UgvReader().read(whole)


@pytest.mark.parametrize(
    "line",
    [
        b'{"T":1001,"L":0.2}', b'{"T":1001,"L":"0.2","R":0}', b'{"T":1001,"L":NaN,"R":0}',
        b'{"T":1001,"L":1e999,"R":0}', b'{"T":1001,"L":9.0,"R":0}', b'{"T":1001,"L":true,"R":0}',
        b'{"T":1001,"L":0,"R":0,"odl":"7","odr":1}', b'{"T":1001,"L":0,"R":0,"odl":1e12,"odr":1}',
        b'{"T":"1001"}', b'{"T":1}', b'{"T":1,"s":7}', b'{"T":1,"s":"a"}',
        b'{"T":136,"cmd":1.5}', b'{"T":true}',
        b'{"T":1001,"L":0.2,"R":0.2', b"{}", b'{"T":' + b"[" * 400, b"\x00\xff\xfe", b"{" * 300,
        b'{"T":1001,"L":0,"R":0,"x":"' + b"a" * LONGEST + b'"}',
    ],
)  # fmt: skip
def test_what_is_none_is_counted_and_the_next_line_is_read(line: bytes) -> None:
    reader = UgvReader()
    (report,) = reader.read(line + b"\n" + REPORT)
    assert isinstance(report, UgvReport)
    assert reader.spoilt_lines == 1


def test_a_line_without_end_is_not_kept() -> None:
    reader = UgvReader()
    for _ in range(100):
        assert reader.read(b"x" * 300) == []
    assert len(reader._rest) <= LONGEST
    assert reader.read(b"\n" + REPORT)


def test_words_are_words() -> None:
    assert UgvReader().read(b"UGV started.\r\n\r\n") == [UgvText("UGV started.")]


def test_a_base_is_recognised_by_three_reports() -> None:
    assert recognise(REPORT * 2) is None
    found = recognise(b"noise\xff\n" + REPORT * 3)
    assert found is not None
    assert "battery 11.9 V" in found.words
    for data, cure in ((GENERAL, "WAVE ROVER"), (OLD, "0.96")):
        refused = recognise(data * 3)
        assert refused is not None
        assert cure in refused.words


@given(st.binary(max_size=600))
def test_no_bytes_break_it(data: bytes) -> None:
    UgvReader().read(data)
    recognise(data)
