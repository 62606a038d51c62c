"""Pace the bridge's loop: clock, real-time rights, garbage collection, systemd's watchdog."""

from bridge.realtime.clock import Clock, MonotonicClock
from bridge.realtime.collector import SlackCollector
from bridge.realtime.pacer import Pacer, PacerTick
from bridge.realtime.rights import (
    Right,
    all_granted,
    lock_memory,
    pin,
    take_fifo,
    transport_fifo,
)

__all__ = [
    "Clock",
    "MonotonicClock",
    "Pacer",
    "PacerTick",
    "Right",
    "SlackCollector",
    "all_granted",
    "lock_memory",
    "pin",
    "take_fifo",
    "transport_fifo",
]
