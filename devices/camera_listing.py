"""List the cameras that Video4Linux knows, with the name that each keeps.

A camera has several nodes; those that give pictures are told apart by ``index`` 0. Reads sysfs and
links alone: nothing is opened.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Final

CLASS: Final = Path("/sys/class/video4linux")
BY_ID: Final = Path("/dev/v4l/by-id")
BY_PATH: Final = Path("/dev/v4l/by-path")
NOT_CAMERAS: Final = ("bcm2835-codec", "bcm2835-isp", "rpi-hevc", "rpivid", "pispbe", "rp1-cfe")
"""Names of a Raspberry Pi's codecs and picture pipes, which are no cameras to Video4Linux."""


@dataclass(frozen=True, slots=True)
class CameraEntry:
    """Describe one camera."""

    path: Path
    """/dev/video*, which changes with the order of plugging."""
    lasting: Path
    """The name that stays: by-id, else by-path, else ``path``."""
    name: str
    """As its driver says."""
    is_permitted: bool


def list_cameras(
    sysfs: Path = CLASS, by_id: Path = BY_ID, by_path: Path = BY_PATH, dev: Path = Path("/dev")
) -> list[CameraEntry]:
    """Return the cameras, by number."""
    try:
        nodes = sorted(sysfs.iterdir(), key=lambda node: (len(node.name), node.name))
    except OSError:
        return []
    lasting = {**_links(by_path), **_links(by_id)}
    found = []
    for node in nodes:
        name = _read(node / "name")
        if not node.name.startswith("video") or _read(node / "index") != "0":
            continue
        if name.startswith(NOT_CAMERAS):
            continue
        path = dev / node.name
        known = lasting.get(node.name, path)
        found.append(CameraEntry(path, known, name, os.access(path, os.R_OK | os.W_OK)))
    return found


def _links(folder: Path) -> dict[str, Path]:
    """Return which link leads to which node."""
    try:
        return {link.readlink().name: link for link in sorted(folder.iterdir())}
    except OSError:
        return {}


def _read(path: Path) -> str:
    try:
        return path.read_text("utf-8", "replace").strip()
    except OSError:
        return ""
