"""Read fence.json into the core's fence. Loaded while DISARMED; a fence that is wrong refuses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import ValidationError

from bridge.core.geometry.fence import FenceGrid, Zone, build_fence
from wire.errors import ConfigError
from wire.fence import FenceFile, flaw
from wire.fingerprint import fingerprint
from wire.plain_file import read_plain_file
from wire.robot import explain

if TYPE_CHECKING:
    from pathlib import Path

NAME = "fence.json"
MOST_BYTES = 4_000_000


def load_fence(path: Path) -> tuple[FenceGrid, str]:
    """Read fence.json; return the fence and the hash that hello must match.

    Raises:
        ConfigError: the file is missing, or wrong as for :func:`parse_fence`.
    """
    try:
        data = read_plain_file(path, MOST_BYTES)
    except OSError as error:
        raise ConfigError("fence_missing", f"{path}: {error.strerror}") from None
    return parse_fence(data, str(path)), fingerprint(data)


def parse_fence(data: bytes, name: str = NAME) -> FenceGrid:
    """Make a fence of the file's bytes.

    Raises:
        ConfigError: malformed, with an outline without area or one that crosses itself, or with
            keep-outs that leave nothing.
    """
    record = read_record(data, name)
    zones = tuple(Zone(zone.polygon, zone.max_speed_mps) for zone in record.speed_zones)
    fence = build_fence(record.map_id, record.allowed, record.keep_outs, zones)
    if not fence.boundary:  # whatever is allowed somewhere ends somewhere
        text = (
            f"{len(record.keep_outs)} keep_outs cover all that is allowed: the robot may be nowhere"
        )
        raise ConfigError("fence_empty", f"{name}: {text}")
    return fence


def read_record(data: bytes, name: str = NAME) -> FenceFile:
    """Parse the bytes of fence.json and check its outlines.

    Raises:
        ConfigError: malformed, or with an outline without area or one that crosses itself.
    """
    try:
        record = FenceFile.model_validate_json(data, strict=False)
    except ValidationError as error:
        raise ConfigError("fence_invalid", f"{name}: {explain(error)}") from None
    wrong = flaw(record)
    if wrong is not None:
        raise ConfigError(wrong[0], f"{name}: {wrong[1]}")
    return record
