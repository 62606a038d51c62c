"""Find the last stop in the recordings and report its cause.

Looks through the newest recordings' events for the last time that ACTIVE, TELEOP or HOLD was left
for a mode that drives nobody, or that a self test ended in FAULT, runs that segment again through
the core, and gathers what was up and what it led to. Needs no running bridge; knows the recorder's
reading door and the core; prints nothing.
"""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from bridge.core import step
from bridge.core.faults.fault_table import STAGES
from bridge.recording.incidents import EVENT, is_incident
from bridge.recording.recording_reader import (
    BadRecording,
    Header,
    McapReader,
    StateFrame,
    TickFrame,
    config_of,
    frames_of,
)
from wire import Mode, Pose2, StandingHold

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from bridge.core import BridgeState, CoreConfig
    from bridge.core.faults.fault_table import FaultStage
    from bridge.recording.recording_reader import Frame, Raw

__all__ = ["BadRecording", "StopReport", "last_stop"]

_BOOT = "/pons/boot"
AFTER_TICKS = 1000
"""How far the aftermath is followed: ten seconds."""


@dataclass(frozen=True, slots=True)
class StopReport:
    """Report one stop: cause, rows, speed, way and time to standstill."""

    path: Path
    at_unix_s: float
    ago_s: float
    """Before the end of the recording."""
    whole: bool
    """The recording was closed."""
    growing: bool
    """It is still being written. Neither whole nor growing: its writer was killed, or the power
    failed."""
    before: Mode
    after: Mode
    cause: str
    """The row in lower case, or the order or gate, as the bridge's event named it."""
    ordered_by: str | None
    """Who gave the order that the cause names; None where it was no order."""
    rows: tuple[tuple[FaultStage, str], ...]
    """What was up at that tick, with its evidence, worst first as the bridge found it."""
    speed_mps: float
    """Measured when it began."""
    stood_s: float | None
    """How long until it stood; None where the recording does not show it."""
    way_m: float
    """How far it went until then."""
    ended: Mode
    held: StandingHold | None
    fault: str | None
    """Why it ended in FAULT, where it did: not always what stopped it."""
    events: tuple[tuple[float, str, str], ...]
    """What the bridge said from then on: seconds after the stop began, code, detail."""


def last_stop(folder: Path) -> StopReport | None:
    """Return the newest stop of all recordings; None where there is none.

    Raises:
        BadRecording: a recording can't be read.
    """
    newest_first = sorted(folder.glob("*.mcap"), key=_written_s, reverse=True)
    for index, path in enumerate(newest_first):
        with ExitStack() as open_files:
            box = open_files.enter_context(McapReader(path))
            found = _search(box)
            if found is not None:
                rest = _same_run(path, newest_first[:index])
                later = [open_files.enter_context(McapReader(other)) for other in rest]
                return _run_again([box, *later], *found)
    return None


def _written_s(path: Path) -> tuple[float, str]:
    try:
        return path.stat().st_mtime, path.name
    except OSError:
        return 0.0, path.name  # rotated away meanwhile


def _same_run(path: Path, newer: list[Path]) -> list[Path]:
    """Return the file that goes on where this one ends, if there is one."""
    boot = path.stem.split("-")[1:2]
    return [other for other in reversed(newer) if other.stem.split("-")[1:2] == boot][:1]


def _search(box: McapReader) -> tuple[int, Raw] | None:
    """Return the chunk and the event of the last stop. Chunks without events are not unpacked."""
    for index in range(len(box.chunks) - 1, -1, -1):
        chunk = box.chunks[index]
        if chunk.topics and EVENT not in chunk.topics:
            continue  # one without any index may be the last of a file cut short
        for raw in reversed(box.read(chunk)):
            if raw.topic == EVENT and is_incident(raw.data):
                return index, raw
    return None


def _run_again(boxes: list[McapReader], index: int, stop: Raw) -> StopReport:
    """Run the segment again up to the stop and a little further."""
    story = _Story(stop)
    config: CoreConfig | None = None
    state: BridgeState | None = None
    for frame in _frames(boxes, index, stop):
        match frame:
            case Header():
                config = config_of(frame)
            case StateFrame():
                state = frame.state
            case TickFrame() if config is not None and state is not None:
                if frame.tick > stop.sequence + AFTER_TICKS or frame.tick != state.tick:
                    break
                decision = step(config, state, frame.inbox, frame.now_s)
                events = [(event.code, event.detail) for event in decision.events]
                story.take(frame, state, decision.state, events)
                state = decision.state
                if story.has_ended:
                    break
    box = boxes[0]
    end = next((raw for chunk in reversed(box.chunks) for raw in reversed(box.read(chunk))), stop)
    return story.report(box, (end.at_ns - stop.at_ns) / 1e9)


def _frames(boxes: list[McapReader], index: int, stop: Raw) -> Iterator[Frame]:
    """Yield from the boot that begins the stop's segment; on into the next file."""
    box = boxes[0]
    first, start = 0, 0
    for number in range(index, -1, -1):
        at = _segment(box.read(box.chunks[number]), stop.sequence)
        if at is not None:
            first, start = number, at
            break

    def messages() -> Iterator[Raw]:
        yield from box.read(box.chunks[first])[start:]
        for chunk in box.chunks[first + 1 :]:
            yield from box.read(chunk)
        for later in boxes[1:]:
            yield from later.messages()

    return frames_of(box.path, messages())


def _segment(messages: list[Raw], tick: int) -> int | None:
    """Return where the last segment begins that has this tick."""
    places = (at for at, raw in enumerate(messages) if raw.topic == _BOOT and raw.sequence <= tick)
    return max(places, default=None)


class _Story:
    """Gather the events and the motion from a stop on."""

    def __init__(self, stop: Raw) -> None:
        self._number, self._at_unix_s = stop.sequence, stop.at_ns / 1e9
        self._began_s = 0.0
        self._from: BridgeState | None = None
        self._at: BridgeState | None = None
        self._now: BridgeState | None = None
        self._orders: list[tuple[str, str]] = []
        self._events: list[tuple[float, str, str]] = []
        self._stood_s: float | None = None
        self._last: Pose2 | None = None
        self._way_m = 0.0

    @property
    def has_ended(self) -> bool:
        """Return whether the robot stands and the bridge has left STOPPING."""
        now = self._now
        return self._stood_s is not None and now is not None and now.mode is not Mode.STOPPING

    def take(
        self,
        tick: TickFrame,
        before: BridgeState,
        after: BridgeState,
        events: list[tuple[str, str]],
    ) -> None:
        """Add one tick that was run again."""
        if tick.tick < self._number:
            return
        if tick.tick == self._number:
            self._from, self._at, self._began_s = before, after, tick.now_s
            self._orders = [("stop", stop.source) for stop in tick.inbox.stops]
            self._orders += [(op.kind, op.request.source) for op in tick.inbox.ops]
        here = after.odometry.base_in_odom
        if self._last is not None and self._stood_s is None:
            self._way_m += hypot(here.x_m - self._last.x_m, here.y_m - self._last.y_m)
        self._last, self._now = here, after
        passed_s = tick.now_s - self._began_s
        self._events += [(passed_s, code, detail) for code, detail in events]
        if self._stood_s is None and after.drive.still_since_s is not None:
            self._stood_s = passed_s

    def report(self, box: McapReader, ago_s: float) -> StopReport:
        """Return the report."""
        before, after, now = self._from, self._at, self._now
        if before is None or after is None or now is None:
            raise BadRecording("recording_stateless", f"{box.path}: the stop can't be run again")
        cause = next(self._causes(), "unknown")
        return StopReport(
            path=box.path,
            at_unix_s=self._at_unix_s,
            ago_s=ago_s,
            whole=box.complete,
            growing=box.growing,
            before=before.mode,
            after=after.mode,
            cause=cause,
            ordered_by=", ".join(dict.fromkeys(by for what, by in self._orders if what == cause))
            or None,
            rows=tuple((STAGES[name], up.evidence) for name, up in after.rows.items()),
            speed_mps=before.odometry.measured.v_mps,
            stood_s=self._stood_s,
            way_m=self._way_m,
            ended=now.mode,
            held=now.held,
            fault=now.fault,
            events=tuple(self._events),
        )

    def _causes(self) -> Iterator[str]:
        """Yield why modes were left, as the events say: from, to, why."""
        for _, code, detail in self._events:
            if code == "mode":
                yield detail.split(" ", 2)[-1]
