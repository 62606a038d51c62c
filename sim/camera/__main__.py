"""Start the simulated camera: ``python -m sim.camera --site sites/home [--robot robot.toml]``.

A camera of metal is drawn too where the simulator plays the robot (``pons up --twin``).
It draws what ``python -m sim`` says on sim/scene, and waits for it without end.
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
from pathlib import Path

from sim.camera.camera import SimCamera
from sim.camera.node import CameraNode
from sim.domain import load_domain
from sim.site import load_home
from sim.staging import staged_home
from wire import ConfigError, RobotDescription, load_robot
from wire.keys import Party
from wire.session import open_session

NICE = 5
"""A late picture is only late: everything else goes before it."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m sim.camera", description=__doc__)
    parser.add_argument("--site", type=Path, required=True, help="folder with a home.yaml")
    parser.add_argument("--robot", type=Path, help="robot.toml (default: the default robot)")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--domain", type=Path, help="how the home is worse (TOML)")
    parser.add_argument("--seed", type=int, default=0, help="seed of the noise (default 0)")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    # Handlers first: a signal during the slow part of the start must end the process cleanly too.
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    with contextlib.suppress(AttributeError, OSError):  # no Unix
        os.nice(NICE)
    robot = load_robot(options.robot) if options.robot else RobotDescription()
    if robot.camera.kind != "sim" and not robot.camera.is_real:
        raise ConfigError(
            "camera_not_simulated",
            f"camera.kind is {robot.camera.kind!r}; it draws 'sim', or for a real one",
        )
    drawn = load_home(options.site)
    if options.domain:
        drawn = staged_home(drawn, load_domain(options.domain))
    camera = SimCamera(drawn, robot.camera, seed=options.seed)
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    boot_id = f"cam-{secrets.token_hex(4)}"
    with open_session(Party.CAMERA, robot.id, home) as session:
        shell = CameraNode(camera, robot.camera, session, boot_id)
        gc.collect()
        gc.freeze()
        logging.getLogger("camera").info("%s looks at %s", boot_id, options.site)
        shell.run(stopped)


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
