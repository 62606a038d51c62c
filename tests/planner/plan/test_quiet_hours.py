"""A span of the day, past midnight or not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.plan.quiet_hours import QuietHours

CLOCK = st.integers(0, 23 * 60 + 59)


@given(CLOCK, CLOCK, CLOCK)
def test_quiet_hours_and_the_rest_share_the_day(first: int, last: int, minute: int) -> None:
    if first == last:
        return
    text = f"{first // 60:02}:{first % 60:02}-{last // 60:02}:{last % 60:02}"
    assert QuietHours.read(text) == QuietHours(first, last)
    assert QuietHours(first, last).holds(minute) != QuietHours(last, first).holds(minute)
    assert QuietHours(first, last).holds(first)
    assert not QuietHours(first, last).holds(last)


@pytest.mark.parametrize("text", ["", "22:00", "24:00-07:00", "22:00-22:00", "7-8", "22:60-23:00"])
def test_a_text_that_is_no_span_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="span"):
        QuietHours.read(text)
