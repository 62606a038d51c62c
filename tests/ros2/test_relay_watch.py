"""One node is believed, two that speak by turns are not, and stamps are dated by its clock."""

from __future__ import annotations

import pytest

from ros2.relay_watch import BOTH_S, SILENT_S, RelayWatch, RosClock
from ros2.robot_words import RelayState, Unreadable, read_words
from tests.ros2.words import ROS_S, state

PEER = "tcp/127.0.0.1:7448"


def heard(watch: RelayWatch, name: str, seq: int, at_s: float) -> None:
    watch.hear(read_words(RelayState, state(at_s, seq, relay=name)), at_s)


def known(watch: RelayWatch) -> str:
    return "" if watch.state is None else watch.state.relay


def code(watch: RelayWatch, now_s: float) -> str | None:
    trouble = watch.refusal(now_s)
    return trouble.code if trouble else None


def test_without_a_relay_there_is_nothing_to_refuse() -> None:
    assert RelayWatch(PEER, has_key=False).refusal(1.0) is None


def test_a_relay_that_was_started_anew_is_the_relay() -> None:
    watch = RelayWatch(PEER, has_key=False)
    heard(watch, "relay-1", 7, 1.0)
    heard(watch, "relay-2", 1, 1.01)
    assert known(watch) == "relay-1", "it may still be there"
    heard(watch, "relay-2", 2, 1.01 + SILENT_S)
    assert known(watch) == "relay-2"
    heard(watch, "relay-2", 3, 1.02 + SILENT_S)
    assert code(watch, 1.02 + SILENT_S) is None


def test_two_relays_that_speak_by_turns_are_two_robots_until_one_is_silent() -> None:
    watch = RelayWatch(PEER, has_key=False)
    heard(watch, "relay-1", 1, 1.0)
    heard(watch, "relay-2", 1, 1.01)
    assert known(watch) == "relay-1", "the other is never driven"
    heard(watch, "relay-1", 2, 1.02)
    assert code(watch, 1.02) == "ros2_two_robots"
    found = watch.refusal(1.02)
    assert found is not None
    assert "relay-1" in found.found
    assert "relay-2" in found.found
    for seq in range(3, 300):
        heard(watch, "relay-1", seq, 1.0 + seq / 100)
    last_s = 1.01 + SILENT_S + BOTH_S
    assert code(watch, last_s - 0.02) == "ros2_two_robots"
    assert code(watch, last_s + 0.02) is None


def test_what_was_overtaken_is_not_heard() -> None:
    watch = RelayWatch(PEER, has_key=False)
    heard(watch, "relay-1", 5, 1.0)
    heard(watch, "relay-1", 4, 1.01)
    assert watch.state is not None
    assert watch.state.seq == 5


def test_nothing_of_the_former_robot_is_believed_behind_the_next_connection() -> None:
    watch = RelayWatch(PEER, has_key=False)
    heard(watch, "relay-1", 1, 1.0)
    watch.forget()
    assert watch.state is None
    assert code(watch, 1.0) is None


def test_a_stamp_is_dated_by_the_least_delayed_state() -> None:
    clock = RosClock()
    for at_s, delay_s in ((1.0, 0.03), (1.1, 0.002), (1.2, 0.05)):
        clock.note(ROS_S + at_s, at_s + delay_s)
    assert clock.date(ROS_S + 1.15, 1.3) == pytest.approx(1.152, abs=1e-6)


def test_nothing_is_dated_later_than_it_came() -> None:
    clock = RosClock()
    clock.note(ROS_S + 1.0, 1.0)
    assert clock.date(ROS_S + 1.02, 1.0) == 1.0


@pytest.mark.parametrize("off_s", [-1.1, 0.1, 3600.0, -ROS_S])
def test_a_stamp_of_another_clock_is_refused(off_s: float) -> None:
    clock = RosClock()
    clock.note(ROS_S + 1.0, 1.0)
    with pytest.raises(Unreadable, match="node's clock"):
        clock.date(ROS_S + 1.0 + off_s, 1.0)


def test_before_a_node_spoke_nothing_can_be_dated() -> None:
    clock = RosClock()
    with pytest.raises(Unreadable, match="before the node"):
        clock.date(ROS_S, 1.0)
    clock.note(ROS_S, 1.0)
    clock.reset()
    with pytest.raises(Unreadable, match="before the node"):
        clock.date(ROS_S, 1.0)
