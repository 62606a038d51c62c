"""Find the robot's time zone: the owner's setting, else the system's, else UTC.

Reads the environment and one file, once, at the start; one setting is then the whole process's.
"""

from __future__ import annotations

import logging
import os
import time
from datetime import UTC, tzinfo
from pathlib import Path
from typing import TYPE_CHECKING
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Mapping

log = logging.getLogger(__name__)

LOCALTIME = Path("/etc/localtime")


def find_zone(
    wanted: str | None, environment: Mapping[str, str], localtime: Path = LOCALTIME
) -> tzinfo:
    """Return the zone by whose clock standing orders go.

    Args:
        wanted: the owner's setting, as "Europe/Berlin".
        environment: where TZ may name one.
        localtime: the system's own zone, as a file.

    Raises:
        ConfigError: ``timezone_unknown``: the owner's setting names none.
    """
    if wanted is not None:
        zone = _find_named(wanted)
        if zone is None:
            raise ConfigError("timezone_unknown", f"[orders] timezone {wanted[:60]!r} is none")
        return zone
    named = environment.get("TZ", "").removeprefix(":")
    zone = _find_named(named) if named and not named.startswith("/") else None
    if zone is not None:
        return zone
    try:
        key = _key_of(localtime)
        with localtime.open("rb") as file:
            return ZoneInfo.from_file(file, key=key)
    except (OSError, ValueError):
        log.warning("timezone_unknown: %s can't be read; standing orders go by UTC", localtime)
        return UTC


def set_local_zone(wanted: str | None) -> None:
    """Let local time be the owner's zone in all of this process; without a setting it stays.

    "Every evening at eight", "after eight", "what did you do this morning?" and the quiet hours of
    speech mean one clock. In a container, whose own is UTC, they were hours apart.
    """
    if wanted is not None:
        os.environ["TZ"] = wanted  # also of the processes that are begun later
        time.tzset()


def name_of(zone: tzinfo) -> str:
    """Return a zone's name, for people."""
    return str(getattr(zone, "key", None) or zone)


def _find_named(name: str) -> tzinfo | None:
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError):
        return None


def _key_of(localtime: Path) -> str | None:
    """Return the name of the zone that a link points at: Europe/Berlin."""
    _, found, key = str(localtime.resolve()).partition("zoneinfo/")
    return key if found else None
