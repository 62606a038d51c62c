"""Define what a recording holds: gzipped lines of JSON, one frame each (``zcat FILE | jq``).

header   all that is configured: enough to build the same core again
state    the core's whole state before the tick that follows
tick     what one step was given and the command it gave
gap      ticks not recorded because the pipe was full; it lies between a header and a state

A segment begins with a header and a state, so a file may begin at any header. Floats are written in
their shortest exact form and come back bit for bit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

from pydantic import ConfigDict, Field, TypeAdapter

from bridge.core import BridgeState, CoreConfig, Inbox
from bridge.core.fence import Fence, Zone, build_fence
from bridge.core.outline import Polygon
from wire import DriveCommand, Mode, RobotDescription

_STRICT = ConfigDict(extra="forbid", allow_inf_nan=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outlines:
    """Keep what a fence is built of; what is prepared from it is not worth its bytes."""

    map_id: str
    allowed: tuple[Polygon, ...]
    keep_outs: tuple[Polygon, ...]
    zones: tuple[Zone, ...]
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """Begin a segment. ``kind`` comes first in every frame: the writer looks for it there."""

    kind: Literal["header"] = "header"
    version: Literal[1, 2] = 2
    robot: RobotDescription
    robot_hash: str
    fence: Outlines | None
    fence_hash: str
    map_id: str
    boot: str
    period_s: float
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class StateFrame:
    """Give the state before the next tick."""

    kind: Literal["state"] = "state"
    state: BridgeState
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class TickFrame:
    """Give one tick's arguments and what came of them."""

    kind: Literal["tick"] = "tick"
    tick: int
    now_s: float
    inbox: Inbox
    command: DriveCommand | None
    mode: Mode
    reasons: tuple[str, ...]
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Say how many ticks are missing here."""

    kind: Literal["gap"] = "gap"
    ticks: int
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


Frame = Header | StateFrame | TickFrame | Gap

FRAMES: TypeAdapter[Frame] = TypeAdapter(Annotated[Frame, Field(discriminator="kind")])
_HEADER = TypeAdapter(Header)
_STATE = TypeAdapter(StateFrame)
_TICK = TypeAdapter(TickFrame)
_GAP = TypeAdapter(Gap)


def tick_line(frame: TickFrame) -> bytes:
    """Return one tick's line; about 20 us, 70 us with a scan."""
    return _TICK.dump_json(frame) + b"\n"


def header_of(config: CoreConfig) -> Header:
    """Write a configuration down."""
    fence = config.fence
    return Header(
        robot=config.robot,
        robot_hash=config.robot_hash,
        fence=None if fence is None else _outlines(fence),
        fence_hash=config.fence_hash,
        map_id=config.map_id,
        boot=config.boot,
        period_s=config.period_s,
    )


def config_of(header: Header) -> CoreConfig:
    """Build the same configuration again."""
    fence = header.fence
    return CoreConfig(
        robot=header.robot,
        robot_hash=header.robot_hash,
        fence=None if fence is None else _fence(fence),
        fence_hash=header.fence_hash,
        map_id=header.map_id,
        boot=header.boot,
        period_s=header.period_s,
    )


def _outlines(fence: Fence) -> Outlines:
    return Outlines(
        map_id=fence.map_id, allowed=fence.allowed, keep_outs=fence.keep_outs, zones=fence.zones
    )


def _fence(kept: Outlines) -> Fence:
    return build_fence(kept.map_id, kept.allowed, kept.keep_outs, kept.zones)


def segment_lines(config: CoreConfig, missing: int, state: BridgeState) -> bytes:
    """Return what a segment begins with, told how many ticks are missing before it."""
    lines = [_HEADER.dump_json(header_of(config))]
    if missing:
        lines.append(_GAP.dump_json(Gap(ticks=missing)))
    lines.append(_STATE.dump_json(StateFrame(state=state)))
    return b"\n".join(lines) + b"\n"
