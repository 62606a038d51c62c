"""Read a recording's boots, states and ticks. Runs nothing.

The door for whoever reads; bridge.recording's own is the loop's, which must not load what is needed
here. A recording of another core is refused only where this one can't understand it, and then by
the fields in which they differ.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, TypeVar

from pydantic import ValidationError

from bridge.recording import format as form
from bridge.recording.encode import unpack_ranges
from bridge.recording.format import (
    Frame,
    Header,
    StateFrame,
    TickFrame,
    config_of,
    core_of,
    schemas,
)
from bridge.recording.mcap_reader import BadRecording, McapReader, Raw
from bridge.recording.protobuf import ranges_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from pydantic import TypeAdapter

    from wire import Odometry, Scan

__all__ = [
    "BadRecording",
    "Frame",
    "Header",
    "McapReader",
    "Raw",
    "StateFrame",
    "TickFrame",
    "config_of",
    "frames_of",
    "read_motion",
    "read_recording",
    "this_core",
]

T = TypeVar("T")


def this_core() -> str:
    """Return the fingerprint that recordings made by this version bear."""
    return core_of(schemas())


def read_recording(path: Path) -> Iterator[Frame]:
    """Yield the frames in order. A file cut short ends with its last whole tick.

    Raises:
        BadRecording: no such file, not MCAP, damaged, not ours, or of a core that is too different.
    """
    with McapReader(path) as box:
        yield from frames_of(path, box.messages())


def read_motion(path: Path) -> Iterator[Odometry | Scan]:
    """Yield the odometry and scans of a recording, in the order in which the bridge had them.

    Raises:
        BadRecording: no such file, not MCAP, damaged, or not ours.
    """
    core = ""
    ranges: Raw | None = None
    with McapReader(path) as box:
        for raw in box.messages():
            match raw.topic:
                case "/pons/boot":
                    core = _core_said(raw)
                case "/scan":
                    ranges = raw
                case "/pons/odometry":
                    yield _parse(path, raw, form.ODOMETRY, core)
                case "/pons/inbox" if ranges is not None and ranges.sequence == raw.sequence:
                    given = _parse(path, _with_ranges(path, raw, ranges), form.GIVEN, core)
                    if given.inbox.scan is not None:
                        yield given.inbox.scan


def frames_of(path: Path, messages: Iterable[Raw]) -> Iterator[Frame]:
    """Yield the frames that messages stand for.

    Raises:
        BadRecording: they are none of ours.
    """
    core = ""
    ranges: Raw | None = None
    inbox: Raw | None = None
    command: Raw | None = None
    for raw in messages:
        match raw.topic:
            case "/pons/boot":
                core = _core_said(raw)
                yield _parse(path, raw, form.HEADER, core)
            case "/pons/state":
                yield _parse(path, raw, form.STATE, core)
            case "/scan":
                ranges = raw
            case "/pons/inbox":
                inbox, command = raw, None
            case "/pons/command":
                command = raw
            case "/pons/decision" if inbox is not None and inbox.sequence == raw.sequence:
                scan = ranges if ranges is not None and ranges.sequence == raw.sequence else None
                yield _tick(path, core, (inbox, scan, command, raw))


def _core_said(boot: Raw) -> str:
    """Return the core's fingerprint in a boot, even where the rest can't be read."""
    try:
        return str(json.loads(boot.data)["core"])
    except (ValueError, KeyError, TypeError):
        return ""


def _tick(path: Path, core: str, parts: tuple[Raw, Raw | None, Raw | None, Raw]) -> TickFrame:
    inbox, scan, command, decision = parts
    given = _parse(path, _with_ranges(path, inbox, scan), form.GIVEN, core)
    digest = _parse(path, decision, form.DIGEST, core)
    return TickFrame(
        tick=given.tick,
        now_s=given.now_s,
        inbox=given.inbox,
        command=None if command is None else _parse(path, command, form.COMMAND, core),
        mode=digest.mode,
        reasons=digest.reasons,
    )


def _with_ranges(path: Path, inbox: Raw, scan: Raw | None) -> Raw:
    """Put a scan's ranges back where they were taken from."""
    if scan is None:
        return inbox
    try:
        given = json.loads(inbox.data)
        given["inbox"]["scan"]["ranges_m"] = unpack_ranges(ranges_of(scan.data))
    except (ValueError, KeyError, TypeError) as error:
        raise BadRecording("recording_invalid", f"{path}, tick {scan.sequence}: {error}") from None
    return Raw(inbox.topic, inbox.sequence, inbox.at_ns, json.dumps(given).encode())


def _parse(path: Path, raw: Raw, adapter: TypeAdapter[T], core: str) -> T:
    try:
        return adapter.validate_json(raw.data)
    except ValidationError as error:
        items = error.errors(include_url=False, include_context=False, include_input=False)
        told = "; ".join(f"{'.'.join(map(str, i['loc'])) or 'all'}: {i['msg']}" for i in items[:3])
        where = f"{path}, {raw.topic} of tick {raw.sequence}: {told}"
    if core and core != this_core():
        raise BadRecording(
            "recording_of_other_core",
            f"{where}. It was recorded by core {core}, this is core {this_core()}: replay it with "
            "the version that recorded it",
        )
    raise BadRecording("recording_invalid", where)
