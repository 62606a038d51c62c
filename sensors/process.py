"""Run one sensor's process: its command line, its end when asked, its refusal in one line.

Exit status of each: 0 left when asked, 1 its home can't be written at present, 2 refused.
"""

from __future__ import annotations

import argparse
import gc
import os
import signal
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING

from processes.log_lines import begin_log
from wire import ConfigError, load_robot

if TYPE_CHECKING:
    from collections.abc import Callable

    from wire import RobotDescription

    Serve = Callable[["SensorRun"], None]


class SensorRun:
    """Hold what a sensor's process was started with."""

    def __init__(self, options: argparse.Namespace, robot: RobotDescription) -> None:
        self.robot = robot
        self.home: Path = options.home or Path(os.environ.get("PONS_HOME") or ".pons")
        self.port: Path | None = options.port
        """In place of the one that robot.toml names: a twin's line."""
        self._stopped = threading.Event()

    def is_stopped(self) -> bool:
        """Return whether it was told to end."""
        return self._stopped.is_set()

    def settle(self) -> None:
        """Take what lives for the whole run out of the collector's sight."""
        gc.collect()
        gc.freeze()

    def end_on_signals(self) -> None:
        """End when asked by SIGTERM or SIGINT."""
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda *_: self._stopped.set())


def run_sensor(
    name: str, about: str | None, serve: Serve, arguments: list[str] | None, *, port: bool = False
) -> int:
    """Serve until told to end; return the exit status.

    Args:
        name: of the package and its log: ``lidar`` is ``python -m sensors.lidar``.
        about: what ``--help`` says.
        serve: reads the sensor until the run is stopped; may raise ConfigError.
        arguments: of the command line; None takes the process's own.
        port: it hangs on a serial line, for which a twin may give another.
    """
    begin_log()
    parser = argparse.ArgumentParser(prog=f"python -m sensors.{name}", description=about)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml")
    parser.add_argument("--home", type=Path, help="$PONS_HOME (default: ./.pons)")
    parser.add_argument("--site", type=Path, help="taken as every process's, and not used")
    parser.set_defaults(port=None)
    if port:
        parser.add_argument("--port", type=Path, help=f"in place of {name}.port: a twin's line")
    try:
        options = parser.parse_args(arguments)
        run = SensorRun(options, load_robot(options.robot))
        run.end_on_signals()
        serve(run)
    except ConfigError as error:
        sys.stderr.write(f"{name}: {error}\n")
        return error.exit_status
    return 0
