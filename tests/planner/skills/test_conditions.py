"""Check the arithmetic of HH:MM: edges of the day, over midnight, and what is past."""

from __future__ import annotations

from planner.skills.conditions import clock_time, is_between, seconds_until

HOUR_S = 3600.0


def test_the_day_ends_and_begins() -> None:
    assert clock_time(0.0) == "00:00"
    assert clock_time(86399.0) == "23:59"


def test_a_time_comes_within_twelve_hours_or_is_past() -> None:
    assert seconds_until("18:30", 18 * HOUR_S) == 1800.0
    assert seconds_until("05:00", 18 * HOUR_S) == 11 * HOUR_S
    assert seconds_until("17:59", 18 * HOUR_S) is None


def test_between_goes_over_midnight() -> None:
    assert is_between("22:00", "06:00", 23 * HOUR_S)
    assert is_between("22:00", "06:00", 5 * HOUR_S)
    assert not is_between("22:00", "06:00", 12 * HOUR_S)
    assert is_between("08:00", None, 9 * HOUR_S)
    assert not is_between(None, "08:00", 9 * HOUR_S)
