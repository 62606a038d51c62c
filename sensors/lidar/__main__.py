"""Read the lidar of robot.toml: ``python -m sensors.lidar --robot robot.toml [--home DIR]``.

It opens ``lidar.port``, says each turn as ``scan``, and on ``lidar/state`` how well it reads
(docs/lidars.md). A port that is missing or pulled is waited for; what waiting will not mend refuses
the start. Exit status: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import logging
import secrets
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from devices import LastingPort, PortTrouble
from processes.priority import set_fifo
from sensors.lidar.kinds import LidarKind, kind_of
from sensors.lidar.node import LidarNode
from sensors.lidar.reader import LidarReader
from sensors.process import run_sensor
from wire import ConfigError
from wire.keys import Party
from wire.session import open_session

if TYPE_CHECKING:
    from sensors.process import SensorRun

log = logging.getLogger("lidar")

PRIORITY = 35
"""Of SCHED_FIFO; below the bridge, above localization, which waits for its scans."""


def _serve(run: SensorRun) -> None:
    kind = kind_of(run.robot.lidar)
    path = run.port or Path(run.robot.lidar.port or "")
    port = _open(kind, path)
    try:
        set_fifo(PRIORITY)  # before the session, whose threads inherit it
        with open_session(Party.LIDAR, run.robot.id, run.home) as session:
            reader = LidarReader(kind, port, str(path), f"lidar-{secrets.token_hex(4)}")
            node = LidarNode(reader, session)
            run.settle()
            log.info(
                "%s at %s, %d baud: %d beams, %d scans a turn",
                kind.name, path, kind.baud, kind.shape.beams, kind.shape.cuts,
            )  # fmt: skip
            node.run(run.is_stopped)
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
    return run_sensor("lidar", __doc__, _serve, arguments, port=True)


if __name__ == "__main__":
    sys.exit(main())
