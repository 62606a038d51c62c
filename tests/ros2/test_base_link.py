"""A base is driven by what its graph, its relay and its odometry say, or it is not driven."""

from __future__ import annotations

import json
import re
from math import sin
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2 import BaseLink
from ros2.base_link import ASK_S, YOUNG_S
from ros2.graph import GraphCheck
from ros2.operations import ServerWords
from ros2.relay_watch import SILENT_S
from ros2.transport import NOTHING_MADE
from ros2.trouble import STARTING, Ros2Trouble
from tests.ros2.frames import (
    TYPES,
    as_operations,
    command,
    driven,
    graph_answer,
    imu,
    odometry,
    on_topic,
    opened,
    relay_state,
    robot,
    scan,
)
from wire import DriveState

STATE = "/pons/state"


def code_of(link: BaseLink, now_s: float) -> str | None:
    trouble = link.judge(now_s)
    return trouble.code if trouble else None


def states(link: BaseLink, now_s: float, **pose: float) -> list[DriveState]:
    state = link.hear(on_topic("/odom", odometry(now_s, **pose)), now_s).state
    return [] if state is None else [state]


def keep_saying(link: BaseLink, from_s: float, until_s: float, odom_hz: float = 50.0) -> None:
    """Let relay, odometry, scan and gyro speak."""
    for tick in range(round((until_s - from_s) * 100)):
        now_s = from_s + tick / 100
        link.hear(on_topic(STATE, relay_state(now_s, 2 + tick)), now_s)
        link.hear(on_topic("/imu", imu(now_s)), now_s)
        if tick % round(100 / odom_hz) == 0:
            link.hear(on_topic("/odom", odometry(now_s)), now_s)
        if tick % 10 == 0:
            link.hear(on_topic("/scan", scan(now_s)), now_s)


def test_nothing_is_advertised_or_subscribed_before_the_graph_has_answered() -> None:
    link = BaseLink(robot(), "r")
    assert link.due(0.0) == [], "not connected"
    link.open(0.0)
    asked = as_operations(link.due(0.0))
    assert {one["op"] for one in asked} == {"call_service"}
    assert {one["args"]["topic"] for one in asked} == set(TYPES)
    for topic, kind in TYPES.items():
        link.hear(graph_answer(topic, kind), 0.1)
    sent = as_operations(link.due(0.1))
    assert [(one["op"], one["topic"]) for one in sent] == [
        ("advertise", "/pons/command"), ("subscribe", STATE), ("subscribe", "/odom"),
        ("subscribe", "/scan"), ("subscribe", "/imu"),
    ]  # fmt: skip
    assert link.due(0.2) == [], "once"
    assert len(link.due(ASK_S)) == len(TYPES), "the graph is asked anew"


def test_the_graph_is_asked_while_something_is_missing_and_not_in_mid_drive() -> None:
    link = driven(10.0)
    keep_saying(link, 10.01, 15.0)
    assert link.due(15.0) == []
    link.hear(on_topic(STATE, relay_state(15.0, 900, cmd_vel="")), 15.0)
    asked = [one["op"] for one in as_operations(link.due(15.01))]
    assert asked == ["call_service"] * len(TYPES)


def test_a_command_goes_to_the_relay_that_spoke_with_the_time_that_it_said() -> None:
    link = driven(10.0)
    words = link.encode(command(5, left=1.0, right=2.0), 10.01)
    assert words is not None
    assert words.topic == "/pons/command"
    said = json.loads(words.message["data"])
    assert (said["relay"], said["seen"], said["ttl"]) == ("relay-1", 17.0, 0.2)
    assert (said["boot"], said["seq"]) == ("boot1", 5)
    assert (said["v"], said["w"]) == (pytest.approx(0.15), pytest.approx(0.2))


def test_a_relay_with_a_key_gets_signed_commands_or_none() -> None:
    without, with_key = driven(10.0), driven(10.0, b"0123456789abcdef")
    for link in (without, with_key):
        link.hear(on_topic(STATE, relay_state(10.01, 2, keyed=True)), 10.01)
    assert without.encode(command(), 10.02) is None
    assert code_of(without, 10.02) == "ros2_relay_key"
    sent = with_key.encode(command(), 10.02)
    assert sent is not None
    assert re.search(r"} [0-9a-f]{64}$", str(sent.message["data"]))


def test_odometry_makes_a_drive_state_with_the_echo_of_the_relay() -> None:
    link = driven(10.0)
    (first,) = states(link, 10.0)
    link.hear(on_topic(STATE, relay_state(10.02, 44, on=False)), 10.02)
    (second,) = states(link, 10.02, x_m=0.01, v=0.5)
    assert (second.echo_boot, second.echo_seq, second.timed_out) == ("boot1", 44, False)
    assert (first.enabled, second.enabled) == (True, False)
    assert second.left_rad == pytest.approx(0.1)
    assert second.left_radps == pytest.approx(5.0)
    assert (second.boot_id, second.seq) == (first.boot_id, first.seq + 1)
    assert second.stamp_s == pytest.approx(10.02, abs=1e-5)
    assert (second.estop_pressed, second.bumper_front, second.cliff) == (False, False, False)


def test_scan_and_gyro_are_dated_by_the_relays_clock() -> None:
    link = driven(10.0)
    heard = link.hear(on_topic("/scan", scan(9.9)), 10.05).scan
    assert heard is not None
    assert heard.stamp_s == pytest.approx(9.9, abs=1e-5)
    assert (heard.seq, heard.ranges_m) == (1, (1.0, 2.0, None, 0.05))
    turned = link.hear(on_topic("/imu", imu(10.0)), 10.01).imu
    assert turned is not None
    assert (turned.seq, turned.yaw_rate_radps) == (1, 0.5)


@pytest.mark.parametrize(
    ("wrong", "code"),
    [
        ({"others": 1}, "ros2_cmd_vel_shared"),
        ({"cmd_vel": ""}, "ros2_no_base"),
        ({"cmd_vel": "geometry_msgs/msg/Twist"}, "ros2_relay_disagrees"),
    ],
)
def test_a_relay_that_may_not_be_driven_by_gives_no_state_and_gets_no_command(
    wrong: dict[str, Any], code: str
) -> None:
    link = driven(10.0)
    link.hear(on_topic(STATE, relay_state(10.01, 2, **wrong)), 10.01)
    assert states(link, 10.02) == []
    assert link.encode(command(), 10.02) is None
    assert link.unsent == 1
    assert code_of(link, 10.02) == code
    link.hear(on_topic(STATE, relay_state(10.03, 3)), 10.03)
    assert len(states(link, 10.04)) == 1


def test_a_relay_that_falls_silent_takes_the_states_along() -> None:
    link = driven(10.0)
    keep_saying(link, 10.01, 14.0)
    assert code_of(link, 14.0) is None
    assert states(link, 14.0 + SILENT_S) == []
    assert code_of(link, 14.1 + SILENT_S) == "ros2_relay_silent"


def test_while_the_relay_is_silent_zeros_go_straight_to_the_base() -> None:
    link = driven(10.0)
    asked = as_operations(link.due(10.0 + SILENT_S))
    assert [one for one in asked if one["op"] == "publish"] == []
    sent = as_operations(link.due(10.1 + SILENT_S))
    assert [(one["op"], one["topic"]) for one in sent] == [
        ("advertise", "/cmd_vel"), ("publish", "/cmd_vel"),
    ]  # fmt: skip
    assert sent[0]["type"] == TYPES["/cmd_vel"]
    link.hear(on_topic(STATE, relay_state(10.7, 2)), 10.7)
    assert [one["op"] for one in as_operations(link.due(10.7))] == ["unadvertise"]


@pytest.mark.parametrize(
    ("topic", "message", "code"),
    [
        ("/odom", odometry(10.1) | {"pose": None}, "ros2_unreadable"),
        ("/odom", odometry(-3000.0), "ros2_clock"),
        ("/scan", scan(10.1, ranges=None), "ros2_unreadable"),
        ("/scan", scan(12.0), "ros2_clock"),
        ("/imu", {"header": {}}, "ros2_unreadable"),
        (STATE, {"data": "{}"}, "ros2_unreadable"),
    ],
)
def test_a_message_that_cannot_be_used_is_named_and_makes_nothing(
    topic: str, message: dict[str, Any], code: str
) -> None:
    link = driven(10.0)
    assert link.hear(on_topic(topic, message), 10.1) == NOTHING_MADE
    assert link.unreadable == 1
    trouble = link.judge(10.11)
    assert trouble is not None
    assert (trouble.code, topic in trouble.found) == (code, True)


def test_odometry_that_jumps_or_a_relay_that_began_anew_is_a_drive_that_began_anew() -> None:
    link = driven(10.0)
    (first,) = states(link, 10.0)
    (jumped,) = states(link, 10.02, x_m=3.0)
    assert jumped.boot_id != first.boot_id
    link.hear(on_topic(STATE, relay_state(10.6, 1, relay="relay-2")), 10.6)
    (anew,) = states(link, 10.61, x_m=3.0)
    assert len({first.boot_id, jumped.boot_id, anew.boot_id}) == 3
    assert anew.seq > jumped.seq


def test_what_was_overtaken_on_its_way_counts_for_nothing() -> None:
    link = driven(10.0)
    assert len(states(link, 10.04)) == 1
    assert states(link, 10.02) == []
    link.hear(on_topic(STATE, relay_state(10.05, 1, echo_seq=9)), 10.05)
    (state,) = states(link, 10.06)
    assert state.echo_seq == 1, "a state of the relay that is not newer"


@pytest.mark.parametrize(("hz", "code"), [(50.0, None), (25.0, None), (10.0, "ros2_odom_slow")])
def test_odometry_that_is_too_slow_for_the_bridge_is_named(hz: float, code: str | None) -> None:
    link = driven(10.0)
    keep_saying(link, 10.0, 10.0 + YOUNG_S + 1.0, odom_hz=hz)
    assert code_of(link, 10.0 + YOUNG_S + 1.0) == code


def test_a_topic_that_says_nothing_is_named() -> None:
    link = driven(10.0)
    for tick in range(400):
        now_s = 10.0 + tick / 100
        link.hear(on_topic(STATE, relay_state(now_s, 2 + tick)), now_s)
        link.hear(on_topic("/odom", odometry(now_s)), now_s)
    trouble = link.judge(14.0)
    assert trouble is not None
    assert (trouble.code, "/scan" in trouble.found) == ("ros2_topic_silent", True)


def test_what_the_server_refuses_is_passed_on_for_a_while() -> None:
    link = driven(10.0)
    link.hear(ServerWords("error", "no match found"), 10.1)
    trouble = link.judge(10.2)
    assert trouble is not None
    assert (trouble.code, "no match" in trouble.found) == ("ros2_server_refuses", True)
    assert code_of(link, 16.0) != "ros2_server_refuses"


def test_a_connection_that_ends_ends_everything_until_the_graph_has_answered_anew() -> None:
    link = driven(10.0)
    link.close(Ros2Trouble("ros2_server_gone", "ws://x: closed"))
    assert link.encode(command(), 10.1) is None
    assert (link.due(10.1), code_of(link, 10.1)) == ([], "ros2_server_gone")
    link.open(11.0)
    assert link.encode(command(), 11.0) is None
    assert code_of(link, 11.0) == STARTING
    assert states(link, 11.0) == []
    assert len(link.due(11.0)) == len(TYPES)


def test_scan_and_gyro_are_left_out_where_robot_toml_names_none() -> None:
    link = opened(10.0, scan=None, imu=None)
    topics = {one.get("topic") for one in as_operations(link.due(10.0))}
    assert topics == {"/pons/command", STATE, "/odom"}
    assert link.hear(on_topic("/scan", scan(10.0)), 10.0) == NOTHING_MADE


def test_the_status_says_types_rates_and_counts() -> None:
    link = driven(10.0)
    keep_saying(link, 10.0, 14.0)
    link.sent = 7
    said = link.status(3, 14.0)
    assert (said.code, said.detail, said.cmd_vel) == (None, "", TYPES["/cmd_vel"])
    assert (said.odom_hz, said.scan_hz, said.sent, said.opened) == (50.0, 10.0, 7, 1)
    assert said.relay_hz == pytest.approx(100.0, abs=1.0)


def test_needs_are_as_robot_toml_names_them() -> None:
    ros2 = robot(cmd_vel="/base/cmd", odom="/base/odom", relay="/guard").ros2
    assert ros2 is not None
    needed = {need.key: need.topic for need in GraphCheck(ros2).needs}
    assert needed["cmd_vel"] == "/base/cmd"
    assert (needed["odom"], needed["relay"]) == ("/base/odom", "/guard/state")


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        ("/imu", imu(10.1, yaw_rate=25.0)),
        ("/imu", imu(10.1) | {"linear_acceleration": {"x": 5e3, "y": 0.0}}),
        ("/scan", scan(10.1, ranges=[1.0, 2.0], angle_increment=2.0)),
        ("/odom", odometry(10.1, x_m=9e11)),
    ],
)
def test_what_is_beyond_the_wire_is_refused_and_ends_nothing(
    topic: str, message: dict[str, Any]
) -> None:
    link = driven(10.0)
    states(link, 10.0)
    heard = link.hear(on_topic(topic, message), 10.1)
    assert heard == NOTHING_MADE or (heard.state is not None and heard.state.left_rad == 0.0)
    assert link.unreadable == (heard == NOTHING_MADE)


@pytest.mark.parametrize("angle_rad", [-1e9, -7.0, 7.0, 20.0, 1e9])
def test_a_scan_may_count_its_angles_from_anywhere(angle_rad: float) -> None:
    heard = driven(10.0).hear(on_topic("/scan", scan(10.1, angle_min=angle_rad)), 10.1).scan
    assert heard is not None
    assert sin(heard.angle_min_rad) == pytest.approx(sin(angle_rad), abs=1e-6)


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=12,
)


@given(st.sampled_from([*TYPES, "/other"]), st.dictionaries(st.text(max_size=8), JSON))
def test_no_message_raises_whatever_it_holds(topic: str, message: dict[str, Any]) -> None:
    assert driven(10.0).hear(on_topic(topic, message), 10.1) == NOTHING_MADE


@given(
    st.sampled_from(["/odom", "/scan", "/imu"]),
    st.lists(st.integers(0, 60), min_size=1, max_size=3),
    JSON,
)
def test_no_hole_in_a_good_message_raises(topic: str, path: list[int], value: object) -> None:
    message = {"/odom": odometry(10.1), "/scan": scan(10.1), "/imu": imu(10.1)}[topic]
    inner: Any = message
    for at, step in enumerate(path):
        if not isinstance(inner, dict) or not inner:
            break
        name = sorted(inner)[step % len(inner)]
        if at == len(path) - 1:
            inner[name] = value
        inner = inner[name]
    driven(10.0).hear(on_topic(topic, message), 10.1)
