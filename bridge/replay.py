"""Run a recording again through the core and compare every command exactly.

Knows the recorder's door and the core; no clock, no drive. A recorded state, where a segment
begins, is compared with the one that the replay has reached: an error that moves no wheel shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bridge.core import step
from bridge.recorder import (
    BadRecording,
    Gap,
    Header,
    StateFrame,
    TickFrame,
    config_of,
    read_recording,
)

if TYPE_CHECKING:
    from pathlib import Path

    from bridge.core import BridgeState, CoreConfig
    from bridge.recorder import Frame

__all__ = ["BadRecording", "ReplayReport", "replay"]


@dataclass(frozen=True, slots=True)
class ReplayReport:
    """Say how a replay went."""

    ticks: int
    differing: int
    """Ticks whose command or mode came out otherwise, and states that were not reached."""
    gaps: int
    """Ticks that the recording says it lacks."""
    first_difference: str | None


def replay(path: Path) -> ReplayReport:
    """Run every recorded tick again.

    Raises:
        BadRecording: the file is no recording.
    """
    run = _Replay()
    for frame in read_recording(path):
        run.take(frame)
    if run.config is None:
        raise BadRecording("recording_empty", f"{path} holds no whole line")
    return ReplayReport(run.ticks, run.differing, run.gaps, run.first_difference)


class _Replay:
    """Hold what one frame hands to the next."""

    def __init__(self) -> None:
        self._header: Header | None = None
        self.config: CoreConfig | None = None
        self.state: BridgeState | None = None
        self.ticks = self.differing = self.gaps = 0
        self.first_difference: str | None = None

    def take(self, frame: Frame) -> None:
        """Go on by one frame."""
        match frame:
            case Header():
                self._configure(frame)
            case Gap():
                self.gaps += frame.ticks
                self.state = None
            case StateFrame():
                self._arrive(frame.state)
            case TickFrame():
                self._again(frame)

    def _configure(self, header: Header) -> None:
        if header != self._header:  # another run's: nothing carries over
            self._header, self.config, self.state = header, config_of(header), None

    def _arrive(self, recorded: BridgeState) -> None:
        comparable = self._header is not None and self._header.version != 1  # its cores saw further
        if comparable and self.state is not None and self.state != recorded:
            self._differs(f"tick {recorded.tick}: the state reached is not the recorded one")
        self.state = recorded

    def _again(self, frame: TickFrame) -> None:
        if self.config is None or self.state is None:
            raise BadRecording("recording_stateless", f"tick {frame.tick} comes before any state")
        decision = step(self.config, self.state, frame.inbox, frame.now_s)
        self.ticks += 1
        self.state = decision.state
        # repr tells -0.0 from 0.0, so equal here means equal to the last bit
        if repr(decision.command) != repr(frame.command):
            self._differs(f"tick {frame.tick}: {decision.command!r}, recorded {frame.command!r}")
        elif decision.state.mode is not frame.mode:
            self._differs(f"tick {frame.tick}: {decision.state.mode}, recorded {frame.mode}")

    def _differs(self, what: str) -> None:
        self.differing += 1
        self.first_difference = self.first_difference or what
