"""Read the camera of robot.toml: ``python -m sensors.camera --robot robot.toml [--home DIR]``.

It says pictures on ``camera/color`` and ``camera/depth``, and on ``camera/state`` how the camera is
(docs/sensors.md). One that is missing or pulled is waited for: a robot drives without pictures.
Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import contextlib
import logging
import os
import secrets
import sys
from functools import partial
from typing import TYPE_CHECKING

from sensors.camera.grabber import CameraGrabber
from sensors.camera.node import CameraProcess
from sensors.camera.realsense import load_library
from sensors.camera.shot import CameraTrouble
from sensors.camera.source import open_source, without_password
from sensors.process import run_sensor
from wire import CameraConfig, ConfigError
from wire.camera_config import REAL_CAMERAS
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from sensors.process import SensorRun

log = logging.getLogger("camera")

NICE = 5
"""A late picture is only late: everything else goes before it."""


def _serve(run: SensorRun) -> None:
    with contextlib.suppress(AttributeError, OSError):  # no Unix
        os.nice(NICE)
    config = run.robot.camera
    _check(config)
    camera = CameraGrabber(partial(open_source, config, run.robot.ros2))
    try:
        with open_session(Party.CAMERA, run.robot.id, run.home) as session:
            node = CameraProcess(camera, config, session, f"cam-{secrets.token_hex(4)}")
            run.settle()
            log.info("%s %s", config.kind, name_of(config))
            node.run(run.is_stopped)
    finally:
        camera.close()


def name_of(config: CameraConfig) -> str:
    """Return which camera it is, without a password."""
    named = config.device or without_password(config.url or "") or config.serial
    return named or "the first"


def _check(config: CameraConfig) -> None:
    """Refuse what waiting will not mend.

    Raises:
        ConfigError: ``camera_not_real`` or ``camera_library_missing``.
    """
    if not config.is_real:
        raise ConfigError(
            "camera_not_real",
            f"camera.kind is {config.kind!r}; this one reads {', '.join(REAL_CAMERAS)}",
        )
    if config.kind == "realsense":
        try:
            load_library()
        except CameraTrouble as trouble:
            raise ConfigError(trouble.code, trouble.detail) from None


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    return run_sensor("camera", __doc__, _serve, arguments)


if __name__ == "__main__":
    sys.exit(main())
