"""Decide purely: same state, inbox and time, same decision.

This door gives ``initial`` and ``step`` and the records they speak in. Nothing below imports time,
sockets, logging, random or threads.
"""

from bridge.core.config import CoreConfig
from bridge.core.decision import Decision
from bridge.core.inbox import (
    EMPTY,
    ON_TIME,
    ArrivedAt,
    Inbox,
    LoopFacts,
    OperatorArrival,
    RejectedAt,
)
from bridge.core.state import BridgeState
from bridge.core.step import initial, step

__all__ = [
    "EMPTY",
    "ON_TIME",
    "ArrivedAt",
    "BridgeState",
    "CoreConfig",
    "Decision",
    "Inbox",
    "LoopFacts",
    "OperatorArrival",
    "RejectedAt",
    "initial",
    "step",
]
