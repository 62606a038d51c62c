"""What a home sends is an order or a refusal; a stop is always one, and a burst is none."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pons.mqtt.orders import (
    MAX_BYTES,
    MOST_AT_ONCE,
    QUIET_S,
    SETTLE_S,
    TOPICS,
    HomeOrder,
    MessageRefusal,
    OrderGate,
    read_order,
)

ROOMS = ("kitchen", "study")


def read(topic: str, payload: bytes, *, retained: bool = False) -> HomeOrder | MessageRefusal:
    return read_order(topic, payload, retained=retained, rooms=ROOMS)


@pytest.mark.parametrize(
    ("topic", "payload", "order"),
    [
        ("command", "start", HomeOrder("start")),
        ("command", "pause", HomeOrder("pause")),
        ("command", "return_to_base", HomeOrder("home")),
        ("command", "locate", HomeOrder("locate")),
        ("command", "stop", HomeOrder("stop")),
        ("sentence", "go to the kitchen", HomeOrder("sentence", text="go to the kitchen")),
        ("sentence", '{"command": "去厨房"}', HomeOrder("sentence", text="去厨房")),
        ("sentence", "stop", HomeOrder("stop")),
        ("sentence", '{"command": "停"}', HomeOrder("stop")),
        ("segments", '["study", "kitchen", "study"]', HomeOrder("rooms", rooms=ROOMS[::-1])),
        ("stop", "PRESS", HomeOrder("stop")),
    ],
)  # fmt: skip
def test_what_home_assistant_sends_is_an_order(topic: str, payload: str, order: HomeOrder) -> None:
    assert read(topic, payload.encode()) == order


@pytest.mark.parametrize(
    ("topic", "payload", "code"),
    [
        ("command", b"clean_spot", "mqtt_unknown_command"),
        ("command", b"\xff\xfe", "mqtt_unreadable"),
        ("command", b"", "mqtt_unreadable"),
        ("sentence", b"go to \x00 the kitchen", "mqtt_unreadable"),
        ("sentence", b"x" * (MAX_BYTES + 1), "mqtt_unreadable"),
        ("sentence", b'{"command": "go", "v_mps": 2}', "mqtt_bad_sentence"),
        ("sentence", b'{"command": 3}', "mqtt_bad_sentence"),
        ("sentence", b"{" * 1_500, "mqtt_bad_sentence"),
        ("segments", b"kitchen", "mqtt_bad_rooms"),
        ("segments", b"[]", "mqtt_bad_rooms"),
        ("segments", b"[" * 1_500, "mqtt_bad_rooms"),
        ("segments", b'["kitchen", "cellar"]', "mqtt_unknown_room"),
        ("segments", b'["kitchen", {"x_m": 1}]', "mqtt_unknown_room"),
    ],
)
def test_what_is_no_order_is_refused_with_a_code(topic: str, payload: bytes, code: str) -> None:
    refusal = read(topic, payload)
    assert isinstance(refusal, MessageRefusal)
    assert refusal.code == code


@pytest.mark.parametrize(
    ("topic", "payload"),
    [("command", b"start"), ("sentence", b"go home"), ("segments", b'["kitchen"]')],
)
def test_a_retained_order_moves_nothing(topic: str, payload: bytes) -> None:
    refusal = read(topic, payload, retained=True)
    assert isinstance(refusal, MessageRefusal)
    assert refusal.code == "mqtt_retained"


@pytest.mark.parametrize(
    ("topic", "payload"), [("command", b"stop"), ("stop", b"\xff"), ("sentence", b"halt")]
)
def test_a_stop_is_a_stop_also_retained(topic: str, payload: bytes) -> None:
    assert read(topic, payload, retained=True) == HomeOrder("stop")


@given(st.sampled_from(TOPICS), st.binary(max_size=200), st.booleans())
def test_no_bytes_raise(topic: str, payload: bytes, retained: bool) -> None:
    assert isinstance(read(topic, payload, retained=retained), HomeOrder | MessageRefusal)


HOME = HomeOrder("home")


def test_an_order_alone_is_due_once_it_is_clear_that_it_came_alone() -> None:
    gate = OrderGate()
    assert gate.offer(HOME, 10.0)
    assert gate.due(10.0 + SETTLE_S / 2) == []
    assert gate.due(10.0 + SETTLE_S) == [HOME]
    assert gate.due(11.0) == []


def test_an_hour_of_orders_at_once_is_none() -> None:
    gate = OrderGate()
    for number in range(3_600):
        gate.offer(HOME, 10.0 + number * 1e-3)
        assert gate.due(10.0 + number * 1e-3) == []
    assert gate.dropped == 3_600
    quiet_s = 10.0 + 3.6 + QUIET_S
    assert gate.offer(HOME, quiet_s)
    assert gate.due(quiet_s + SETTLE_S) == [HOME]


def test_what_a_hand_gives_passes() -> None:
    gate = OrderGate()
    assert all(gate.offer(HOME, 10.0) for _ in range(MOST_AT_ONCE))
    assert len(gate.due(11.0)) == MOST_AT_ONCE


def test_a_stop_takes_away_what_waits() -> None:
    gate = OrderGate()
    gate.offer(HOME, 10.0)
    gate.forget()
    assert gate.due(11.0) == []
