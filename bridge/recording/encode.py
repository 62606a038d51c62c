"""Encode ticks as frames for the writing process. Runs in the loop: every microsecond counts.

Serializers are called without the wrapper of their adapters, and defaults are left out: of most
ticks nothing but the drive's report came. A scan's ranges are copied as doubles, for formatting 360
of them as text takes 50 us.
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any

from bridge.recording import format as form
from bridge.recording import pipe_frames

if TYPE_CHECKING:
    from bridge.core import BridgeState, CoreConfig, Decision, Inbox

_HEAD = struct.Struct("<cI").pack
_TICK = pipe_frames.TICK_OF.pack
_given = form.GIVEN.serializer.to_json
_command = form.COMMAND.serializer.to_json
_status = form.STATUS.serializer.to_json
_odometry = form.ODOMETRY.serializer.to_json
_event = form.EVENT.serializer.to_json
_RANGES: Any = {"inbox": {"scan": {"ranges_m"}}}
NOTHING_M = float("inf")
"""What a beam without return is among doubles (REP-117)."""


def tick_frames(
    out: list[bytes], state: BridgeState, inbox: Inbox, now_s: float, decision: Decision
) -> None:
    """Add the frames of one tick; about 25 us while the code for it is warm."""
    number, head = state.tick, _HEAD
    given = form.StepInput(number, now_s, inbox)
    out += (head(pipe_frames.TICK, pipe_frames.TICK_OF.size), _TICK(number, now_s))
    if inbox.scan is None:
        arrived = _given(given, exclude_defaults=True)
    else:
        ranges = pack_ranges(inbox.scan.ranges_m)
        out += (head(pipe_frames.RANGES, len(ranges)), ranges)
        arrived = _given(given, exclude_defaults=True, exclude=_RANGES)
    out += (head(pipe_frames.INBOX, len(arrived)), arrived)
    if decision.command is not None:
        said = _command(decision.command)
        out += (head(pipe_frames.COMMAND, len(said)), said)
    if decision.status is not None:
        said = _status(decision.status)
        out += (head(pipe_frames.STATUS, len(said)), said)
    if decision.odometry is not None:
        said = _odometry(decision.odometry)
        out += (head(pipe_frames.ODOMETRY, len(said)), said)
    for event in decision.events:
        said = _event(event)
        out += (head(pipe_frames.EVENT, len(said)), said)
    said = _digest(number, decision)
    out += (head(pipe_frames.DECISION, len(said)), said)


def _digest(number: int, decision: Decision) -> bytes:
    """Write a ``form.Digest`` by hand, for speed. Only reasons may need escapes."""
    after = decision.state
    motion, free_m = after.motion, after.motion.free_m
    sent, reasons = motion.limiter.sent, decision.reasons
    why = json.dumps(reasons) if reasons else "[]"
    return (
        f'{{"tick":{number},"mode":"{after.mode.value}",'
        f'"sent":{{"v_mps":{sent.v_mps!r},"w_radps":{sent.w_radps!r}}},"cap":{motion.cap!r},'
        f'"bound_by":"{motion.bound_by}","free_m":{"null" if free_m is None else repr(free_m)},'
        f'"reasons":{why}}}'
    ).encode()


def pack_ranges(ranges_m: tuple[float | None, ...]) -> bytes:
    """Return ranges as little-endian doubles."""
    try:
        return struct.pack(f"<{len(ranges_m)}d", *ranges_m)
    except struct.error:  # some beam came back with nothing
        filled = [NOTHING_M if range_m is None else range_m for range_m in ranges_m]
        return struct.pack(f"<{len(ranges_m)}d", *filled)


def unpack_ranges(data: bytes) -> list[float | None]:
    """Return the ranges that were packed."""
    ranges = struct.unpack(f"<{len(data) // 8}d", data)
    return [None if range_m == NOTHING_M else range_m for range_m in ranges]


def segment_frames(config: CoreConfig, core: str, state: BridgeState) -> bytes:
    """Return the boot and state frames that begin a segment."""
    return b"".join(
        (
            pipe_frames.frame(pipe_frames.TICK, _TICK(state.tick, state.now_s)),
            pipe_frames.frame(
                pipe_frames.BOOT, form.HEADER.dump_json(form.header_of(config, core))
            ),
            pipe_frames.frame(
                pipe_frames.STATE, form.STATE.dump_json(form.StateFrame(state=state))
            ),
        )
    )


def warm_frames(
    config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float, decision: Decision, *,
    whole: bool,
) -> bytes:  # fmt: skip
    """Encode a tick and throw it away: code that has run once runs faster."""
    out = [segment_frames(config, "", state)] if whole else []
    tick_frames(out, state, inbox, now_s, decision)
    return b"".join(out)


def schema_frame(said: dict[str, dict[str, Any]]) -> bytes:
    """Return the frame that tells the writing process of our topics."""
    return pipe_frames.frame(pipe_frames.SCHEMAS, json.dumps(said).encode())
