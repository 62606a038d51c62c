"""Read fence.json into the core's fence. Loaded while DISARMED; a fence that is wrong refuses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, ValidationError

from bridge.core.fence import Fence, Zone, build_fence
from bridge.core.outline import Polygon
from wire.base import Record
from wire.errors import Misconfigured
from wire.fingerprint import fingerprint
from wire.geometry import Metres
from wire.robot import explain
from wire.scalars import Fingerprint

if TYPE_CHECKING:
    from pathlib import Path

_MIN_AREA_M2 = 1e-6

Outline = Annotated[tuple[tuple[Metres, Metres], ...], Field(min_length=3, max_length=1000)]
_Outlines = Annotated[tuple[Outline, ...], Field(max_length=200)]


class SpeedZone(Record):
    """Mirror one speed zone of the file."""

    polygon: Outline
    max_speed_mps: Annotated[float, Field(ge=0.05, le=10.0)]


class FenceFile(Record):
    """Mirror fence.json; outlines in ``map`` [m], for the robot's centre."""

    version: Literal[1]
    map_id: Fingerprint
    allowed: Annotated[_Outlines, Field(min_length=1)]
    keep_outs: _Outlines = ()
    speed_zones: Annotated[tuple[SpeedZone, ...], Field(max_length=200)] = ()


def load_fence(path: Path) -> tuple[Fence, str]:
    """Read fence.json; return the fence and the hash that hello must match.

    Raises:
        Misconfigured: the file is missing, malformed, or has an outline without area.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise Misconfigured("fence_missing", f"{path}: {error.strerror}") from None
    return parse_fence(data, str(path)), fingerprint(data)


def parse_fence(data: bytes, name: str = "fence.json") -> Fence:
    """Make a fence of the file's bytes.

    Raises:
        Misconfigured: malformed, or an outline without area.
    """
    try:
        record = FenceFile.model_validate_json(data, strict=False)
    except ValidationError as error:
        raise Misconfigured("fence_invalid", f"{name}: {explain(error)}") from None
    zones = tuple(Zone(zone.polygon, zone.max_speed_mps) for zone in record.speed_zones)
    for outline in (*record.allowed, *record.keep_outs, *(zone.polygon for zone in zones)):
        if not _area_m2(outline) > _MIN_AREA_M2:
            raise Misconfigured("fence_degenerate", f"{name}: an outline has no area: {outline}")
    return build_fence(record.map_id, record.allowed, record.keep_outs, zones)


def _area_m2(outline: Polygon) -> float:
    """Return an outline's area (shoelace formula), whichever way round it runs."""
    following = outline[1:] + outline[:1]
    doubled = sum(xa * yb - xb * ya for (xa, ya), (xb, yb) in zip(outline, following, strict=True))
    return abs(doubled) / 2
