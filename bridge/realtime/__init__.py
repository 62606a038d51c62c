"""Wake the loop when it should be awake, and say honestly where the system refused to help."""

from bridge.realtime.clock import Clock, MonotonicClock
from bridge.realtime.collector import Collector
from bridge.realtime.pacer import Pacer, Tick
from bridge.realtime.rights import (
    Right,
    all_granted,
    lock_memory,
    pin,
    take_fifo,
    transport_fifo,
)
from bridge.realtime.service import Service

__all__ = [
    "Clock",
    "Collector",
    "MonotonicClock",
    "Pacer",
    "Right",
    "Service",
    "Tick",
    "all_granted",
    "lock_memory",
    "pin",
    "take_fifo",
    "transport_fifo",
]
