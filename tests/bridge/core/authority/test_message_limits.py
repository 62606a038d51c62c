"""Hold what floods and what scores, and what neither does."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core import ArrivedAt, Inbox
from bridge.core.authority import message_limits
from bridge.core.authority.message_limits import rate_limited
from bridge.core.inbox import RejectedAt
from bridge.core.state_senses import Flood
from tests.bridge.core.reached import at, reached
from tests.bridge.core.table import table
from wire import DecodeFailure, Heartbeat, Stop

EPS = 1e-6


LIMITS = {
    "cmd/waypoints": 4,
    "cmd/teleop": 7,
    "cmd/external": 7,
    "cmd/grant": 13,
    "cmd/heartbeat": 13,
    "cmd/hello": 13,
}
"""rate x 0.25 s x 1.2, and one more."""


@table(("key", "limit"), LIMITS.items())
@table("before", [False, True])
def test_each_key_has_its_limit_in_two_halves(key: str, limit: int, before: bool) -> None:
    for count, over in ((limit, False), (limit + 1, True)):
        tick = at()
        counts = tuple(2 * before * (one == key) for one in LIMITS)
        tick.s.flood = Flood(tick.now_s - 0.1, (0,) * 6, counts)
        arrived = ArrivedAt(key, count - 2 * before)
        tick.inbox = replace(tick.inbox, arrived=(arrived,))
        message_limits.rate_limited(tick)
        assert (tick.s.flood.level_s > 0.0) is over
        assert tick.s.flood.key == (key if over else "")


@table(
    ("passed_s", "half_began", "counts", "before"),
    [
        (0.125 - EPS, False, 3, 2),
        (0.125 + EPS, True, 0, 3),
        (0.25 - EPS, True, 0, 3),
        (0.25 + EPS, True, 0, 0),
    ],
)
def test_halves_follow_each_other(
    passed_s: float, half_began: bool, counts: int, before: int
) -> None:
    had, older = (3, 0, 0, 0, 0, 0), (2, 0, 0, 0, 0, 0)
    turned = message_limits._half_windows(Flood(100.0, had, older), 100.0 + passed_s)
    assert turned[0][0] == counts
    assert turned[1][0] == before
    assert turned[2] == (100.0 + passed_s if half_began else 100.0)


NOW_S = 100.0
ONE, TWO, NONE = (1, 0, 0, 0, 0, 0), (2, 0, 0, 0, 0, 0), (0,) * 6


def counted(flood: Flood, arrived: tuple[ArrivedAt, ...] = ()) -> tuple[Flood, bool]:
    """Return the counts after a tick at 100 s, and whether nobody had to look at them."""
    tick = at()
    tick.now_s, tick.s.flood = NOW_S, flood
    tick.inbox = Inbox(arrived=arrived)
    assert rate_limited(tick) is tick.inbox
    return tick.s.flood, tick.s.flood is flood


@table(
    ("half_s", "counts", "before", "level_s"),
    [(0.0, (), (), 0.0), (NOW_S - 0.1, ONE, TWO, 0.0), (NOW_S - 0.1, ONE, (), 0.0)],
)
def test_where_nothing_came_and_no_half_is_over_nothing_is_counted(
    half_s: float, counts: tuple[int, ...], before: tuple[int, ...], level_s: float
) -> None:
    _, untouched = counted(Flood(half_s, counts, before, level_s, ""))
    assert untouched


@table(
    ("flood", "after"),
    [
        (Flood(NOW_S - 0.125, ONE, TWO), Flood(NOW_S, NONE, ONE)),
        (Flood(NOW_S - 0.2, ONE, ()), Flood(NOW_S, NONE, ONE)),
        (Flood(NOW_S - 0.25, ONE, TWO), Flood(NOW_S)),  # both halves are over: all is forgotten
        (Flood(NOW_S - 0.2, NONE, TWO), Flood(NOW_S)),
        (Flood(NOW_S - 0.1, ONE, TWO, 0.5, "cmd/hello"),
         Flood(NOW_S - 0.1, ONE, TWO, 0.4975, "cmd/hello")),
        (Flood(NOW_S - 0.1, NONE, TWO, 0.5), Flood(NOW_S - 0.1, NONE, TWO, 0.4975)),
    ],
)  # fmt: skip
def test_halves_end_and_the_window_drains_where_nothing_comes(flood: Flood, after: Flood) -> None:
    assert counted(flood)[0] == after


def test_what_comes_is_counted_by_its_key_alone() -> None:
    came = (ArrivedAt("cmd/teleop", 3), ArrivedAt("cmd/nobody", 9))
    flood, _ = counted(Flood(NOW_S - 0.1, ONE, TWO), came)
    assert flood == Flood(NOW_S - 0.1, (1, 3, 0, 0, 0, 0), TWO)


def test_of_a_flooded_key_nothing_is_heard_and_of_the_others_all() -> None:
    tick = at()
    beat = Heartbeat(planner_id="p1", epoch="b0-1", seen=1, used=1)
    stop = Stop(id="s1", source="test")
    came = (ArrivedAt("cmd/heartbeat", 14), ArrivedAt("cmd/waypoints", 4))
    horizon = reached("active").state.leg.horizon
    assert horizon is not None
    tick.inbox = Inbox(
        heartbeats=(beat, beat), waypoints=(horizon,), stops=(stop,), arrived=came
    )  # fmt: skip
    assert rate_limited(tick) == replace(tick.inbox, heartbeats=())
    assert (tick.dropped, tick.reasons) == (2, ["flood", "flood"])
    assert tick.s.flood.key == "cmd/heartbeat"
    assert tick.s.flood.level_s == pytest.approx(0.01)


@table(
    ("start", "key", "scored"),
    [
        ("active", "cmd/waypoints", True), ("active", "cmd/external", False),
        ("active", "cmd/teleop", False), ("active", "cmd/hello", False),
        ("active_external", "cmd/external", True), ("active_external", "cmd/waypoints", False),
        ("teleop", "cmd/teleop", True), ("disarmed", "cmd/waypoints", False),
    ],
)  # fmt: skip
def test_bytes_that_are_nothing_are_charged_to_whoever_may_use_their_key(
    start: str, key: str, scored: bool
) -> None:
    tick = at(start)
    tick.s.bad_bucket = 1.0
    message_limits.hear_rejected(tick)
    assert tick.s.bad_bucket == 1.0
    tick.inbox = Inbox(rejected=(RejectedAt(key, DecodeFailure("malformed", "no JSON")),))
    message_limits.hear_rejected(tick)
    assert tick.reasons == ["rejected_malformed"]
    assert tick.s.bad_bucket == 1.0 + scored


def test_a_bucket_of_ten_loses_one_in_half_a_second_and_one_per_good_message() -> None:
    tick = at()
    tick.s.bad_bucket, tick.dt_s = 0.0, 0.01
    for _ in range(12):
        message_limits.bad(tick, "bad")
    assert tick.s.bad_bucket == 10.0
    message_limits.drain(tick)
    message_limits.good(tick)
    assert tick.s.bad_bucket == 8.98
    tick.s.bad_bucket = 0.01
    message_limits.drain(tick)
    assert tick.s.bad_bucket == 0.0
    message_limits.drain(tick)
    message_limits.good(tick)
    assert tick.s.bad_bucket == 0.0
