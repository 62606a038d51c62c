"""The owner's time zone: one clock for orders, memory and all else that the planner tells."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from datetime import UTC, datetime

import pytest

from planner.orders.zone import find_zone, set_local_zone
from wire import ConfigError

SUMMER_UNIX_S = datetime(2027, 7, 1, 12, tzinfo=UTC).timestamp()


@pytest.fixture(autouse=True)
def system(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the system's clock be UTC, as a container's is, and give the zone back afterwards."""
    with monkeypatch.context() as changed:
        changed.setenv("TZ", "UTC")
        time.tzset()
        yield
    time.tzset()


@pytest.mark.parametrize("wanted", ["Europe/Berlin", "Asia/Shanghai", "Asia/Kathmandu"])
def test_local_time_is_the_zone_by_which_orders_go(wanted: str) -> None:
    set_local_zone(wanted)
    local = datetime.fromtimestamp(SUMMER_UNIX_S).astimezone()
    ordered = datetime.fromtimestamp(SUMMER_UNIX_S, find_zone(wanted, os.environ))
    assert local.replace(tzinfo=None) == ordered.replace(tzinfo=None)
    assert time.localtime(SUMMER_UNIX_S).tm_gmtoff == ordered.utcoffset().total_seconds()  # type: ignore[union-attr]


def test_without_a_setting_the_systems_clock_stays() -> None:
    set_local_zone(None)
    assert time.localtime(SUMMER_UNIX_S).tm_hour == 12
    assert os.environ["TZ"] == "UTC"


def test_a_zone_that_is_none_is_refused_with_its_name() -> None:
    with pytest.raises(ConfigError, match=r"timezone_unknown.*Mars/Olympus"):
        find_zone("Mars/Olympus", os.environ)
