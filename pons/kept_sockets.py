"""Bring back a listener's socket whose name was removed, by a second name of the same socket.

A process that listens does not notice that its socket's name is gone: whoever is connected stays,
and nobody new gets in, no stop by a shell either. Under services of their own users nobody else
may remove it (docs/adr/0030-doors.md); under ``pons up`` everything is one user's.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from wire.doors import DOORS
from wire.keys import Party
from wire.sockets import Endpoints, is_listening

LISTENING = {
    "bridge": Party.BRIDGE,
    "setup": Party.BRIDGE,
    "sim": Party.ROBOT,
    "localization": Party.LOCALIZATION,
    "camera": Party.CAMERA,
    "lidar": Party.LIDAR,
    "ros2": Party.ROS2,
    "imu": Party.IMU,
}
"""Which party each child of ``pons up`` is."""


class KeptSockets:
    """Hold second names for the sockets of one home folder."""

    def __init__(self, home: Path) -> None:
        where = Endpoints(home)
        self._paths = {
            child: tuple(where.socket(door) for door in DOORS if door.listener is party)
            for child, party in LISTENING.items()
        }

    def look_after(self, child: str) -> list[str]:
        """Keep the sockets of a child that lives; return the paths that had to be brought back."""
        return [str(path) for path in self._paths.get(child, ()) if _is_brought_back(path)]

    def is_kept(self, child: str) -> bool:
        """Return whether a child listens at each of its sockets; false of one that has none."""
        paths = self._paths.get(child, ())
        return bool(paths) and all(_second(path).exists() for path in paths)

    def forget(self, child: str) -> None:
        """Keep nothing of a child that has died: its next life makes sockets of its own."""
        for path in self._paths.get(child, ()):
            with suppress(OSError):
                _second(path).unlink(missing_ok=True)


def _is_brought_back(path: Path) -> bool:
    """Link a name to the other one that is missing; tell whether that was the socket's own."""
    second = _second(path)
    try:
        found, kept = _inode(path), _inode(second)
        if found is None and kept is not None:
            os.link(second, path)
            return True
        # what a dead process left is in the way of the next one, and is not kept
        if found is not None and found != kept and is_listening(path):
            second.unlink(missing_ok=True)
            os.link(path, second)
    except OSError:
        pass  # a full disk, or a home that is read-only: the next look tries again
    return False


def _inode(path: Path) -> int | None:
    try:
        return path.lstat().st_ino
    except FileNotFoundError:
        return None


def _second(path: Path) -> Path:
    return path.with_name(f".{path.name}")
