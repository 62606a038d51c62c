"""Be the real bridge process with a stopwatch at its edges: ``python -m tools.bench.tick_probe …``.

Takes the bridge's own arguments. Its loop, core, link and drive are the shipped ones; what is added
notes when ticks were due, when waypoints arrived, when each command left and what it means, and
when the loss of the brain was decided. At its end it writes ``tap.json`` into the home folder.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any
from unittest.mock import patch

import bridge.__main__ as bridge_main
import bridge.node as bridge_shell
from bridge.core import step
from bridge.drive import SimDrive
from bridge.link import BridgeLink
from bridge.realtime import Pacer
from wire import Mode, Waypoints, decode
from wire.keys import WAYPOINTS
from wire.session import open_session

if TYPE_CHECKING:
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox
    from bridge.realtime import PacerTick
    from wire import DriveCommand
    from wire.keys import Party
    from wire.session import Session

KEPT_TICKS = 200_000
"""Over half an hour; what comes later is not noted."""


class Tap:
    """Collect in memory; nothing is written while the loop turns."""

    def __init__(self) -> None:
        self.due_s = 0.0
        self.carries_waypoints = False
        self.arrivals: list[tuple[float, bytes]] = []
        self.wheel_us: list[float] = []
        self.late_us: list[float] = []
        self.step_us: list[float] = []
        self.silences: list[dict[str, Any]] = []
        self.decided = (0.0, "")
        """The speed that the newest decision means [m/s], and its mode."""
        self.commands: list[tuple[float, float, str]] = []
        """When a command had left [s, monotonic], and what it means."""
        self.was_lost = False
        self.ears: Any = None
        """Kept here: a subscriber is undeclared with its last reference."""

    def note_arrival(self, sample: Any) -> None:
        """Note a horizon's arrival, from the transport's own thread."""
        self.arrivals.append((time.monotonic(), sample.payload.to_bytes()))

    def dump(self, path: Path) -> None:
        """Write all of it."""
        first: dict[str, float] = {}
        for at_s, payload in self.arrivals:
            horizon = decode(WAYPOINTS, payload)
            if isinstance(horizon, Waypoints) and horizon.points:
                first.setdefault(horizon.mission, at_s)
        names = ("wheel_us", "late_us", "step_us", "silences", "commands")
        content = {name: getattr(self, name) for name in names}
        path.write_text(json.dumps({**content, "first_waypoint_s": first}), "utf-8")


TAP = Tap()


class TappedPacer(Pacer):
    """Note when each tick was due and how late it began."""

    def wait(self) -> PacerTick:
        tick = super().wait()
        TAP.due_s = tick.now_s - tick.late_s
        if len(TAP.late_us) < KEPT_TICKS:
            TAP.late_us.append((tick.late_s + tick.missed * self.period_s) * 1e6)
        return tick


class TappedLink(BridgeLink):
    """Note which ticks carry waypoints."""

    def drain(self, *arguments: Any, **named: Any) -> Inbox:
        inbox = super().drain(*arguments, **named)
        TAP.carries_waypoints = any(horizon.points for horizon in inbox.waypoints)
        return inbox


class TappedDrive(SimDrive):
    """Note when a command was handed to the transport."""

    def write(self, command: DriveCommand | None) -> None:
        super().write(command)
        if len(TAP.commands) < KEPT_TICKS:
            TAP.commands.append((time.monotonic(), *TAP.decided))
        if TAP.carries_waypoints:
            TAP.wheel_us.append((time.monotonic() - TAP.due_s) * 1e6)


def tapped_step(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
    """Take the core's step; note its cost while driving, and when the brain's loss was decided."""
    began_ns = time.thread_time_ns()
    decision = step(config, state, inbox, now_s)
    took_us = (time.thread_time_ns() - began_ns) / 1e3
    if state.mode is Mode.ACTIVE and len(TAP.step_us) < KEPT_TICKS:
        TAP.step_us.append(took_us)
    TAP.decided = (decision.state.motion.limiter.sent.v_mps, decision.state.mode.value)
    _note_silence(state, decision, now_s)
    return decision


def _note_silence(state: BridgeState, decision: Decision, now_s: float) -> None:
    """Note, at the tick where BRAIN_LOST rises, how old the newest echoed status is."""
    lost = any(stage.startswith("BRAIN_LOST") for stage in decision.state.rows)
    if lost and not TAP.was_lost:
        echo_s = decision.state.ownership.echo_s
        TAP.silences.append(
            {
                "at_s": now_s,
                "age_s": None if echo_s is None else now_s - echo_s,
                "from": state.mode.value,
                "to": decision.state.mode.value,
                "beside": [stage for stage in state.rows if not stage.startswith("BRAIN")],
            }
        )
    TAP.was_lost = lost


def tapped_session(party: Party, robot_id: str, home: Path) -> Session:
    """Open the bridge's session and listen to its waypoints a second time, with a callback."""
    session = open_session(party, robot_id, home)
    (inner,) = session.links_inward(WAYPOINTS)  # the loop's own ring can't be stamped at arrival
    TAP.ears = inner.declare_subscriber(WAYPOINTS.expression(robot_id), TAP.note_arrival)
    return session


def main(arguments: list[str]) -> int:
    """Be the bridge; dump on the way out."""
    home = Path(arguments[arguments.index("--home") + 1])
    with (
        patch.object(bridge_main, "Pacer", TappedPacer),
        patch.object(bridge_main, "BridgeLink", TappedLink),
        patch.object(bridge_main, "SimDrive", TappedDrive),
        patch.object(bridge_main, "open_session", tapped_session),
        patch.object(bridge_shell, "step", tapped_step),
    ):
        try:
            return bridge_main.main(arguments)
        finally:
            TAP.dump(home / "tap.json")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
