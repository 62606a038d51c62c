"""Keep a camera open on a thread of its own, and hold its newest picture for whoever asks.

Opening and reading wait as long as driver or network like. A camera that went is opened again
until it is there. Old pictures are dropped, never queued.
"""

from __future__ import annotations

import threading
import time
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sensors.camera.shot import CameraTrouble

if TYPE_CHECKING:
    from collections.abc import Callable

    from sensors.camera.shot import CameraShot, PictureSource

RETRY_S = 1.0
END_S = 4.0
"""A read that hangs ends by the source's own limits."""
_EACH = 8
"""Of each row and column: enough to tell two pictures apart by their noise."""


@dataclass(frozen=True, slots=True, eq=False)
class GrabbedPicture:
    """Hold a picture and when it came: as it was handed over, where its source knows no better."""

    shot: CameraShot
    at_s: float


class CameraGrabber:
    """Hold one camera."""

    def __init__(
        self,
        open_camera: Callable[[], PictureSource],
        retry_s: float = RETRY_S,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Begin to open it."""
        self._open, self._retry_s, self._clock = open_camera, retry_s, clock
        self._ending = threading.Event()
        self._newest: GrabbedPicture | None = None
        self._print = 0
        self.began_s = clock()
        self.trouble: CameraTrouble | None = None
        """Why it gives no pictures now; None while it is open, or not yet tried."""
        self.opened = 0
        self.pictures = 0
        self.changed_s = self.began_s
        """When a picture last differed from the one before."""
        self.size = (0, 0)
        """Width and height of the newest picture."""
        self._thread = threading.Thread(target=self._serve, name="camera", daemon=True)
        self._thread.start()

    def take(self) -> GrabbedPicture | None:
        """Return the newest picture, once."""
        newest, self._newest = self._newest, None
        return newest

    def close(self) -> None:
        """Give the camera back."""
        self._ending.set()
        self._thread.join(END_S)

    def _serve(self) -> None:
        while not self._ending.is_set():
            try:
                self._read_while_open()
            except CameraTrouble as trouble:
                self.trouble = trouble
            self._ending.wait(self._retry_s)

    def _read_while_open(self) -> None:
        source = self._open()
        try:
            self.opened += 1
            self.changed_s = self._clock()
            while not self._ending.is_set():
                self._note(source.read())
        finally:
            source.close()

    def _note(self, shot: CameraShot) -> None:
        now_s = self._clock()
        pixels = zlib.crc32(shot.color[::_EACH, ::_EACH].tobytes())
        if pixels != self._print:
            self._print, self.changed_s = pixels, now_s
        height, width = shot.color.shape[:2]
        self.size = (width, height)
        self._newest = GrabbedPicture(shot, now_s if shot.at_s is None else shot.at_s)
        self.pictures += 1
        self.trouble = None
