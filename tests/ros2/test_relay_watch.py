"""One relay is believed; two that speak by turns are not."""

from __future__ import annotations

from ros2.relay import decode_state
from ros2.relay_watch import BOTH_S, SILENT_S, RelayWatch
from tests.ros2.frames import TYPES, relay_state

KIND = TYPES["/cmd_vel"]


def heard(watch: RelayWatch, name: str, seq: int, at_s: float) -> None:
    watch.hear(decode_state(relay_state(at_s, seq, relay=name)), at_s)


def known(watch: RelayWatch) -> str:
    return "" if watch.state is None else watch.state.relay


def code(watch: RelayWatch, now_s: float, kind: str = KIND) -> str | None:
    trouble = watch.refusal(now_s, kind)
    return trouble.code if trouble else None


def test_without_a_relay_there_is_nothing_to_refuse() -> None:
    assert RelayWatch("/cmd_vel", "/pons/state", has_key=False).refusal(1.0, KIND) is None


def test_a_relay_that_was_started_anew_is_the_relay() -> None:
    watch = RelayWatch("/cmd_vel", "/pons/state", has_key=False)
    heard(watch, "relay-1", 7, 1.0)
    heard(watch, "relay-2", 1, 1.01)
    assert known(watch) == "relay-1", "it may still be there"
    heard(watch, "relay-2", 2, 1.01 + SILENT_S)
    assert known(watch) == "relay-2"
    heard(watch, "relay-2", 3, 1.02 + SILENT_S)
    assert code(watch, 1.02 + SILENT_S) is None


def test_two_relays_that_speak_by_turns_are_two_robots_until_one_is_silent() -> None:
    watch = RelayWatch("/cmd_vel", "/pons/state", has_key=False)
    heard(watch, "relay-1", 1, 1.0)
    heard(watch, "relay-2", 1, 1.01)
    assert known(watch) == "relay-1", "the other is never driven"
    heard(watch, "relay-1", 2, 1.02)
    assert code(watch, 1.02) == "ros2_two_robots"
    found = watch.refusal(1.02, KIND)
    assert found is not None
    assert "relay-1" in found.found
    assert "relay-2" in found.found
    for seq in range(3, 300):
        heard(watch, "relay-1", seq, 1.0 + seq / 100)
    last_s = 1.01 + SILENT_S + BOTH_S
    assert code(watch, last_s - 0.02) == "ros2_two_robots"
    assert code(watch, last_s + 0.02) is None


def test_what_was_overtaken_is_not_heard() -> None:
    watch = RelayWatch("/cmd_vel", "/pons/state", has_key=False)
    heard(watch, "relay-1", 5, 1.0)
    heard(watch, "relay-1", 4, 1.01)
    assert watch.state is not None
    assert watch.state.seq == 5


def test_a_type_that_was_not_asked_can_not_disagree() -> None:
    watch = RelayWatch("/cmd_vel", "/pons/state", has_key=False)
    heard(watch, "relay-1", 1, 1.0)
    assert code(watch, 1.0, kind="") is None
    assert code(watch, 1.0, kind="geometry_msgs/msg/Twist") == "ros2_relay_disagrees"
    watch.forget()
    assert watch.state is None
