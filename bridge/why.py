"""Find the last stop in the recordings and say what stopped the robot.

Searches the newest recordings for the last tick that left ACTIVE, TELEOP or HOLD for a mode that
drives nobody, runs that segment again through the core, and gathers what was up and what it led to.
Needs no running bridge; knows the recorder's door and the core; prints nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from bridge.core import step
from bridge.core.rows import STAGES
from bridge.recorder import (
    BadRecording,
    Header,
    StateFrame,
    TickFrame,
    config_of,
    parsed,
    read_segments,
)
from wire import Held, Mode, Pose2

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from bridge.core import BridgeState
    from bridge.core.rows import Stage

__all__ = ["BadRecording", "Stop", "last_stop"]

_READY = {b"ACTIVE", b"TELEOP", b"HOLD"}
_STOPPED = {b"STOPPING", b"ESTOPPED", b"FAULT", b"DISARMED"}
_MODE = b'"mode":"'
_TICK = b'{"kind":"tick"'
AFTER_TICKS = 1000
"""How far the aftermath is followed: ten seconds."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Tell of one stop."""

    path: Path
    ago_s: float
    """Before the end of the recording."""
    before: Mode
    after: Mode
    cause: str
    """The row in lower case, or the order or gate, as the bridge's event named it."""
    ordered_by: str | None
    """Who said stop, where somebody did."""
    rows: tuple[tuple[Stage, str], ...]
    """What was up at that tick, with its evidence, worst first as the bridge found it."""
    speed_mps: float
    """Measured when it began."""
    stood_s: float | None
    """How long until it stood; None where the recording does not show it."""
    way_m: float
    """How far it went until then."""
    ended: Mode
    held: Held | None
    events: tuple[tuple[float, str, str], ...]
    """What the bridge said from then on: seconds after the stop began, code, detail."""


def last_stop(folder: Path) -> Stop | None:
    """Return the newest stop of all recordings; None where there is none.

    Raises:
        BadRecording: a recording can't be read.
    """
    newest_first = sorted(folder.glob("*.jsonl.gz"), key=_written_s, reverse=True)
    for path in newest_first:
        lines = _search(path)
        if lines is not None:
            return _again(path, *lines)
    return None


def _written_s(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0  # rotated away meanwhile


def _search(path: Path) -> tuple[list[bytes], int, list[bytes]] | None:
    """Return the segment with the last stop, the line of that stop, and the recording's last line.

    What follows the stop in the next segment is added to the lines.
    """
    found: tuple[list[bytes], int] | None = None
    fresh, last, mode = False, b"", b""
    for lines in read_segments(path):
        if fresh and found is not None:
            found[0].extend(line for line in lines if line.startswith(_TICK))
            fresh = False
        for index, line in enumerate(lines):
            if not line.startswith(_TICK):
                continue
            at = line.rfind(_MODE) + len(_MODE)
            before, mode = mode, line[at : line.find(b'"', at)]
            if before in _READY and mode in _STOPPED:
                found, fresh = (lines, index), True
            last = line
    return None if found is None else (*found, [last])


def _again(path: Path, lines: list[bytes], index: int, last: list[bytes]) -> Stop:
    """Run the segment again up to the stop and a little further."""
    config, state = None, None
    ticks: list[TickFrame] = []
    header = lines[0]
    for frame in parsed(path, lines[: index + 1 + AFTER_TICKS]):
        match frame:
            case Header():
                config = config_of(frame)
            case StateFrame():
                state = frame.state
            case TickFrame():
                ticks.append(frame)
    stop_tick = next(f for f in parsed(path, [header, lines[index]]) if isinstance(f, TickFrame))
    end = next(f for f in parsed(path, [header, *last]) if isinstance(f, TickFrame))
    if config is None or state is None:
        raise BadRecording("recording_stateless", f"{path}: a segment without a state")
    story = _Story(stop_tick)
    for tick in ticks:
        decision = step(config, state, tick.inbox, tick.now_s)
        events = [(event.code, event.detail) for event in decision.events]
        story.take(tick, state, decision.state, events)
        state = decision.state
        if story.over:
            break
    return story.told(path, end.now_s)


class _Story:
    """Gather what happened from the stop on."""

    def __init__(self, stop_tick: TickFrame) -> None:
        self._number, self._began_s = stop_tick.tick, stop_tick.now_s
        self._from: BridgeState | None = None
        self._at: BridgeState | None = None
        self._now: BridgeState | None = None
        self._by: str | None = None
        self._events: list[tuple[float, str, str]] = []
        self._stood_s: float | None = None
        self._last: Pose2 | None = None
        self._way_m = 0.0

    @property
    def over(self) -> bool:
        """Tell whether the robot stands and the bridge has settled."""
        now = self._now
        return self._stood_s is not None and now is not None and now.mode is not Mode.STOPPING

    def take(
        self,
        tick: TickFrame,
        before: BridgeState,
        after: BridgeState,
        events: list[tuple[str, str]],
    ) -> None:
        """Go on by one tick."""
        if tick.tick < self._number:
            return
        if tick.tick == self._number:
            self._from, self._at = before, after
            self._by = tick.inbox.stops[0].source if tick.inbox.stops else None
        here = after.odometry.base_in_odom
        if self._last is not None and self._stood_s is None:
            self._way_m += hypot(here.x_m - self._last.x_m, here.y_m - self._last.y_m)
        self._last, self._now = here, after
        passed_s = tick.now_s - self._began_s
        self._events += [(passed_s, code, detail) for code, detail in events]
        if self._stood_s is None and after.drive.still_since_s is not None:
            self._stood_s = passed_s

    def told(self, path: Path, end_s: float) -> Stop:
        """Return the whole."""
        before, after, now = self._from, self._at, self._now
        if before is None or after is None or now is None:
            raise BadRecording("recording_stateless", f"{path}: the stop can't be run again")
        return Stop(
            path=path,
            ago_s=end_s - self._began_s,
            before=before.mode,
            after=after.mode,
            cause=next(self._causes(), "unknown"),
            ordered_by=self._by,
            rows=tuple((STAGES[name], up.evidence) for name, up in after.rows.items()),
            speed_mps=before.odometry.measured.v_mps,
            stood_s=self._stood_s,
            way_m=self._way_m,
            ended=now.mode,
            held=now.held,
            events=tuple(self._events),
        )

    def _causes(self) -> Iterator[str]:
        """Yield why modes were left, as the events say: from, to, why."""
        for _, code, detail in self._events:
            if code == "mode":
                yield detail.split(" ", 2)[-1]
