"""Hold floods, a new epoch, ages and a tick's own questions to their numbers, by single calls."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core import ArrivedAt, Inbox
from bridge.core.authority.epoch import new_epoch
from bridge.core.authority.rate_limit import rate_limited
from bridge.core.geometry.message_age import append_sent, sensor_age_s, sent_at
from bridge.core.reporting.report import status_of
from bridge.core.state_orders import Grants, MissionLeft, Stick
from bridge.core.state_senses import Flood
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import Heartbeat, Stop

NOW_S = 100.0
ONE, TWO, NONE = (1, 0, 0, 0, 0, 0), (2, 0, 0, 0, 0, 0), (0,) * 6


def counted(flood: Flood, arrived: tuple[ArrivedAt, ...] = ()) -> tuple[Flood, bool]:
    """Return the counts after a tick at 100 s, and whether nobody had to look at them."""
    tick = tick_of(reached("active"))
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
    tick = tick_of(reached("active"))
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


@table(("start", "keep_stick"), [("active", False), ("active_external", True), ("teleop", True)])
def test_nothing_meant_for_the_old_epoch_outlives_it(start: str, keep_stick: bool) -> None:
    tick = tick_of(reached(start))
    s = tick.s
    s.ownership = replace(s.ownership, waypoints_seq=7, external_seq=8)
    s.leg = replace(reached("active").state.leg, refusal="fence")
    s.external = reached("active_external").state.external
    s.stick = stick = replace(reached("teleop").state.stick, seq=5)
    leg, epoch_no, owner = s.leg, s.epoch_no, s.ownership
    assert None not in (s.external, leg.horizon, leg.path)
    new_epoch(tick, "test", keep_stick=keep_stick)
    assert s.epoch_no == epoch_no + 1
    assert s.ownership == replace(owner, waypoints_seq=None, external_seq=None)
    assert s.leg == replace(leg, horizon=None, path=None, refusal=None)
    assert s.external is None
    assert s.stick == (replace(stick, seq=-1) if keep_stick else Stick())
    assert s.grants.mission is None
    assert tick.events == [("epoch", "test")]


def test_what_a_mission_may_still_use_goes_into_the_book_and_nothing_stays_granted() -> None:
    book = tuple(MissionLeft(f"m{i}", 1.0, 2.0) for i in range(64))
    after = Grants("m3", 5.0, 6.0, book, 7.0, 8.0, True).return_budget()
    rest = (*book[:3], *book[4:], MissionLeft("m3", 5.0, 6.0))
    assert after == Grants(None, 0.0, 0.0, rest, 7.0, 8.0, True)
    full = Grants("new", 5.0, 6.0, book).return_budget()
    assert full.book == (*book[1:], MissionLeft("new", 5.0, 6.0))
    assert after.return_budget() is after


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


@table(
    ("still_s", "heard_s", "seconds", "still"),
    [
        (1.0, 0.0, 1.0, True),
        (1.0, 0.25, 0.5, True),
        (1.0, 0.25 + 1e-9, 0.5, False),
        (1.0, None, 0.5, False),
        (None, 0.0, 0.0, False),
        (1.0, 0.0, 1.0 + 1e-6, False),
        (0.0, 0.0, 1e-9, True),
        (0.0, 0.0, 0.0, True),
    ],
)
def test_a_robot_stands_while_its_drive_says_so(
    still_s: float | None, heard_s: float | None, seconds: float, still: bool
) -> None:
    tick = tick_of(reached("active"))
    tick.now_s = 4.0
    tick.s.drive.still_since_s = None if still_s is None else tick.now_s - still_s
    tick.s.drive.received_s = None if heard_s is None else tick.now_s - heard_s
    assert tick.still_for(seconds) is still


def test_what_is_dropped_is_counted_once_and_its_reason_kept() -> None:
    tick: TickContext = tick_of(reached("active"))
    before = tick.s.voice
    tick.drop("repeated")
    assert (tick.dropped, tick.reasons, tick.s.voice) == (1, ["repeated"], before)
    status_of(tick, tick.s)
    assert tick.s.voice.dropped == before.dropped + 1
