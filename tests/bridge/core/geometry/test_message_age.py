"""Hold ages to our own clock."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.message_age import append_sent, sensor_age_s, sent_at
from tests.bridge.core.table import table


@given(st.integers(1, 600), st.integers(-10, 700))
def test_the_ring_knows_the_last_256_statuses_and_no_other(newest: int, seen: int) -> None:
    ring: tuple[float, ...] = ()
    for seq in range(1, newest + 1):
        ring = append_sent(ring, float(seq))
    sent_s = sent_at(ring, newest, seen)
    if max(1, newest - 255) <= seen <= newest:
        assert sent_s == float(seen)
    else:
        assert sent_s is None


@given(st.floats(0, 1e6), st.floats(0, 10), st.floats(-1e9, 1e9), st.booleans())
def test_no_stamp_makes_a_reading_younger(
    received_s: float, since_s: float, stamp_s: float, same_host: bool
) -> None:
    now_s = received_s + since_s
    assert sensor_age_s(now_s, received_s, stamp_s, same_host=same_host) >= now_s - received_s


def test_256_statuses_are_remembered_and_no_more() -> None:
    ring: tuple[float, ...] = ()
    for seq in range(1, 301):
        ring = append_sent(ring, float(seq))
    assert ring == tuple(float(seq) for seq in range(45, 301))
    known = {seen: sent_at(ring, 300, seen) for seen in (44, 45, 300, 301)}
    assert known == {44: None, 45: 45.0, 300: 300.0, 301: None}


@table(
    ("stamp_s", "same_host", "age_s"),
    [(8.0, True, 2.0), (9.0, True, 1.0), (9.5, True, 1.0), (8.0, False, 1.0), (9.5, False, 1.0)],
)
def test_a_reading_is_as_old_as_the_older_of_its_two_times(
    stamp_s: float, same_host: bool, age_s: float
) -> None:
    assert sensor_age_s(10.0, 9.0, stamp_s, same_host=same_host) == age_s
