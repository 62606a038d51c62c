"""Run one camera as a process: say its newest picture at robot.toml's pace, and how it is."""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING, Any

import cv2

from sensors.camera.health import STARTING, CameraHealth
from wire import CameraStatus, ImageHeader, keys

if TYPE_CHECKING:
    from collections.abc import Callable

    from sensors.camera.grabber import CameraGrabber, GrabbedPicture
    from wire import CameraConfig
    from wire.session import Session

log = logging.getLogger("camera")

PERIOD_S = 0.01
STATE_S = 0.5
STALE_S = 0.5
"""A picture that waited so long, while this process was frozen, is of no more use."""
JPEG = [cv2.IMWRITE_JPEG_QUALITY, 85]
PNG = [cv2.IMWRITE_PNG_COMPRESSION, 0]
"""As the simulated camera's: packing would cost three times the time at both ends."""


class CameraProcess:
    """Connect one camera to the wire."""

    def __init__(
        self, camera: CameraGrabber, config: CameraConfig, session: Session, boot_id: str
    ) -> None:
        self._camera, self._config, self._boot_id = camera, config, boot_id
        self._color = session.image_publisher(keys.CAMERA_COLOR)
        self._depth = session.image_publisher(keys.CAMERA_DEPTH)
        self._state = session.publisher(keys.CAMERA_STATE)
        self._health = CameraHealth(config)
        self._code: str | None = STARTING
        self._seq = self._states = 0
        self._next_s = self._said_s = float("-inf")

    def run(self, stopped: Callable[[], bool]) -> None:
        """Turn until told to stop."""
        while not stopped():
            time.sleep(PERIOD_S)
            self.turn(time.monotonic())

    def turn(self, now_s: float) -> None:
        """Say the newest picture when one is due, and twice a second how the camera is."""
        if now_s >= self._next_s:
            picture = self._camera.take()
            if picture is not None:
                self._next_s = max(self._next_s + 1.0 / self._config.rate_hz, now_s)
                if now_s - picture.at_s <= STALE_S and self._has_listener:
                    self._send(picture)
        self._say(now_s)

    @property
    def _has_listener(self) -> bool:
        """Return whether anything subscribes: a picture that nothing receives is not packed."""
        return self._color.has_listener or self._depth.has_listener

    def _send(self, picture: GrabbedPicture) -> None:
        shot = picture.shot
        color = _pack(".jpg", shot.color, JPEG)
        depth = None if shot.depth_mm is None else _pack(".png", shot.depth_mm, PNG)
        largest = max(len(color), len(depth or b""))
        self._health.too_large_bytes = largest if largest > keys.IMAGE else 0
        if self._health.too_large_bytes:
            return
        self._seq += 1
        height, width = shot.color.shape[:2]
        header = ImageHeader(
            boot_id=self._boot_id,
            seq=self._seq,
            stamp_s=max(0.0, picture.at_s - self._config.delay_s),
            width=width,
            height=height,
            focal_px=shot.focal_px,
            center_x_px=shot.center_px[0],
            center_y_px=shot.center_px[1],
        )
        self._color.put(header, color)
        if depth is not None:
            self._depth.put(header, depth)

    def _say(self, now_s: float) -> None:
        verdict = self._health.judge(self._camera, now_s)
        code = verdict.code if verdict else None
        if code == self._code and now_s - self._said_s < STATE_S:
            return
        if code != self._code:
            width, height = self._camera.size
            level = logging.INFO if code in (None, STARTING) else logging.WARNING
            fine = f"the camera gives pictures of {width} x {height}"
            log.log(level, "%s", f"{code}: {verdict.detail}" if verdict else fine)
        self._code, self._said_s = code, now_s
        self._states += 1
        self._state.put(
            CameraStatus(
                boot_id=self._boot_id,
                seq=self._states,
                stamp_s=now_s,
                model=self._config.kind,
                code=code,
                detail=verdict.detail[:400] if verdict else "",
                rate_hz=round(self._health.rate_hz, 2),
                width=self._camera.size[0],
                height=self._camera.size[1],
                sent=self._seq,
                opened=self._camera.opened,
            )
        )


def _pack(kind: str, picture: Any, options: list[int]) -> bytes:
    done, data = cv2.imencode(kind, picture, options)
    return bytes(data) if done else b""
