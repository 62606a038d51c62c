"""Take one tick."""

from __future__ import annotations

from bridge.core.config import CoreConfig
from bridge.core.decision import Decision
from bridge.core.inbox import Inbox
from bridge.core.state import BridgeState, draft
from wire import DriveCommand


def initial(config: CoreConfig, now_s: float) -> BridgeState:
    """Return the state before the first tick."""
    return BridgeState(now_s=now_s, started_s=now_s)


def step(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
    """Decide one tick. Same arguments, same decision. Never raises."""
    following = draft(state)
    following.now_s = now_s
    following.command_seq += 1
    seq = following.command_seq
    command = DriveCommand(boot=config.boot, seq=seq, left_radps=0.0, right_radps=0.0, enable=False)
    return Decision(following, command, None, None, (), ())
