"""A drain is one ring at most, however fast others fill it up again."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from wire.keys import HEARTBEAT, STATUS, Key
from wire.session import Subscriber


@pytest.mark.parametrize("key", [HEARTBEAT, STATUS])
def test_an_endless_flood_is_not_drained_for_ever(key: Key[Any]) -> None:
    sample = SimpleNamespace(payload=SimpleNamespace(to_bytes=lambda: b"{}"))
    endless = SimpleNamespace(try_recv=lambda: sample)
    session: Any = SimpleNamespace(declare_subscriber=lambda _expression, _ring: endless)
    subscriber = Subscriber(session, key, "r1")
    assert len(subscriber.drain_bytes()) == key.ring
