"""A base is driven by what its node and its odometry say, or it is not driven."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.relay_watch import SILENT_S
from ros2.ros_base import NOTHING_MADE, YOUNG_S, RosBase, TopicArrivals
from ros2.trouble import STARTING, Ros2Trouble
from tests.known import known
from tests.ros2.words import (
    STAMPED,
    command,
    driven,
    imu,
    odometry,
    robot,
    scan,
    state,
)
from wire import DriveState

SAID = {
    "state": state(10.1, 2), "odom": odometry(10.1), "scan": scan(10.1), "imu": imu(10.1),
}  # fmt: skip


def code_of(base: RosBase, now_s: float) -> str | None:
    trouble = base.judge(now_s)
    return trouble.code if trouble else None


def states(base: RosBase, now_s: float, **pose: object) -> list[DriveState]:
    made = base.hear("odom", odometry(now_s, **pose), now_s).state
    return [] if made is None else [made]


def keep_saying(base: RosBase, from_s: float, until_s: float, odom_hz: float = 50.0) -> None:
    """Let node, odometry, scan and gyro speak."""
    for tick in range(round((until_s - from_s) * 100)):
        now_s = from_s + tick / 100
        base.hear("state", state(now_s, 2 + tick), now_s)
        base.hear("imu", imu(now_s), now_s)
        if tick % round(100 / odom_hz) == 0:
            base.hear("odom", odometry(now_s), now_s)
        if tick % 10 == 0:
            base.hear("scan", scan(now_s), now_s)


def test_a_command_goes_to_the_node_that_spoke_with_the_time_that_it_said() -> None:
    words = known(driven(10.0).encode(command(5, left=1.0, right=2.0), 10.01))
    said = json.loads(words)
    assert (said["relay"], said["seen"], said["ttl"]) == ("relay-1", 17.0, 0.2)
    assert (said["boot"], said["seq"]) == ("boot1", 5)
    assert (said["v"], said["w"]) == (pytest.approx(0.15), pytest.approx(0.2))


def test_a_node_with_a_key_gets_signed_commands_or_none() -> None:
    without, with_key = driven(10.0), driven(10.0, b"0123456789abcdef")
    for base in (without, with_key):
        base.hear("state", state(10.01, 2, keyed=True), 10.01)
    assert without.encode(command(), 10.02) is None
    assert code_of(without, 10.02) == "ros2_relay_key"
    sent = known(with_key.encode(command(), 10.02))
    assert re.search(rb"} [0-9a-f]{64}$", sent)


def test_odometry_makes_a_drive_state_with_the_echo_of_the_node() -> None:
    base = driven(10.0)
    (first,) = states(base, 10.0)
    base.hear("state", state(10.02, 44, on=False), 10.02)
    (second,) = states(base, 10.02, x_m=0.01, v_mps=0.5, battery=0.5, bumper_front=True)
    assert (second.echo_boot, second.echo_seq, second.timed_out) == ("boot1", 44, False)
    assert (first.enabled, second.enabled) == (True, False)
    assert second.left_rad == pytest.approx(0.1)
    assert second.left_radps == pytest.approx(5.0)
    assert (second.boot_id, second.seq) == (first.boot_id, first.seq + 1)
    assert second.stamp_s == pytest.approx(10.02, abs=1e-5)
    assert (second.battery, second.bumper_front, second.cliff) == (0.5, True, False)


def test_an_input_that_the_robot_does_not_tell_is_not_told_to_the_bridge() -> None:
    (told,) = states(driven(10.0), 10.0, estop=None)
    assert told.estop_pressed is None, "which counts as pressed"


def test_a_timed_out_node_says_so() -> None:
    base = driven(10.0)
    base.hear("state", state(10.01, 2, timed_out=True), 10.01)
    (told,) = states(base, 10.02)
    assert (told.timed_out, told.enabled) == (True, False)


def test_scan_and_gyro_are_dated_by_the_nodes_clock() -> None:
    base = driven(10.0)
    heard = known(base.hear("scan", scan(9.9), 10.05).scan)
    assert heard.stamp_s == pytest.approx(9.9, abs=1e-5)
    assert (heard.seq, heard.ranges_m) == (1, (1.0, 2.0, None, 0.05))
    turned = known(base.hear("imu", imu(10.0), 10.01).imu)
    assert (turned.seq, turned.yaw_rate_radps) == (1, 0.5)


@pytest.mark.parametrize(
    ("wrong", "code"),
    [
        ({"others": 1}, "ros2_cmd_vel_shared"),
        ({"cmd_vel": ""}, "ros2_no_base"),
        ({"code": "ros2_topic_type", "found": "odom is a String"}, "ros2_topic_type"),
        ({"code": "of_a_newer_package"}, "ros2_relay_silent"),
    ],
)
def test_a_node_that_may_not_be_driven_by_gives_no_state_and_gets_no_command(
    wrong: dict[str, Any], code: str
) -> None:
    base = driven(10.0)
    base.hear("state", state(10.01, 2, **wrong), 10.01)
    assert states(base, 10.02) == []
    assert base.encode(command(), 10.02) is None
    assert base.unsent == 1
    assert code_of(base, 10.02) == code
    base.hear("state", state(10.03, 3), 10.03)
    assert len(states(base, 10.04)) == 1


def test_two_nodes_that_speak_by_turns_are_not_driven() -> None:
    base = driven(10.0)
    base.hear("state", state(10.01, 1, relay="relay-2"), 10.01)
    base.hear("state", state(10.02, 2), 10.02)
    assert base.encode(command(), 10.03) is None
    assert code_of(base, 10.03) == "ros2_two_robots"


def test_a_node_that_falls_silent_takes_the_states_along() -> None:
    base = driven(10.0)
    keep_saying(base, 10.01, 14.0)
    assert code_of(base, 14.0) is None
    assert states(base, 14.0 + SILENT_S) == []
    assert code_of(base, 14.1 + SILENT_S) == "ros2_relay_silent"


@pytest.mark.parametrize(
    ("name", "message", "code"),
    [
        ("odom", odometry(10.1, x_m=None), "ros2_unreadable"),
        ("odom", odometry(10.1).replace(b"0.0", b"NaN", 1), "ros2_unreadable"),
        ("odom", odometry(-3000.0), "ros2_clock"),
        ("scan", scan(10.1, ranges_m=[]), "ros2_unreadable"),
        ("scan", scan(12.0), "ros2_clock"),
        ("imu", b"{}", "ros2_unreadable"),
        ("imu", imu(10.1, 25.0), "ros2_unreadable"),
        ("state", b"\xff", "ros2_unreadable"),
    ],
)
def test_a_message_that_cannot_be_used_is_named_and_makes_nothing(
    name: str, message: bytes, code: str
) -> None:
    base = driven(10.0)
    assert base.hear(name, message, 10.1) == NOTHING_MADE
    assert base.unreadable == 1
    trouble = known(base.judge(10.11))
    assert (trouble.code, name in trouble.found) == (code, True)


def test_what_the_node_could_not_read_is_told_and_stops_nothing() -> None:
    base = driven(10.0)
    base.hear("state", state(10.01, 2, wrong="/scan: range_min 5"), 10.01)
    assert code_of(base, 10.02) == "ros2_unreadable"
    assert base.encode(command(), 10.02) is not None


def test_odometry_that_jumps_or_a_node_that_began_anew_is_a_drive_that_began_anew() -> None:
    base = driven(10.0)
    (first,) = states(base, 10.0)
    (jumped,) = states(base, 10.02, x_m=3.0)
    assert jumped.boot_id != first.boot_id
    base.hear("state", state(10.6, 1, relay="relay-2"), 10.6)
    (anew,) = states(base, 10.61, x_m=3.0)
    assert len({first.boot_id, jumped.boot_id, anew.boot_id}) == 3
    assert anew.seq > jumped.seq


def test_what_was_overtaken_on_its_way_counts_for_nothing() -> None:
    base = driven(10.0)
    assert len(states(base, 10.04)) == 1
    assert states(base, 10.02) == []
    base.hear("state", state(10.05, 1, echo_seq=9), 10.05)
    (said,) = states(base, 10.06)
    assert said.echo_seq == 1, "a state of the node that is not newer"


@pytest.mark.parametrize(("hz", "code"), [(50.0, None), (25.0, None), (10.0, "ros2_odom_slow")])
def test_odometry_that_is_too_slow_for_the_bridge_is_named(hz: float, code: str | None) -> None:
    base = driven(10.0)
    keep_saying(base, 10.0, 10.0 + YOUNG_S + 1.0, odom_hz=hz)
    assert code_of(base, 10.0 + YOUNG_S + 1.0) == code


def test_a_topic_that_says_nothing_is_named() -> None:
    base = driven(10.0)
    for tick in range(400):
        now_s = 10.0 + tick / 100
        base.hear("state", state(now_s, 2 + tick), now_s)
        base.hear("odom", odometry(now_s), now_s)
    trouble = known(base.judge(14.0))
    assert (trouble.code, "scan" in trouble.found) == ("ros2_topic_silent", True)


def test_a_connection_that_ends_ends_everything_until_the_node_speaks_anew() -> None:
    base = driven(10.0)
    base.close(Ros2Trouble("ros2_node_gone", "tcp/x: closed"))
    assert base.encode(command(), 10.1) is None
    assert code_of(base, 10.1) == "ros2_node_gone"
    assert states(base, 10.1) == []
    base.open(11.0)
    assert base.encode(command(), 11.0) is None
    assert code_of(base, 11.0) == STARTING


def test_scan_and_gyro_are_not_heard_where_robot_toml_has_none() -> None:
    assert RosBase(robot(scan=False, imu=False), "r").names == ("state", "odom")


def test_the_status_says_type_rates_and_counts() -> None:
    base = driven(10.0)
    keep_saying(base, 10.0, 14.0)
    base.encode(command(), 14.0)
    said = base.status(3, 14.0)
    assert (said.code, said.detail, said.cmd_vel) == (None, "", STAMPED)
    assert (said.odom_hz, said.scan_hz, said.sent, said.opened) == (50.0, 10.0, 1, 1)
    assert said.relay_hz == pytest.approx(100.0, abs=1.0)


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=12,
)


@given(
    st.sampled_from(sorted(SAID)),
    st.binary(max_size=40) | JSON.map(lambda x: json.dumps(x).encode()),
)
def test_no_message_raises_whatever_it_holds(name: str, message: bytes) -> None:
    assert driven(10.0).hear(name, message, 10.1) == NOTHING_MADE


@given(st.sampled_from(sorted(SAID)), st.integers(0, 60), JSON)
def test_no_hole_in_a_good_message_raises(name: str, step: int, value: object) -> None:
    words = json.loads(SAID[name])
    words[sorted(words)[step % len(words)]] = value
    driven(10.0).hear(name, json.dumps(words).encode(), 10.1)


def test_the_rate_is_that_of_the_last_two_seconds() -> None:
    topic = TopicArrivals()
    for at in range(100):
        topic.note(at * 0.02)
    assert topic.rate_hz(2.0) == 50.0
    assert topic.rate_hz(3.0) == 25.0
    assert topic.rate_hz(9.0) == 0.0


def test_silence_counts_from_the_newest_or_from_when_it_was_asked_for() -> None:
    topic = TopicArrivals()
    assert topic.silent_s(5.0, 6.0) == 1.0
    topic.note(5.5)
    assert topic.silent_s(5.0, 6.0) == 0.5
    assert topic.silent_s(5.75, 6.0) == 0.25


def test_a_refusal_is_remembered_for_two_seconds() -> None:
    topic = TopicArrivals()
    assert not topic.is_refused(0.0)
    topic.refuse("null", 1.0)
    assert topic.is_refused(2.9)
    assert not topic.is_refused(3.1)
