"""Times that people ask about, by the clock of the home, over midnight and a change of clocks."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.mission.recall_text import bounds_of, tell_time
from planner.plan import Span

HERE = timezone(timedelta(hours=1))
NOON = datetime(2026, 11, 25, 12, 30, tzinfo=HERE)


def hours(when: Span, now: datetime) -> tuple[float, float]:
    """Return the bounds in hours before now."""
    since, until = bounds_of(when, now)
    assert since is not None
    assert until is not None
    return (now.timestamp() - since) / 3600.0, (now.timestamp() - until) / 3600.0


@pytest.mark.parametrize(
    ("when", "since_h", "until_h"),
    [("hour", 1.0, 0.0), ("today", 12.5, -11.5), ("morning", 7.5, 0.5), ("afternoon", 0.5, -5.5)],
)
def test_parts_of_this_day(when: Span, since_h: float, until_h: float) -> None:
    assert hours(when, NOON) == pytest.approx((since_h, until_h))


def test_what_has_not_begun_is_yesterdays() -> None:
    since_h, until_h = hours("evening", NOON)
    assert 0.0 < until_h < since_h < 36.0


@given(
    when=st.sampled_from(get_args(Span)),
    at_unix_s=st.integers(1_577_836_800, 2_051_222_400),
)
def test_bounds_are_in_order_and_begin_before_now(when: Span, at_unix_s: int) -> None:
    now = datetime.fromtimestamp(at_unix_s, HERE)
    since, until = bounds_of(when, now)
    assert since is not None
    assert until is not None
    assert since < until
    assert since <= now.timestamp()
    assert until - since <= 7 * 86_400.0 + 1.0


@pytest.mark.parametrize(
    ("ago_s", "en"),
    [(5.0, "just now"), (61.0, "a minute ago, at "), (1200.0, "20 minutes ago, at "),
     (3700.0, "an hour ago, at "), (86_400.0, "yesterday at "), (3 * 86_400.0, "3 days ago, at "),
     (30 * 86_400.0, "on 20")],
)  # fmt: skip
def test_ages_are_told_as_people_do(ago_s: float, en: str) -> None:
    now = datetime.fromtimestamp(1_800_000_000.0).astimezone().replace(hour=12)
    assert tell_time(now.timestamp() - ago_s, now).en.startswith(en)
