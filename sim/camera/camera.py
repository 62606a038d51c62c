"""Turn a scene into a colour and a depth picture with noise. Knows neither wire nor clock.

Two cameras with one seed that see the same scenes take the same pictures.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sim.camera.camera_faults import PicturePair, Shutter
from sim.camera.frame import Frame
from sim.camera.noise import spoil
from sim.camera.pictures import depth_png, jpeg
from sim.camera.renderer import Renderer
from sim.camera.surfaces import Appearance
from wire import SimFault

if TYPE_CHECKING:
    from sim.site import Home
    from wire import CameraConfig, SimScene


class SimCamera:
    """Take pictures of one home."""

    def __init__(self, home: Home, camera: CameraConfig, *, seed: int = 0) -> None:
        """Build the drawn world."""
        self._look = Appearance()
        self._renderer = Renderer(home, camera, self._look)
        self._rng = np.random.default_rng(seed)
        self._shutter = Shutter()

    def take(self, scene: SimScene, now_s: float) -> PicturePair | None:
        """Return the pictures that leave the camera now, or None, with the scene's stamp."""
        return self._shutter.through(self._take_pictures(scene), now_s, scene.faults)

    def frame(self, scene: SimScene) -> Frame:
        """Draw one picture, with the noise of a real one."""
        clean = self._renderer.render(scene.base_in_map, scene.things)
        return spoil(clean, self._rng, self._look.noise)

    def _take_pictures(self, scene: SimScene) -> PicturePair:
        frame = self.frame(scene)
        if SimFault.CAMERA_BLIND in scene.faults:
            frame = Frame(
                np.zeros_like(frame.color), np.zeros_like(frame.depth_m), frame.ids, frame.facing
            )
        return PicturePair(scene.stamp_s, jpeg(frame), depth_png(frame))
