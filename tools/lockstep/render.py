"""Take a picture of what the robot of a world would see now. Drawn on demand; costs 10 to 30 ms."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from sim.camera import Renderer
from sim.site import load_home

if TYPE_CHECKING:
    from pathlib import Path

    from sim import SimRobot
    from sim.camera import Frame
    from wire import CameraConfig


def frame_of(sim: SimRobot, folder: Path) -> Frame:
    """Return a clean picture from where a simulated robot truly stands.

    Args:
        sim: the robot, whose things stand where they were carried.
        folder: its site.
    """
    return _renderer(folder, sim.robot.camera).render(sim.base_in_map, sim.things.elsewhere)


def names_of(sim: SimRobot, folder: Path) -> dict[int, tuple[str, str]]:
    """Return instance and class of every id in such a picture."""
    return _renderer(folder, sim.robot.camera).labels


@lru_cache(maxsize=4)
def _renderer(folder: Path, camera: CameraConfig) -> Renderer:
    return Renderer(load_home(folder), camera)
