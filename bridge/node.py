"""Run the loop: drain, step, drive, publish, record. No `if` about driving lives here.

Owns the order of a tick and the way out. What may move is the core's word alone; what the shell
adds is that whatever ends the loop, the drive is halted.
"""

from __future__ import annotations

import logging
import secrets
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bridge.core import LoopFacts, initial, step
from bridge.core.authority.requests import find_verdict
from bridge.realtime.stats import LoopStats

if TYPE_CHECKING:
    from collections.abc import Callable

    from bridge.braking_file import BrakingKeeper
    from bridge.core import CoreConfig, Inbox
    from bridge.drive import Drive
    from bridge.fence_update import FenceDesk
    from bridge.link import BridgeLink
    from bridge.marks_update import MarksDesk
    from bridge.realtime import Pacer, PacerTick, SlackCollector
    from bridge.recording.recorder import Recorder
    from processes.service import Service

log = logging.getLogger("bridge")

EXIT_LEFT = 0
CHANCE_BYTES = 8
"""Drawn for each tick, 1.3 us: nonces are made of it."""
EXIT_BROKEN = 70
"""EX_SOFTWARE of sysexits.h: the step raised, which it never may."""


@dataclass(frozen=True, slots=True)
class Parts:
    """Hold the parts that the loop works with."""

    link: BridgeLink
    drive: Drive
    recorder: Recorder
    collector: SlackCollector
    service: Service
    keeper: BrakingKeeper
    desk: FenceDesk
    marks: MarksDesk


class BridgeNode:
    """Run the bridge's loop from the first tick to the halt."""

    def __init__(self, config: CoreConfig, parts: Parts, now_s: float, *, real_time: bool) -> None:
        self.state = initial(config, now_s)
        self._config = config
        self._parts = parts
        self._real_time = real_time
        self._stats = LoopStats()

    def run(self, pacer: Pacer, stopped: Callable[[], bool]) -> int:
        """Turn until told to stop; return the exit status. The drive is halted either way."""
        status = EXIT_LEFT
        try:
            while not stopped():
                self.tick(pacer.wait(), pacer.period_s)
                self._parts.collector.use(pacer.slack_s())
        except Exception:
            log.exception("bridge_broken: the loop raised; the drive is halted")
            status = EXIT_BROKEN
        finally:
            self._parts.drive.halt()
        return status

    def tick(self, tick: PacerTick, period_s: float) -> None:
        """Run one tick: drain, step, drive, publish, record."""
        parts = self._parts
        state, now_s = self.state, tick.now_s
        inbox = self._inbox(tick)
        began_ns = time.thread_time_ns()
        decision = step(self._config, state, inbox, now_s)
        step_ns = time.thread_time_ns() - began_ns
        parts.drive.write(decision.command)
        parts.link.publish(decision)
        parts.recorder.tick(state, inbox, now_s, decision)
        self.state = decision.state
        parts.keeper.note(decision.state.learnt)
        parts.desk.note(decision.state.fence_asked, now_s)
        parts.marks.note(decision.state.marks)
        self._stats.add(tick.late_s + tick.missed * period_s, step_ns)
        parts.service.feed(now_s)

    def _inbox(self, tick: PacerTick) -> Inbox:
        """Drain everything that arrived."""
        parts, figures = self._parts, self._stats.summary
        facts = LoopFacts(
            late_s=tick.late_s,
            missed_ticks=tick.missed,
            late_p50_us=figures.late_p50_us,
            late_max_us=figures.late_max_us,
            step_max_us=figures.step_max_us,
            record_gaps=parts.recorder.gaps,
        )
        return parts.link.drain(
            parts.drive.read(),
            facts,
            imu=parts.drive.take_imu(),
            fence_done=parts.desk.take(),
            marks_done=parts.marks.take(),
            real_time=self._real_time,
            recorder_says=parts.recorder.trouble,
            chance=secrets.token_hex(CHANCE_BYTES),
            is_repeat=lambda kind, request_id: (
                find_verdict(self.state.operator, kind, request_id, tick.now_s) is not None
            ),
        )
