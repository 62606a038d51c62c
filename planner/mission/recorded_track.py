"""Have the black box read for a mission: by a process, for the planner knows no recordings.

One at a time, and only as long as a person would wait.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from pydantic import ValidationError

from planner.plan import Frozen
from processes.parent_death import child_command

if TYPE_CHECKING:
    from pathlib import Path

MODULE = "pons.mission_track"
MARGIN_S = 5.0
"""So much of the recording before and after a mission is shown with it."""
LIMIT_S = 20.0
NICE = 10
"""Of the session that it leads: it stands behind the planner's own loop."""


class TrackSample(Frozen):
    """Show where the robot was and how fast, at a time since the track's beginning."""

    s: float
    x_m: float | None
    """In ``map``; None: the robot did not know."""
    y_m: float | None
    yaw_rad: float | None
    asked_mps: float
    measured_mps: float
    mode: str
    rows: tuple[str, ...]


class TrackEvent(Frozen):
    """Show what the bridge said at a time."""

    s: float
    code: str
    detail: str


class RecordedTrack(Frozen):
    """Show a mission as the black box has it; empty where nothing of it is kept, or may be read."""

    samples: tuple[TrackSample, ...] = ()
    events: tuple[TrackEvent, ...] = ()
    gaps: tuple[tuple[float, float], ...] = ()
    """From when to when nothing is kept."""
    way_m: float = 0.0


class TrackReader:
    """Read tracks out of a home's recordings."""

    def __init__(self, home: Path) -> None:
        self._home = home
        self._one = asyncio.Lock()

    async def read(self, since_unix_s: float, until_unix_s: float) -> RecordedTrack:
        """Return the track between two times; an empty one where it can't be read in time."""
        words = (str(self._home), repr(since_unix_s - MARGIN_S), repr(until_unix_s + MARGIN_S))
        async with self._one:
            process = await asyncio.create_subprocess_exec(
                *child_command(MODULE, *words, session_nice=NICE),
                stdin=asyncio.subprocess.DEVNULL,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL,
                start_new_session=True,
            )
            try:
                told, _ = await asyncio.wait_for(process.communicate(), LIMIT_S)
                return RecordedTrack.model_validate_json(told, strict=False)
            except (TimeoutError, ValidationError):
                return RecordedTrack()
            finally:
                if process.returncode is None:
                    process.kill()
                    await process.wait()
