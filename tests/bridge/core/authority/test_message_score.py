"""Hold what bad messages cost, and how it is forgiven."""

from __future__ import annotations

from bridge.core import Inbox
from bridge.core.authority import message_score
from bridge.core.inbox import RejectedAt
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import Rejected


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
    tick = tick_of(reached(start))
    tick.s.bad_bucket = 1.0
    message_score.hear_rejected(tick)
    assert tick.s.bad_bucket == 1.0
    tick.inbox = Inbox(rejected=(RejectedAt(key, Rejected("malformed", "no JSON")),))
    message_score.hear_rejected(tick)
    assert tick.reasons == ["rejected_malformed"]
    assert tick.s.bad_bucket == 1.0 + scored


def test_a_bucket_of_ten_loses_one_in_half_a_second_and_one_per_good_message() -> None:
    tick = tick_of(reached("active"))
    tick.s.bad_bucket, tick.dt_s = 0.0, 0.01
    for _ in range(12):
        message_score.bad(tick, "bad")
    assert tick.s.bad_bucket == 10.0
    message_score.drain(tick)
    message_score.good(tick)
    assert tick.s.bad_bucket == 8.98
    tick.s.bad_bucket = 0.01
    message_score.drain(tick)
    assert tick.s.bad_bucket == 0.0
    message_score.drain(tick)
    message_score.good(tick)
    assert tick.s.bad_bucket == 0.0


def test_a_full_bucket_stays_full_and_an_empty_one_empty() -> None:
    tick = tick_of(reached("active"))
    tick.s.bad_bucket = 10.0
    message_score.bad(tick, "x")
    assert tick.s.bad_bucket == 10.0
