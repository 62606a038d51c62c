"""Be the real bridge process and note each command: ``python -m tools.bench.command_probe …``.

Takes the bridge's own arguments; writes ``commands.json`` into the home folder at its end: when
each command had left [s, monotonic], the speed that it means [m/s], the mode in which it was made.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING
from unittest.mock import patch

import bridge.__main__ as bridge_main
import bridge.node as bridge_shell
from bridge.core import step
from bridge.drive import SimDrive

if TYPE_CHECKING:
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox
    from wire import DriveCommand

KEPT = 200_000
"""Over half an hour; what comes later is not noted."""
NOTES: list[tuple[float, float, str]] = []
DECIDED: list[tuple[float, str]] = [(0.0, "")]


def noted_step(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
    """Take the core's step and keep what was decided until its command has left."""
    decision = step(config, state, inbox, now_s)
    decided = decision.state
    DECIDED[0] = (decided.motion.limiter.sent.v_mps, decided.mode.value)
    return decision


class NotedDrive(SimDrive):
    """Note when a command was handed to the transport."""

    def write(self, command: DriveCommand | None) -> None:
        super().write(command)
        if len(NOTES) < KEPT:
            NOTES.append((time.monotonic(), *DECIDED[0]))


def main(arguments: list[str]) -> int:
    """Be the bridge; write on the way out."""
    home = Path(arguments[arguments.index("--home") + 1])
    with (
        patch.object(bridge_main, "SimDrive", NotedDrive),
        patch.object(bridge_shell, "step", noted_step),
    ):
        try:
            return bridge_main.main(arguments)
        finally:
            (home / "commands.json").write_text(json.dumps(NOTES), "utf-8")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
