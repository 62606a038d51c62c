"""A command carries its own end on the relay's clock; a state is read whole or refused."""

from __future__ import annotations

import json

import pytest

from ros2.relay import RelayCommand, decode_state, encode_command
from ros2.robot_words import Unreadable
from tests.ros2.frames import command, relay_state


def test_a_command_says_whose_clock_ends_it_and_when() -> None:
    words = RelayCommand(command(7), "relay-1", seen_s=12.5, ttl_s=0.2, v_mps=0.3, w_radps=-0.1)
    assert json.loads(encode_command(words)["data"]) == {
        "boot": "boot1", "seq": 7, "relay": "relay-1", "seen": 12.5, "ttl": 0.2, "on": True,
        "v": 0.3, "w": -0.1,
    }  # fmt: skip


def test_without_torque_there_is_no_speed() -> None:
    off = command().model_copy(update={"enable": False})
    said = json.loads(encode_command(RelayCommand(off, "r", 0.0, 0.2, 0.3, 0.1))["data"])
    assert (said["on"], said["v"], said["w"]) == (False, 0.0, 0.0)


def test_a_state_may_say_more_than_we_know() -> None:
    read = decode_state(relay_state(1.0, 3, newer="word"))
    assert (read.relay, read.seq, read.timed_out) == ("relay-1", 3, False)


@pytest.mark.parametrize(
    "message",
    [
        {},
        {"data": 7},
        {"data": "no JSON"},
        {"data": "[]"},
        {"data": "[" * 100_000},
        relay_state(1.0, -1),
        relay_state(1.0, 1, t=None),
        relay_state(1.0, 1, timed_out="no"),
        relay_state(1.0, 1, relay="a name with spaces"),
        {"data": relay_state(1.0, 1)["data"].replace("8.0", "NaN", 1)},
    ],
)
def test_what_is_no_state_is_refused(message: dict[str, object]) -> None:
    with pytest.raises(Unreadable):
        decode_state(message)
