"""The warm-up touches what a tick may touch, and leaves nothing behind."""

from __future__ import annotations

from dataclasses import fields

from bridge import warmup
from bridge.core import Inbox
from tests.bridge.ground import core_config

CONFIG = core_config()


def test_every_kind_of_arrival_is_in_it() -> None:
    seen: set[str] = set()
    for count in range(60):
        inbox = warmup._inbox(CONFIG, count, 100.0, 1)
        seen |= {item.name for item in fields(Inbox) if getattr(inbox, item.name)}
    without = {"external", "real_time"}  # a Velocity like teleop's; a flag
    assert seen == {item.name for item in fields(Inbox)} - without


def test_it_runs_through_and_serialises() -> None:
    assert warmup.warm_up(CONFIG, 100.0) > 100_000
