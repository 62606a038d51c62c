"""Define the messages of a recording, topic by topic, and their exactness.

boot      all that is configured: enough to build the same core again
state     the core's whole state before the tick that follows
inbox     what one step was given, and when
command   what it sent to the drive; absent in the ticks that send none
decision  the rest of what it decided, in short; last of its tick

A segment begins with a boot and a state, so that a replay may begin at any. Floats are written in
their shortest exact form and come back bit for bit; a scan's ranges go beside the inbox as doubles.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any, ClassVar, Literal

from pydantic import ConfigDict, TypeAdapter

from bridge.core import BridgeState, CoreConfig, Inbox
from bridge.core.geometry.fence import FenceGrid, Polygon, Zone, build_fence
from wire import DriveCommand, Event, Mode, Odometry, Status, Twist2
from wire.fingerprint import fingerprint
from wire.value import value

_STRICT = ConfigDict(extra="forbid", allow_inf_nan=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outlines:
    """Hold a fence's outlines; the cells prepared from them are not worth their bytes."""

    map_id: str
    allowed: tuple[Polygon, ...]
    keep_outs: tuple[Polygon, ...]
    zones: tuple[Zone, ...]
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class Header:
    """Begin a segment."""

    version: Literal[3] = 3
    """1 and 2 were gzipped lines of JSON."""
    core: str
    """Fingerprint of the shape of configuration, state and inbox: of which core this is."""
    config: CoreConfig
    """Without the fence, whose prepared cells are no JSON."""
    fence: Outlines | None
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class StateFrame:
    """Hold the core's whole state before the next tick."""

    state: BridgeState
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@value
class StepInput:
    """Hold one step's arguments: number of the tick before it, time, inbox."""

    tick: int
    now_s: float
    inbox: Inbox
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", allow_inf_nan=False, title="Given"
    )
    """The title of its first version: a title is part of a core's fingerprint."""


@value
class Digest:
    """Hold a decision in short, beside the messages that it sent."""

    tick: int
    mode: Mode
    sent: Twist2
    """Body velocity sent, before dead-zone feed-forward."""
    cap: float
    bound_by: str
    free_m: float | None
    reasons: tuple[str, ...]
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@dataclass(frozen=True, slots=True, kw_only=True)
class TickFrame:
    """Hold one tick as it was recorded."""

    tick: int
    now_s: float
    inbox: Inbox
    command: DriveCommand | None
    mode: Mode
    reasons: tuple[str, ...]


Frame = Header | StateFrame | TickFrame

HEADER = TypeAdapter(Header)
STATE = TypeAdapter(StateFrame)
GIVEN = TypeAdapter(StepInput)
DIGEST = TypeAdapter(Digest)
COMMAND = TypeAdapter(DriveCommand)
STATUS = TypeAdapter(Status)
ODOMETRY = TypeAdapter(Odometry)
EVENT = TypeAdapter(Event)

TOPICS: dict[str, tuple[str, TypeAdapter[Any]]] = {
    "/pons/boot": ("pons.Boot", HEADER),
    "/pons/state": ("pons.State", STATE),
    "/pons/inbox": ("pons.Inbox", GIVEN),
    "/pons/command": ("pons.DriveCommand", COMMAND),
    "/pons/decision": ("pons.Decision", DIGEST),
    "/pons/status": ("pons.Status", STATUS),
    "/pons/odometry": ("pons.Odometry", ODOMETRY),
    "/pons/event": ("pons.Event", EVENT),
}


@cache
def schemas() -> dict[str, dict[str, Any]]:
    """Return name and JSON Schema of each topic; 0.2 s, so once a process and before the loop.

    All share what is returned: nobody may change it.
    """
    return {
        topic: {"name": name, "schema": adapter.json_schema(mode="serialization")}
        for topic, (name, adapter) in TOPICS.items()
    }


def core_of(said: dict[str, dict[str, Any]]) -> str:
    """Return the fingerprint of the schemas that a replay must understand."""
    told = [said[topic]["schema"] for topic in ("/pons/boot", "/pons/state", "/pons/inbox")]
    return fingerprint(repr(_bare(told)).encode())


def _bare(schema: Any) -> Any:
    """Leave out the words: a better docstring makes no other core."""
    if isinstance(schema, dict):
        return {key: _bare(value) for key, value in schema.items() if key != "description"}
    return [_bare(item) for item in schema] if isinstance(schema, list) else schema


def header_of(config: CoreConfig, core: str) -> Header:
    """Write a configuration down."""
    fence = config.fence
    return Header(
        core=core,
        config=replace(config, fence=None),
        fence=None if fence is None else _outlines(fence),
    )


def config_of(header: Header) -> CoreConfig:
    """Build the same configuration again."""
    fence = header.fence
    return header.config if fence is None else replace(header.config, fence=_fence(fence))


def _outlines(fence: FenceGrid) -> Outlines:
    return Outlines(
        map_id=fence.map_id, allowed=fence.allowed, keep_outs=fence.keep_outs, zones=fence.zones
    )


@lru_cache(maxsize=4)
def _fence(kept: Outlines) -> FenceGrid:
    """Prepare a fence's cells; every segment of a run says the same one again."""
    return build_fence(kept.map_id, kept.allowed, kept.keep_outs, kept.zones)
