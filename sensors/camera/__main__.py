"""Read the camera of robot.toml: ``python -m sensors.camera --robot robot.toml [--home DIR]``.

It says pictures on ``camera/color`` and ``camera/depth``, and on ``camera/state`` how the camera is
(docs/sensors.md). One that is missing or pulled is waited for: a robot drives without pictures.
Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import argparse
import contextlib
import gc
import logging
import os
import secrets
import signal
import sys
import threading
from functools import partial
from pathlib import Path

from sensors.camera.grabber import CameraGrabber
from sensors.camera.node import CameraProcess
from sensors.camera.realsense import load_library
from sensors.camera.shot import CameraTrouble
from sensors.camera.source import open_source, without_password
from wire import CameraConfig, ConfigError, load_robot
from wire.keys import Party
from wire.session import open_session

log = logging.getLogger("camera")

NICE = 5
"""A late picture is only late: everything else goes before it."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m sensors.camera", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--site", type=Path, help="taken as every process's, and not used")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    with contextlib.suppress(AttributeError, OSError):  # no Unix
        os.nice(NICE)
    robot = load_robot(options.robot)
    config = robot.camera
    _check(config)
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    camera = CameraGrabber(partial(open_source, config))
    try:
        with open_session(Party.CAMERA, robot.id, home) as session:
            node = CameraProcess(camera, config, session, f"cam-{secrets.token_hex(4)}")
            gc.collect()
            gc.freeze()
            log.info("%s %s", config.kind, name_of(config))
            node.run(stopped.is_set)
    finally:
        camera.close()


def name_of(config: CameraConfig) -> str:
    """Return which camera it is, without a password."""
    return config.device or without_password(config.url or "") or config.serial or "the first"


def _check(config: CameraConfig) -> None:
    """Refuse what waiting will not mend.

    Raises:
        ConfigError: ``camera_not_real`` or ``camera_library_missing``.
    """
    if not config.is_real:
        raise ConfigError(
            "camera_not_real",
            f"camera.kind is {config.kind!r}; this one reads uvc, stream, realsense",
        )
    if config.kind == "realsense":
        try:
            load_library()
        except CameraTrouble as trouble:
            raise ConfigError(trouble.code, trouble.detail) from None


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"camera: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
