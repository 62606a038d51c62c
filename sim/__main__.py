"""Start the simulator: ``python -m sim --site sites/home [--robot robot.toml] [--home DIR]``.

``--twin LINK`` has it answer as a base on a serial line, not on the wire (docs/drives.md),
``--twin-firmware BUILD`` has our own firmware's bytes do so (docs/firmware.md),
``--lidar-twin LINK`` as a lidar (docs/lidars.md), ``--ros2-twin PORT`` as a whole ROS 2 robot
with its node (docs/ros2.md);
``--metal FILE`` makes motors and wheels differ from what robot.toml believes (docs/calibrate.md);
``--domain FILE`` turns the knobs of sim/domain.py (docs/sim2real.md).
"""

from __future__ import annotations

import argparse
import gc
import logging
import os
import secrets
import signal
import sys
import threading
from functools import partial
from pathlib import Path

from processes.log_lines import begin_log
from processes.priority import set_fifo
from sim.domain import load_domain
from sim.node import SimNode
from sim.robot import SimRobot
from sim.site import check_fresh
from sim.true_parameters import load_metal
from sim.twin import DriveTwin, LidarTwin, Ros2Twin
from sim.twin.avr_board import boot_build
from wire import ConfigError, Pose2, RobotDescription, load_robot
from wire.keys import Party
from wire.session import open_session

PRIORITY = 40
"""Of SCHED_FIFO, as a real motor controller or lidar waits for no busy machine; below the bridge's
loop: what stands for wheels and sensors must not be late before it is. Beside six busy loops on two
cores, encoders came 312 ms late and the bridge disarmed; with this they came in time (real-time
factor at worst 0.56 and 0.97)."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m sim", description=__doc__)
    parser.add_argument("--site", type=Path, required=True, help="folder with a home.yaml")
    parser.add_argument("--robot", type=Path, help="robot.toml (default: the default robot)")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--metal", type=Path, help="what the robot is really like (TOML)")
    parser.add_argument("--domain", type=Path, help="how home and robot are worse (TOML)")
    parser.add_argument(
        "--twin", type=Path, help="be the firmware of robot.toml's drive at a line of this name"
    )
    parser.add_argument(
        "--twin-firmware", type=Path, help="folder of a built firmware that the twin is to run"
    )
    parser.add_argument(
        "--lidar-twin", type=Path, help="be robot.toml's lidar at a line of this name"
    )
    parser.add_argument(
        "--ros2-twin", type=int, metavar="PORT", help="be a ROS 2 robot whose node listens there"
    )
    parser.add_argument("--seed", type=int, default=0, help="seed of all noise (default 0)")
    parser.add_argument(
        "--start", type=float, nargs=3, metavar=("X_M", "Y_M", "YAW_RAD"), help="default: the dock"
    )
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    # Handlers first: a signal during the slow part of the start must end the process cleanly too.
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    check_fresh(options.site)
    description = load_robot(options.robot) if options.robot else RobotDescription()
    boot_id = f"sim-{secrets.token_hex(4)}"
    start = Pose2(*options.start) if options.start else None
    hardware = load_metal(options.metal) if options.metal else None
    domain = load_domain(options.domain) if options.domain else None
    robot = SimRobot(
        options.site,
        description,
        seed=options.seed,
        start=start,
        hardware=hardware,
        domain=domain,
        boot_id=boot_id,
    )
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    own = partial(boot_build, build=options.twin_firmware) if options.twin_firmware else None
    twin = DriveTwin(description, options.twin, own) if options.twin else None
    lidar = LidarTwin(description.lidar, options.lidar_twin) if options.lidar_twin else None
    set_fifo(PRIORITY)  # before the session, whose threads inherit it
    port: int | None = options.ros2_twin
    ros2 = Ros2Twin(description, port) if port is not None else None
    with open_session(Party.ROBOT, description.id, home) as session:
        shell = SimNode(robot, session, twin, lidar, ros2)
        gc.collect()
        gc.freeze()
        logging.getLogger("sim").info(
            "%s drives in %s, seed %d", boot_id, options.site, options.seed
        )
        if domain is not None:
            logging.getLogger("sim").info(
                "domain: %s", domain.as_toml().strip().replace("\n", ", ")
            )
        shell.run(stopped.is_set)


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    begin_log()
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"sim: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
