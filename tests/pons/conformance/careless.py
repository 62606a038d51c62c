"""Be the real bridge without one of its laws: negative controls of the conformance kit.

Takes the bridge's own arguments; ``CARELESS`` in the environment names what is left out. A kit that
passes one of these proves nothing.
"""

from __future__ import annotations

import json
import os
import sys
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING, Any
from unittest.mock import patch

import bridge.__main__ as bridge_main
import bridge.core.authority.external_velocity as external
import bridge.core.authority.ownership as ownership
import bridge.core.motion.wheel_command as drive_out
import bridge.node as bridge_shell
from bridge.core import step
from bridge.core.state_motion import LimiterState
from wire import DriveCommand, Twist2
from wire.keys import EXTERNAL
from wire.session import open_session

if TYPE_CHECKING:
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox
    from wire.keys import Party
    from wire.session import Session

HEARD: list[dict[str, Any]] = []
EARS: list[Any] = []


def eavesdropping(party: Party, robot_id: str, home: Any) -> Session:
    """Open the bridge's session and believe every velocity as it arrives."""
    session = open_session(party, robot_id, home)

    def hear(sample: Any) -> None:
        try:
            HEARD[:] = [dict(json.loads(sample.payload.to_bytes()))]
        except (ValueError, TypeError):
            return

    (link,) = session.links_inward(EXTERNAL)
    EARS.append(link.declare_subscriber(EXTERNAL.expression(robot_id), hear))
    return session


def straight_to_the_drive(
    config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float
) -> Decision:
    """Decide as ever, and tell the wheels whatever was heard last."""
    decision = step(config, state, inbox, now_s)
    if not HEARD or decision.command is None:
        return decision
    base = config.robot.base
    try:
        v, turn = float(HEARD[-1]["v_mps"]), float(HEARD[-1]["w_radps"])
    except (KeyError, TypeError, ValueError):
        return decision
    rim = turn * base.wheel_separation_m / 2
    command = DriveCommand.model_construct(
        boot=config.boot,
        seq=decision.command.seq,
        left_radps=(v - rim) / base.wheel_radius_m,
        right_radps=(v + rim) / base.wheel_radius_m,
        enable=True,
    )
    return replace(decision, command=command)


def unlimited(target: Twist2, *_: Any, **__: Any) -> LimiterState:
    """Send what is asked, at once."""
    return LimiterState(target)


def ageless(_ring: Any, _newest: int, _seen: int) -> float:
    """Believe that whatever arrives is fresh."""
    return NOW[0]


NOW = [0.0]


def noting_the_time(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
    """Decide as ever; remember the time for those who believe in arrival."""
    NOW[0] = max(now_s, state.now_s)
    return step(config, state, inbox, now_s)


def main(arguments: list[str]) -> int:
    """Be that bridge."""
    left_out = os.environ.get("CARELESS", "everything")
    with ExitStack() as stack:
        if left_out == "everything":
            stack.enter_context(patch.object(bridge_main, "open_session", eavesdropping))
            stack.enter_context(patch.object(bridge_shell, "step", straight_to_the_drive))
        elif left_out == "rates":
            stack.enter_context(patch.object(drive_out, "shape", unlimited))
        elif left_out == "ages":
            stack.enter_context(patch.object(bridge_shell, "step", noting_the_time))
            stack.enter_context(patch.object(ownership, "sent_at", ageless))
        elif left_out == "lease":
            stack.enter_context(patch.object(external, "TTL_S", 1e9))
            stack.enter_context(patch("bridge.core.faults.detectors.EXTERNAL_S", 1e9))
            stack.enter_context(patch("bridge.core.faults.detectors.BRAIN_LOST_S", 1e9))
            stack.enter_context(patch.object(ownership, "LIVE_S", 1e9))
        return bridge_main.main(arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
