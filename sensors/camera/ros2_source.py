"""Read the pictures that a ROS 2 robot publishes packed, over a connection of their own.

Knows no ROS: ``ros2.picture_stream`` is the one door to it (.importlinter, docs/adr/0055).
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from ros2.picture_stream import PictureStream, TopicFailure
from sensors.camera.packed_picture import unpack
from sensors.camera.shot import CameraTrouble, shot_of

if TYPE_CHECKING:
    from ros2.picture_stream import StreamedPicture
    from sensors.camera.shot import CameraShot
    from wire import CameraConfig
    from wire.ros2_config import Ros2Config

OPEN_S, READ_S = 5.0, 3.0
"""As a camera on the network: until its first picture, and until its next."""


class Ros2Source:
    """Take the newest picture of a topic, again and again."""

    def __init__(self, config: CameraConfig, ros2: Ros2Config) -> None:
        """Begin to reach the graph.

        Args:
            config: [camera] of robot.toml, with its ``topic``.
            ros2: how its base is reached, and its camera too.
        """
        self._config, self._topic = config, config.topic or ""
        # Half of the period: at a whole one every other picture would come just too early.
        self._stream = PictureStream(ros2, self._topic, round(500.0 / config.rate_hz))
        self._has_given = False

    def read(self) -> CameraShot:
        """Wait for the next picture and return it; a spoilt one is passed over.

        Raises:
            CameraTrouble: ``camera_gone``, where pictures came before; else why none comes: a code
                of ``ros2.trouble``, ``camera_picture_unreadable`` or ``camera_too_large``.
        """
        end_s = time.monotonic() + (READ_S if self._has_given else OPEN_S)
        spoilt: CameraTrouble | None = None
        while True:
            try:
                picture = self._stream.take(end_s - time.monotonic())
            except TopicFailure as why:
                raise spoilt or self._trouble_of(why) from None
            try:
                shot = self._shot_of(picture)
            except CameraTrouble as why:
                spoilt = why
                if time.monotonic() >= end_s:
                    raise
                continue
            self._has_given = True
            return shot

    def close(self) -> None:
        """Leave the graph."""
        self._stream.close()

    def _shot_of(self, picture: StreamedPicture) -> CameraShot:
        color = unpack(picture.packed.data, picture.packed.format, self._topic)
        return shot_of(color, self._config, picture.at_s)

    def _trouble_of(self, why: TopicFailure) -> CameraTrouble:
        trouble = why.trouble
        if self._has_given:
            return CameraTrouble("camera_gone", f"no picture in {READ_S:g} s: {trouble.found}")
        return CameraTrouble(trouble.code, trouble.found)
