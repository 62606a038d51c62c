"""Keep a robot's learnt braking between runs: one small file per robot and robot.toml.

Read once at start, while nothing has torque. Written by a thread of its own, never by the loop,
whole or not at all. The file's name holds robot.toml's hash: another robot.toml, such as one that
``pons calibrate`` has written, begins anew with what it says.
"""

from __future__ import annotations

import logging
import threading
from queue import SimpleQueue
from typing import TYPE_CHECKING, Literal

from pydantic import ValidationError

from bridge.core.state_motion import UNLEARNT, Learnt
from bridge.files import replace_file
from wire.base import Record
from wire.bounded_types import Fingerprint
from wire.robot import RobotId, explain

if TYPE_CHECKING:
    from pathlib import Path

    from wire import RobotDescription

log = logging.getLogger("bridge.braking")

FOLDER = "braking"
UNREADABLE = "braking_file_unreadable"
LAST_WORD_S = 2.0
MAX_BYTES = 10_000


class BrakingFile(Record):
    """Define the braking file's fields. The configured values are there for its readers."""

    version: Literal[1] = 1
    robot: RobotId
    robot_hash: Fingerprint
    lag_s: float
    decel_mps2: float
    learnt: Learnt


def path_of(home: Path, robot: RobotDescription) -> Path:
    """Return the path of a robot's braking file."""
    return home / FOLDER / f"{robot.id}-{robot.hash}.json"


def load_learnt(path: Path, robot: RobotDescription) -> tuple[Learnt, str | None]:
    """Return the braking learnt in earlier runs, and a code where the file can't be read.

    What can't be read makes nothing better than robot.toml says, so the robot may drive; it is
    said in the log and in every status.
    """
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        return UNLEARNT, None
    except OSError as error:
        return _refuse(path, str(error.strerror))
    if len(data) > MAX_BYTES:
        return _refuse(path, f"{len(data)} bytes, at most {MAX_BYTES}")
    try:
        kept = BrakingFile.model_validate_json(data, strict=True)
    except ValidationError as error:
        return _refuse(path, explain(error, BrakingFile))
    if (kept.robot, kept.robot_hash) != (robot.id, robot.hash):
        return _refuse(path, f"it is of robot {kept.robot} with robot.toml {kept.robot_hash}")
    return kept.learnt, None


def _refuse(path: Path, why: str) -> tuple[Learnt, str]:
    log.warning(
        "%s: %s: %s; robot.toml's values count until stops teach anew", UNREADABLE, path, why
    )
    return UNLEARNT, UNREADABLE


class BrakingKeeper:
    """Write learnt braking to disk in a thread. ``note`` costs the loop a comparison."""

    def __init__(self, path: Path, robot: RobotDescription, learnt: Learnt) -> None:
        """Start the thread. Before the loop takes its rank, which threads would inherit."""
        self._path = path
        self._robot = robot
        self._noted = learnt
        self._queue: SimpleQueue[Learnt | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="braking", daemon=True)
        self._thread.start()

    def note(self, learnt: Learnt) -> None:
        """Queue newly learnt braking; it changes only when a stop has come to standstill."""
        if learnt is not self._noted:
            self._noted = learnt
            self._queue.put(learnt)

    def close(self) -> bool:
        """Write the rest and return whether the thread has ended. After the loop only: it waits."""
        self._queue.put(None)
        self._thread.join(LAST_WORD_S)
        return not self._thread.is_alive()

    def _run(self) -> None:
        while (learnt := self._queue.get()) is not None:
            try:
                write_learnt(self._path, self._robot, learnt)
            except OSError as error:
                log.warning("braking_not_kept: %s: %s", self._path, error.strerror)


def write_learnt(path: Path, robot: RobotDescription, learnt: Learnt) -> None:
    """Write the file, whole or not at all.

    Raises:
        OSError: the disk refuses.
    """
    kept = BrakingFile(
        robot=robot.id,
        robot_hash=robot.hash,
        lag_s=robot.drive.lag_s,
        decel_mps2=robot.limits.max_decel_mps2,
        learnt=learnt,
    )
    replace_file(path, kept.model_dump_json(indent=1).encode() + b"\n")
