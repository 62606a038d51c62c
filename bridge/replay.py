"""Run recordings again through the core and compare every command exactly.

Knows the recorder's reading door and the core; no clock, no drive. A recorded state, where a
segment or a file begins, is compared with the one that the replay has reached: an error that moves
no wheel shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bridge.core import step
from bridge.recording.recording_reader import (
    BadRecording,
    Header,
    StateFrame,
    TickFrame,
    config_of,
    read_recording,
    this_core,
)

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from bridge.core import BridgeState, CoreConfig
    from bridge.recording.recording_reader import Frame

__all__ = ["BadRecording", "ReplayReport", "replay"]


@dataclass(frozen=True, slots=True)
class ReplayReport:
    """Count a replay's ticks, gaps and differences."""

    ticks: int
    differing: int
    """Ticks whose command or mode came out otherwise, and states that were not reached."""
    gaps: int
    """Ticks that were not recorded, between the first and the last that were."""
    first_difference: str | None
    other_core: str | None
    """The core that recorded, where its shape is not this one's: differences may come from that."""


def replay(paths: Iterable[Path]) -> ReplayReport:
    """Run every recorded tick again; files of one run, given in order, are one run.

    Raises:
        BadRecording: a file is no recording.
    """
    run = _Replay()
    for path in paths:
        before = run.frames
        for frame in read_recording(path):
            run.take(frame)
        if run.frames == before:
            raise BadRecording("recording_empty", f"{path} holds no whole record")
    return ReplayReport(run.ticks, run.differing, run.gaps, run.first_difference, run.other_core)


class _Replay:
    """Carry configuration and state from one recorded frame to the next."""

    def __init__(self) -> None:
        self._header: Header | None = None
        self._config: CoreConfig | None = None
        self._state: BridgeState | None = None
        self._core = this_core()
        self.frames = self.ticks = self.differing = self.gaps = 0
        self.first_difference: str | None = None
        self.other_core: str | None = None

    def take(self, frame: Frame) -> None:
        """Replay one frame."""
        self.frames += 1
        match frame:
            case Header():
                self._configure(frame)
            case StateFrame():
                self._arrive(frame.state)
            case TickFrame():
                self._step_again(frame)

    def _configure(self, header: Header) -> None:
        if header != self._header:  # another run's: nothing carries over
            self._header, self._config, self._state = header, config_of(header), None
        if header.core != self._core:
            self.other_core = header.core

    def _arrive(self, recorded: BridgeState) -> None:
        reached = self._state
        if reached is not None and reached.tick != recorded.tick:
            self.gaps += max(0, recorded.tick - reached.tick)
        elif reached is not None and reached != recorded:
            self._differs(f"tick {recorded.tick}: the state reached is not the recorded one")
        self._state = recorded

    def _step_again(self, frame: TickFrame) -> None:
        if self._config is None or self._state is None:
            raise BadRecording("recording_stateless", f"tick {frame.tick} comes before any state")
        if self._state.tick != frame.tick:
            text = f"tick {frame.tick} follows tick {self._state.tick - 1}, and no state between"
            raise BadRecording("recording_stateless", text)
        decision = step(self._config, self._state, frame.inbox, frame.now_s)
        self.ticks += 1
        self._state = decision.state
        # repr tells -0.0 from 0.0, so equal here means equal to the last bit
        if repr(decision.command) != repr(frame.command):
            self._differs(f"tick {frame.tick}: {decision.command!r}, recorded {frame.command!r}")
        elif decision.state.mode is not frame.mode:
            self._differs(f"tick {frame.tick}: {decision.state.mode}, recorded {frame.mode}")

    def _differs(self, what: str) -> None:
        self.differing += 1
        self.first_difference = self.first_difference or what
