"""The dead-man keeps its laws: in the example, in the package pons_ros2 and in the twin."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import pytest
from hypothesis import given
from hypothesis import strategies as st

from examples.ros2_relay.relay import RelayDeadMan
from ros2.pons_ros2.pons_ros2.dead_man import CmdVelDeadMan
from ros2.relay import RelayCommand, decode_state, encode_command
from sim.twin.ros2_relay import RelayFirmware
from wire import DriveCommand

TWIST = "geometry_msgs/msg/Twist"
TTL_S = 0.2


class Relay(Protocol):
    boot: str

    def hear(self, text: str, now_s: float) -> bool: ...

    def moves(self, now_s: float) -> tuple[float, float, bool]: ...

    def says(self, now_s: float) -> str: ...


class Example:
    def __init__(self, key: bytes = b"") -> None:
        self.made = RelayDeadMan("relay-1", key)
        self.boot = self.made.boot

    def hear(self, text: str, now_s: float) -> bool:
        return self.made.hear(text, now_s)

    def moves(self, now_s: float) -> tuple[float, float, bool]:
        return self.made.twist(now_s)

    def says(self, now_s: float) -> str:
        return self.made.state(now_s, now_s + 1e9, TWIST, 0)


class Package:
    def __init__(self, key: bytes = b"") -> None:
        self.made = CmdVelDeadMan("relay-1", key)
        self.boot = self.made.boot

    def hear(self, text: str, now_s: float) -> bool:
        return self.made.hear(text, now_s)

    def moves(self, now_s: float) -> tuple[float, float, bool]:
        return self.made.twist(now_s)

    def says(self, now_s: float) -> str:
        return self.made.state(now_s, now_s + 1e9, cmd_vel=TWIST, others=0)


class Twin:
    def __init__(self, key: bytes = b"") -> None:
        self.made = RelayFirmware(TWIST, "relay-1", key)
        self.boot = self.made.boot

    def hear(self, text: str, now_s: float) -> bool:
        return self.made.hear(text, now_s)

    def moves(self, now_s: float) -> tuple[float, float, bool]:
        v_mps, w_radps, holds = self.made.twist(now_s)
        return v_mps, w_radps, not holds

    def says(self, now_s: float) -> str:
        return self.made.state(now_s, now_s + 1e9)


BOTH = pytest.mark.parametrize("made", [Example, Package, Twin], ids=["example", "package", "twin"])


def words(seq: Any = 1, seen_s: float = 10.0, **more: Any) -> str:
    drive = DriveCommand(boot="boot1", seq=0, left_radps=1.0, right_radps=1.0, enable=True)
    command = RelayCommand(drive, "relay-1", seen_s, TTL_S, 0.3, 0.1)
    command = replace(command, **{k: v for k, v in more.items() if hasattr(command, k)})
    raw = json.loads(encode_command(command)["data"])
    return json.dumps(
        raw | {"seq": seq} | {k: v for k, v in more.items() if not hasattr(command, k)}
    )


@BOTH
def test_a_command_moves_until_its_end_on_the_relays_clock_however_late_it_came(
    made: type[Example | Package | Twin],
) -> None:
    for late_s in (0.0, 0.1, 0.19):
        relay = made()
        assert relay.hear(words(seen_s=10.0), 10.0 + late_s)
        assert relay.moves(10.0 + late_s) == (0.3, 0.1, False)
        assert relay.moves(10.199) == (0.3, 0.1, False)
        assert relay.moves(10.2001) == (0.0, 0.0, True)


@BOTH
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
def test_what_is_old_of_another_relay_or_insane_moves_nothing(
    made: type[Example | Package | Twin], wrong: dict[str, Any]
) -> None:
    relay = made()
    assert not relay.hear(words(**wrong), 10.01)
    assert relay.moves(10.01) == (0.0, 0.0, True)


@BOTH
@pytest.mark.parametrize(
    "text", ["", "[]", "7", "null", "{", '{"boot": "b"}', words()[:-9], "[" * 99_999]
)
def test_what_is_no_command_moves_nothing(made: type[Example | Package | Twin], text: str) -> None:
    relay = made()
    assert not relay.hear(text, 10.01)


@BOTH
@pytest.mark.parametrize("hole", ["NaN", "Infinity", "-Infinity"])
@pytest.mark.parametrize("name", ["v", "w", "seen", "ttl"])
def test_not_a_number_moves_nothing(
    made: type[Example | Package | Twin], hole: str, name: str
) -> None:
    raw = json.loads(words())
    raw[name] = float(hole.replace("Infinity", "inf"))
    relay = made()
    assert not relay.hear(json.dumps(raw), 10.01)
    assert relay.moves(10.01) == (0.0, 0.0, True)


@BOTH
def test_a_repeated_or_older_number_is_no_sign_of_life_and_another_bridge_begins_anew(
    made: type[Example | Package | Twin],
) -> None:
    relay = made()
    assert relay.hear(words(5, 10.0), 10.0)
    assert not relay.hear(words(5, 10.1), 10.1)
    assert not relay.hear(words(4, 10.1), 10.1)
    assert relay.moves(10.21) == (0.0, 0.0, True)
    assert relay.hear(words(1, 10.2, boot="boot2"), 10.22)
    assert decode_state({"data": relay.says(10.22)}).echo_boot == "boot2"


@BOTH
def test_the_state_echoes_what_is_obeyed_and_tells_the_dead_man(
    made: type[Example | Package | Twin],
) -> None:
    relay = made()
    before = decode_state({"data": relay.says(9.0)})
    assert (before.echo_boot, before.echo_seq, before.timed_out) == (None, 0, True)
    relay.hear(words(5, 10.0), 10.0)
    during = decode_state({"data": relay.says(10.1)})
    assert (during.echo_boot, during.echo_seq, during.timed_out, during.on) == (
        "boot1", 5, False, True,
    )  # fmt: skip
    after = decode_state({"data": relay.says(10.3)})
    assert (after.echo_seq, after.timed_out) == (5, True)
    assert (before.seq, during.seq, after.seq) == (1, 2, 3)
    assert after.t == 10.3


@BOTH
def test_without_torque_it_stands_and_has_not_timed_out(
    made: type[Example | Package | Twin],
) -> None:
    relay = made()
    assert relay.hear(words(on=False), 10.0)
    assert relay.moves(10.1) == (0.0, 0.0, False)


KEY = b"a key of both ends"


@BOTH
def test_with_a_key_only_what_is_signed_with_it_moves_the_base(
    made: type[Example | Package | Twin],
) -> None:
    """A stranger at rosbridge hears all that a command needs but the key."""
    relay = made(KEY)
    assert decode_state({"data": relay.says(9.0)}).keyed
    drive = DriveCommand(boot="boot1", seq=5, left_radps=1.0, right_radps=1.0, enable=True)
    command = RelayCommand(drive, "relay-1", 10.0, TTL_S, 0.3, 0.1)
    plain, signed = (encode_command(command, key)["data"] for key in (b"", KEY))
    other = encode_command(command, b"another key altogether")["data"]
    spoilt = signed.replace('"v":0.3', '"v":0.9')
    for text in (plain, other, spoilt, signed[:-1], f"{plain} ", f"{plain} \ud800", " " + signed):
        assert not relay.hear(text, 10.01)
    assert relay.moves(10.01) == (0.0, 0.0, True)
    assert relay.hear(signed, 10.01)
    assert relay.moves(10.02) == (0.3, 0.1, False)
    assert not relay.hear(signed, 10.03), "nor does it count a second time"
    assert not made().hear(signed, 10.01), "a relay without the key reads none of it"


@given(st.lists(st.tuples(st.floats(0.0, 0.3), st.booleans(), st.integers(1, 40)), max_size=40))
def test_all_do_the_same_and_neither_moves_longer_than_a_command_lives(
    script: list[tuple[float, bool, int]],
) -> None:
    example, package, twin = Example(), Package(), Twin()
    now_s = seen_s = 100.0
    for pause_s, hears_anew, seq in script:
        now_s += pause_s
        if hears_anew:
            seen_s = now_s
        text = words(seq, seen_s)
        heard = example.hear(text, now_s)
        assert heard == package.hear(text, now_s) == twin.hear(text, now_s)
        assert example.moves(now_s) == package.moves(now_s) == twin.moves(now_s)
        assert example.moves(seen_s + TTL_S + 1e-9)[2]


def test_the_example_stands_alone_and_says_so_where_ros_is_missing(repository: Path) -> None:
    text = (repository / "examples" / "ros2_relay" / "relay.py").read_text()
    ours = ("wire", "ros2", "bridge", "processes", "devices", "sim", "pons")
    assert not [name for name in ours if f"import {name}" in text or f"from {name}" in text]
    assert "source ROS 2" in text
