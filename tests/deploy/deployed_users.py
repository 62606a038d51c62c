"""Know the users of a deployed robot, and make its folders.

Users, groups and folders are those of deploy/systemd; numbers are this file's, so nothing need be
installed. Only root can start processes so.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from pons.settings import CHECKOUT

UNITS = CHECKOUT / "deploy" / "systemd"
INSTALLED = "/var/lib"
BRIDGE, PLANNER, SIM = "pons-bridge", "pons-planner", "pons-sim"
LOCALIZATION, CAMERA, LIDAR = "pons-localization", "pons-camera", "pons-lidar"
ROS2, IMU = "pons-ros2", "pons-imu"
MEMBER, STRANGER = "member", "stranger"
"""A person or program in the group pons, and one in none of the groups."""
USERS = {
    BRIDGE: 61_001,
    PLANNER: 61_002,
    SIM: 61_003,
    LOCALIZATION: 61_004,
    CAMERA: 61_005,
    LIDAR: 61_006,
    ROS2: 61_007,
    MEMBER: 61_008,
    STRANGER: 61_009,
    IMU: 61_010,
}
GROUPS = {
    "pons": 62_000, "pons-senses": 62_001, "pons-drive": 62_002, "pons-hint": 62_003,
    "pons-scan": 62_004, "pons-base": 62_005, "pons-gyro": 62_006, "i2c": 62_007, MEMBER: 62_008,
    "pons-goal": 62_010,
    STRANGER: 62_009,
}  # fmt: skip


def folders() -> dict[str, tuple[str, str, str]]:
    """Return mode, owner and group of each folder that tmpfiles.d makes, by its path."""
    lines = (UNITS / "pons.tmpfiles.conf").read_text("utf-8").splitlines()
    words = [line.split() for line in lines if line.startswith("d ")]
    return {path: (mode, owner, group) for _, path, mode, owner, group, _ in words}


def members() -> dict[str, set[str]]:
    """Return the users that sysusers.d puts into each group."""
    found: dict[str, set[str]] = {}
    for line in (UNITS / "pons.sysusers.conf").read_text("utf-8").splitlines():
        if line.startswith("m "):
            _, user, group = line.split()
            found.setdefault(group, set()).add(user)
    return found


def groups_of(user: str) -> list[str]:
    """Return a user's groups, its main one first."""
    if user == MEMBER:
        return [MEMBER, "pons"]
    mine = [group for group, users in members().items() if user in users]
    return sorted(mine, key=lambda group: group != "pons") or [STRANGER]


def numbers_of(user: str) -> list[str]:
    """Return a user's number and those of its groups, as two words of a command."""
    return [str(USERS[user]), ",".join(str(GROUPS[group]) for group in groups_of(user))]


@contextmanager
def home_as_deployed() -> Iterator[Path]:
    """Make the folders of tmpfiles.d in a place of their own; yield the robot's home."""
    with TemporaryDirectory(prefix="pu-", ignore_cleanup_errors=True) as folder:
        Path(folder).chmod(0o711)
        for path, (mode, owner, group) in folders().items():
            made = Path(folder) / Path(path).relative_to(INSTALLED)
            made.mkdir()
            os.chown(made, 0 if owner == "root" else USERS[owner], GROUPS[group])
            made.chmod(int(mode, 8))
        yield Path(folder) / "pons"
