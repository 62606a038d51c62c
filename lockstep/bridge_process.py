"""Be the bridge's process, one turn per tick: its real link and drive around its real core.

Only the shell's clock, recorder and real-time rights are missing; loop facts say that every tick is
on time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, cast

from bridge.core import ON_TIME, BridgeState, CoreConfig, Decision, Inbox, initial
from bridge.core.inbox import FenceDone
from bridge.core.state_orders import PendingMarks
from bridge.drive import Drive, SimDrive
from bridge.link import BridgeLink
from bridge.marks_update import read_marks
from wire import VIRTUAL_KEY, ConfigError, DriveCommand, Event, Status

if TYPE_CHECKING:
    from lockstep.bus import Port
    from wire.session import Session

Step = Callable[[CoreConfig, BridgeState, Inbox, float], Decision]

KEPT_COMMANDS = 120_000
"""Twenty simulated minutes."""
KEPT_STATUSES = 4_000
KEPT_EVENTS = 4_000


class BridgeProcess:
    """Connect the core to the bus and remember what it said."""

    def __init__(
        self,
        config: CoreConfig,
        port: Port,
        step: Step,
        now_s: float,
        drive: Drive | None = None,
    ) -> None:
        self.config = config
        self.state: BridgeState = initial(config, now_s)
        self.decision: Decision | None = None
        self.commands: deque[DriveCommand | None] = deque(maxlen=KEPT_COMMANDS)
        self.statuses: deque[Status] = deque(maxlen=KEPT_STATUSES)
        self.events: deque[Event] = deque(maxlen=KEPT_EVENTS)
        self.reasons: tuple[str, ...] = ()
        self._step = step
        self._asked: PendingMarks | None = None
        session = cast("Session", port)  # a port has a session's publishers and subscribers
        self._link = BridgeLink(session, config.robot.id, VIRTUAL_KEY)
        self._drive = drive or SimDrive(session, config.boot)

    def _prepare(self) -> FenceDone | None:
        """Do a tick later what the desk does in its thread; nothing is written."""
        asked, self._asked = self._asked, self.state.marks.asked
        fence = self.config.fence
        if asked is None or asked is not self._asked or fence is None:
            return None
        try:
            read_marks(asked.text, self.config.map_id)
        except ConfigError as wrong:
            return FenceDone(asked.id, wrong.code, wrong.detail[:400])
        fence.with_marks(asked.text)
        return FenceDone(asked.id, "ok", "prepared")

    def turn(self, now_s: float) -> Decision:
        """Drain, step, drive, tell: the shell's tick."""
        chance = (
            f"{self.state.tick:016x}"  # foretold by all, so that runs repeat: nobody signs here
        )
        inbox = self._link.drain(
            self._drive.read(),
            ON_TIME,
            real_time=True,
            chance=chance,
            imu=self._drive.take_imu(),
            marks_done=self._prepare(),
        )
        decision = self._step(self.config, self.state, inbox, now_s)
        self._drive.write(decision.command)
        self._link.publish(decision)
        self.state, self.decision, self.reasons = decision.state, decision, decision.reasons
        self.commands.append(decision.command)
        if decision.status is not None:
            self.statuses.append(decision.status)
        self.events.extend(decision.events)
        return decision
