"""The dead-man of cmd_vel keeps its laws, on the robot and in the twin, which has the same one."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.pons_ros2.pons_ros2.dead_man import CmdVelDeadMan
from ros2.robot_words import RelayCommand, RelayState, encode_command, read_words
from wire import DriveCommand

TWIST = "geometry_msgs/msg/Twist"
TTL_S = 0.2
STOPPED = (0.0, 0.0, True)


def node(key: bytes = b"") -> CmdVelDeadMan:
    return CmdVelDeadMan("relay-1", key)


def says(made: CmdVelDeadMan, now_s: float) -> RelayState:
    """Return what Pons reads of its state."""
    return read_words(RelayState, made.state(now_s, now_s + 1e9, cmd_vel=TWIST, others=0).encode())


def words(seq: Any = 1, seen_s: float = 10.0, **more: Any) -> str:
    drive = DriveCommand(boot="boot1", seq=0, left_radps=1.0, right_radps=1.0, enable=True)
    command = RelayCommand(drive, "relay-1", seen_s, TTL_S, 0.3, 0.1)
    command = replace(command, **{k: v for k, v in more.items() if hasattr(command, k)})
    raw = json.loads(encode_command(command))
    return json.dumps(
        raw | {"seq": seq} | {k: v for k, v in more.items() if not hasattr(command, k)}
    )


def test_a_command_moves_until_its_end_on_the_nodes_clock_however_late_it_came() -> None:
    for late_s in (0.0, 0.1, 0.19):
        made = node()
        assert made.hear(words(seen_s=10.0), 10.0 + late_s)
        assert made.twist(10.0 + late_s) == (0.3, 0.1, False)
        assert made.twist(10.199) == (0.3, 0.1, False)
        assert made.twist(10.2001) == STOPPED


@pytest.mark.parametrize(
    "wrong",
    [
        {"seen_s": 9.7},
        {"seen_s": 10.5},
        {"relay": "relay-0"},
        {"ttl_s": 0.04},
        {"ttl_s": 3600.0},
        {"v_mps": 11.0},
        {"w_radps": -21.0},
        {"v": None},
        {"seq": "7"},
        {"seen": None},
        {"boot": 7},
        {"seq": -1},
        {"seq": 1 << 53},
        {"seen": 10**400},
        {"v": 10**400},
        {"seq": None},
    ],
)
def test_what_is_old_of_another_node_or_insane_moves_nothing(wrong: dict[str, Any]) -> None:
    made = node()
    assert not made.hear(words(**wrong), 10.01)
    assert made.twist(10.01) == STOPPED


@pytest.mark.parametrize(
    "text", ["", "[]", "7", "null", "{", '{"boot": "b"}', words()[:-9], "[" * 99_999]
)
def test_what_is_no_command_moves_nothing(text: str) -> None:
    made = node()
    assert not made.hear(text, 10.01)


@pytest.mark.parametrize("hole", ["NaN", "Infinity", "-Infinity"])
@pytest.mark.parametrize("name", ["v", "w", "seen", "ttl"])
def test_not_a_number_moves_nothing(hole: str, name: str) -> None:
    raw = json.loads(words())
    raw[name] = float(hole.replace("Infinity", "inf"))
    made = node()
    assert not made.hear(json.dumps(raw), 10.01)
    assert made.twist(10.01) == STOPPED


def test_a_repeated_or_older_number_is_no_sign_of_life_and_another_bridge_begins_again() -> None:
    made = node()
    assert made.hear(words(5, 10.0), 10.0)
    assert not made.hear(words(5, 10.1), 10.1)
    assert not made.hear(words(4, 10.1), 10.1)
    assert made.twist(10.21) == STOPPED
    assert made.hear(words(1, 10.2, boot="boot2"), 10.22)
    assert says(made, 10.22).echo_boot == "boot2"


def test_the_state_echoes_what_is_obeyed_and_tells_the_dead_man() -> None:
    made = node()
    before = says(made, 9.0)
    assert (before.echo_boot, before.echo_seq, before.timed_out) == (None, 0, True)
    made.hear(words(5, 10.0), 10.0)
    during = says(made, 10.1)
    assert (during.echo_boot, during.echo_seq, during.timed_out, during.on) == (
        "boot1", 5, False, True,
    )  # fmt: skip
    after = says(made, 10.3)
    assert (after.echo_seq, after.timed_out) == (5, True)
    assert (before.seq, during.seq, after.seq) == (1, 2, 3)
    assert after.t == 10.3


def test_without_torque_it_stands_and_has_not_timed_out() -> None:
    made = node()
    assert made.hear(words(on=False), 10.0)
    assert made.twist(10.1) == (0.0, 0.0, False)


KEY = b"a key of both ends"


def test_with_a_key_only_what_is_signed_with_it_moves_the_base() -> None:
    """A stranger on the network hears all that a command needs but the key."""
    made = node(KEY)
    assert says(made, 9.0).keyed
    drive = DriveCommand(boot="boot1", seq=5, left_radps=1.0, right_radps=1.0, enable=True)
    command = RelayCommand(drive, "relay-1", 10.0, TTL_S, 0.3, 0.1)
    plain, signed = (encode_command(command, key).decode() for key in (b"", KEY))
    other = encode_command(command, b"another key altogether").decode()
    spoilt = signed.replace('"v":0.3', '"v":0.9')
    for text in (plain, other, spoilt, signed[:-1], f"{plain} ", f"{plain} \ud800", " " + signed):
        assert not made.hear(text, 10.01)
    assert made.twist(10.01) == STOPPED
    assert made.hear(signed, 10.01)
    assert made.twist(10.02) == (0.3, 0.1, False)
    assert not made.hear(signed, 10.03), "nor does it count a second time"
    assert not node().hear(signed, 10.01), "a node without the key reads none of it"


@given(st.lists(st.tuples(st.floats(0.0, 0.3), st.booleans(), st.integers(1, 40)), max_size=40))
def test_whatever_is_said_it_moves_no_longer_than_a_command_lives(
    script: list[tuple[float, bool, int]],
) -> None:
    made, now_s, seen_s = node(), 100.0, 100.0
    for pause_s, hears_again, seq in script:
        now_s += pause_s
        if hears_again:
            seen_s = now_s
        if made.hear(words(seq, seen_s), now_s):
            assert now_s - seen_s < TTL_S
        assert made.twist(seen_s + TTL_S + 1e-9) == STOPPED
