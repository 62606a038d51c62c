"""Read the lidar of robot.toml: ``python -m sensors.lidar --robot robot.toml [--home DIR]``.

It opens ``lidar.port``, says each turn as ``scan``, and on ``lidar/state`` how well it reads
(docs/lidars.md). A port that is missing or pulled is waited for; what waiting will not mend refuses
the start. Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
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
from pathlib import Path

from devices import LastingPort, PortTrouble
from processes.priority import set_fifo
from sensors.lidar.kinds import LidarKind, kind_of
from sensors.lidar.node import LidarNode
from sensors.lidar.reader import LidarReader
from wire import ConfigError, load_robot
from wire.keys import Party
from wire.session import open_session

log = logging.getLogger("lidar")

PRIORITY = 35
"""Of SCHED_FIFO; below the bridge, above localization, which waits for its scans."""


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m sensors.lidar", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--site", type=Path, help="taken as every process's, and not used")
    parser.add_argument("--port", type=Path, help="in place of lidar.port: a twin's line")
    return parser.parse_args(arguments)


def _serve(options: argparse.Namespace) -> None:
    stopped = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stopped.set())
    robot = load_robot(options.robot)
    kind = kind_of(robot.lidar)
    path = options.port or Path(robot.lidar.port or "")
    home = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
    port = _open(kind, path)
    try:
        set_fifo(PRIORITY)  # before the session, whose threads inherit it
        with open_session(Party.LIDAR, robot.id, home) as session:
            reader = LidarReader(kind, port, str(path), f"lidar-{secrets.token_hex(4)}")
            node = LidarNode(reader, session)
            gc.collect()
            gc.freeze()
            log.info(
                "%s at %s, %d baud: %d beams, %d scans a turn",
                kind.name, path, kind.baud, kind.shape.beams, kind.shape.cuts,
            )  # fmt: skip
            node.run(stopped.is_set)
            reader.close()
    finally:
        port.close()


def _open(kind: LidarKind, path: Path) -> LastingPort:
    try:
        return LastingPort(path, kind.baud, dtr=kind.dtr)
    except PortTrouble as trouble:
        raise ConfigError(trouble.code, f"lidar.port {trouble.detail}") from None


def main(arguments: list[str] | None = None) -> int:
    """Return 0 after a clean end, 1 where its home can't be written at present, 2 when refused."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(name)s %(levelname)s %(message)s")
    try:
        _serve(_options(arguments))
    except ConfigError as error:
        print(f"lidar: {error}", file=sys.stderr)
        return error.exit_status
    return 0


if __name__ == "__main__":
    sys.exit(main())
