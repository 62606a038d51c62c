"""Run the simulated camera as a process: read the newest scene, draw, send, at a steady pace.

Knows the wire's session and the clock. What the simulator does not say is not drawn: when it is
gone, so are the pictures. A period that is missed is skipped, never caught up.
"""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from sim.camera.view import focal_px
from sim.rate import SimPacer
from wire import ImageHeader, keys

if TYPE_CHECKING:
    import threading

    from sim.camera.camera import SimCamera
    from sim.camera.camera_faults import PicturePair
    from wire import CameraConfig
    from wire.session import Session

log = logging.getLogger("camera")

STALE_S = 0.5
"""A scene older than this lay in the socket while this process was frozen; nobody would look."""


class CameraNode:
    """Connect one simulated camera to the wire."""

    def __init__(
        self, camera: SimCamera, config: CameraConfig, session: Session, boot_id: str
    ) -> None:
        self._camera, self._config, self._boot_id = camera, config, boot_id
        self._scenes = session.subscriber(keys.SIM_SCENE)
        self._color = session.image_publisher(keys.CAMERA_COLOR)
        self._depth = session.image_publisher(keys.CAMERA_DEPTH)
        self._seq = 0

    def run(self, stopped: threading.Event) -> None:
        """Take pictures until told to stop."""
        pacer = SimPacer(1.0 / self._config.rate_hz, time.monotonic())
        while not stopped.wait(max(0.0, pacer.next_s - time.monotonic())):
            pacer.woke(time.monotonic())
            self._turn()

    def _turn(self) -> None:
        scene = self._scenes.newest()
        if scene is None or not self._has_listener:
            return
        now_s = time.monotonic()
        if not now_s - scene.stamp_s <= STALE_S:
            return
        shot = self._camera.take(scene, now_s)
        if shot is not None:
            self._send(shot)

    @property
    def _has_listener(self) -> bool:
        """Return whether anything subscribes: a picture that nothing receives is not drawn."""
        return self._color.has_listener or self._depth.has_listener

    def _send(self, shot: PicturePair) -> None:
        self._seq += 1
        config = self._config
        header = ImageHeader(
            boot_id=self._boot_id,
            seq=self._seq,
            stamp_s=shot.stamp_s,
            width=config.width_px,
            height=config.height_px,
            focal_px=focal_px(config),
            center_x_px=config.width_px / 2,
            center_y_px=config.height_px / 2,
        )
        self._color.put(header, shot.color)
        self._depth.put(header, shot.depth)
