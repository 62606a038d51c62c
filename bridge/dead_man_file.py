"""Keep what was seen of a base's own dead-man: one small file per robot, read once at start.

``pons robot try`` writes it: told to be silent, it measures on the wheels how long the base drives
on. Without it, or with one of another base, row DEAD_MAN caps the speed.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, ValidationError

from bridge.files import replace_file
from wire.base import Record
from wire.robot import RobotId, explain

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription

log = logging.getLogger("bridge.dead_man")

FOLDER = "dead_man"
MAX_BYTES = 4_000


class DeadManFile(Record):
    """Define the file's fields: what was measured, and on which base with which settings."""

    version: Literal[1] = 1
    robot: RobotId
    kind: str
    port: str | None
    timeout_s: float
    silence_s: Annotated[float, Field(ge=0.0, le=60.0)]
    """From the last command until the wheels stood, the longest of all trials."""


def dead_man_path(home: Path, robot: RobotDescription) -> Path:
    """Return the path of a robot's file."""
    return home / FOLDER / f"{robot.id}.json"


def load_dead_man(home: Path, robot: RobotDescription) -> float | None:
    """Return the silence after which this base was seen to stop [s]; None where nobody has tried.

    What can't be read, or is of another base or time-out, counts as not tried and is said in the
    log.
    """
    path = dead_man_path(home, robot)
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        return _refuse(path, str(error.strerror))
    if len(data) > MAX_BYTES:
        return _refuse(path, f"{len(data)} bytes, at most {MAX_BYTES}")
    try:
        kept = DeadManFile.model_validate_json(data, strict=True)
    except ValidationError as error:
        return _refuse(path, explain(error, DeadManFile))
    if kept != _file_of(robot, kept.silence_s):
        base = f"{kept.kind} at {kept.port} with timeout_s {kept.timeout_s:g}"
        return _refuse(path, f"it is of {kept.robot}, a {base}")
    return kept.silence_s


def write_dead_man(home: Path, robot: RobotDescription, silence_s: float) -> None:
    """Write the file, whole or not at all.

    Raises:
        OSError: the disk refuses.
    """
    data = _file_of(robot, silence_s).model_dump_json(indent=1).encode() + b"\n"
    replace_file(dead_man_path(home, robot), data)


def _file_of(robot: RobotDescription, silence_s: float) -> DeadManFile:
    drive = robot.drive
    return DeadManFile(
        robot=robot.id,
        kind=drive.kind,
        port=drive.port,
        timeout_s=drive.timeout_s,
        silence_s=silence_s,
    )


def _refuse(path: Path, why: str) -> float | None:
    log.warning("dead_man_file_refused: %s: %s; the base counts as not tried", path, why)
    return None
