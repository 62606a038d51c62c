"""Run three simulated robots of one home and the fleet that gives them orders: ``pons fleet demo``.

Each robot is a ``pons up`` of its own, without a camera, in a folder that goes when it ends. The
simulator holds one robot a world: each drives in a home of its own, so that they don't meet. On
Ctrl-C, SIGTERM or its own death nothing is left running.
"""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from pons.launch_checks import CannotStart
from pons.robot_processes import free_port
from pons.supervisor import REFUSED_TO_START, Child
from pons.terminal import command_path, pick
from pons.up import say
from pons_assets import ROBOT_FILE

NAMES = ("r1", "r2", "r3")
DEFAULT_PORT = 8440
POLL_S = 0.2
READY_LIMIT_S = 300.0
PATIENCE_S = 15.0
"""``pons up`` takes its own children down in less."""
EXIT_DONE, EXIT_FAILED, EXIT_USAGE = 0, 1, 2
READY = "ready after "
"""What ``pons up`` prints once it can drive (pons/up.py)."""
LATE = "not_ready: "
"""What it ends with on a machine that is too busy; it is started again."""


class FleetDemo:
    """Own the robots and the service of one ``pons fleet demo``."""

    def __init__(self, folder: Path, port: int) -> None:
        """Describe them; ``run`` starts them.

        Args:
            folder: for all state and logs.
            port: of the fleet on the loopback.
        """
        self._folder, self._port = folder, port
        self._robots = {name: (self._robot(name), free_port()) for name in NAMES}
        for robot, robot_port in self._robots.values():
            robot.environment["PONS_PORT"] = str(robot_port)
        self._fleet = Child("fleet", ["fleet", "up", "--port", str(port)], folder / "fleet.log",
                            environment={"PONS_HOME": str(folder)})  # fmt: skip
        self._children = [self._fleet]
        """Those that are to run; a robot is started once the one before it is up."""
        self._ending = threading.Event()

    def _robot(self, name: str) -> Child:
        """Return a robot with a robot.toml of its own: its id, no camera, little to record."""
        home = self._folder / name
        home.mkdir()
        text = ROBOT_FILE.read_text("utf-8")
        for row, value in (("id", f'"{name}"'), ("total_mb", "256")):
            text = re.sub(rf"^{row} = \S+", f"{row} = {value}", text, count=1, flags=re.MULTILINE)
        text = re.sub(r'(\[camera\]\nkind = )"\w+"', r'\1"none"', text, count=1)
        (home / "robot.toml").write_text(text, "utf-8")
        where = {"PONS_HOME": str(home), "PONS_ROBOT": str(home / "robot.toml"),
                 "PONS_HOST": "127.0.0.1", "PONS_TLS": "0"}  # fmt: skip
        return Child(name, ["pons", "up"], self._folder / f"{name}.log", environment=where)

    def end(self, *_: object) -> None:
        """Ask it to finish; safe in a signal handler."""
        self._ending.set()

    def run(self) -> None:
        """Start all, tell the one URL, keep them running until asked to end.

        Raises:
            CannotStart: a part refuses to start, or is not ready in time.
        """
        began_s, waiting = time.monotonic(), list(NAMES)
        self._children.append(self._robots[waiting[0]][0])
        try:
            while not self._ending.is_set():
                self._tend(time.monotonic())
                if waiting and self._is_up(waiting[0]) and self._add(waiting[0]):
                    waiting.pop(0)
                    if waiting:
                        self._children.append(self._robots[waiting[0]][0])
                    else:
                        self._tell_ready(time.monotonic() - began_s)
                if waiting and time.monotonic() - began_s > READY_LIMIT_S:
                    raise CannotStart(f"not_ready: {', '.join(waiting)}")
                self._ending.wait(POLL_S)
        finally:
            self._take_down()

    def _tend(self, now_s: float) -> None:
        for child in self._children:
            status = child.died(now_s)
            if status == REFUSED_TO_START and LATE not in child.last_words():
                raise CannotStart(f"{child.name} refused to start:\n{child.last_words()}")
            if status is not None:
                say(f"{child.name} ended ({status}) and is started again; its log: {child.log}")
            if child.due(now_s):
                child.start(now_s)
            child.bound_log()

    def _is_up(self, name: str) -> bool:
        return READY in self._robots[name][0].last_words(50)

    def _add(self, name: str) -> bool:
        """Take a robot into the fleet; False where it must be tried again."""
        url = f"http://127.0.0.1:{self._robots[name][1]}"
        done = subprocess.run(
            [sys.executable, "-m", "fleet", "add", url, "--name", name, "--again"],
            env={**os.environ, **self._fleet.environment}, capture_output=True, text=True,
            check=False, timeout=60,
        )  # fmt: skip
        if done.returncode == 0:
            say(f"  {name}: {url}")
        return done.returncode == 0

    def _tell_ready(self, after_s: float) -> None:
        pons = command_path()
        if self._port != DEFAULT_PORT:
            pons = f"PONS_FLEET_PORT={self._port} {pons}"
        say(f"ready after {after_s:.1f} s: http://127.0.0.1:{self._port}")
        order = pick("everybody go to the kitchen", "大家去厨房")
        say(f'try: {pons} fleet say "{order}"   {pons} fleet list   {pons} fleet stop')

    def _take_down(self) -> None:
        for child in self._children:
            child.signal(signal.SIGTERM)  # all at once
        for child in self._children:
            child.stop(PATIENCE_S)


def main() -> int:
    """Run the demo until a signal comes."""
    port = int(os.environ.get("PONS_FLEET_PORT", DEFAULT_PORT))
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError as taken:
            cure = pick("set PONS_FLEET_PORT to another", "请用 PONS_FLEET_PORT 换一个端口")
            print(f"port_in_use: {port}: {taken.strerror}; {cure}", file=sys.stderr)
            return EXIT_USAGE
    with tempfile.TemporaryDirectory(prefix="pons-fleet-", ignore_cleanup_errors=True) as folder:
        demo = FleetDemo(Path(folder), port)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, demo.end)
        say(f"starting {', '.join(NAMES)} (simulated) and their fleet (state in {folder})")
        try:
            demo.run()
        except CannotStart as failed:
            print(failed, file=sys.stderr)
            return EXIT_FAILED
    return EXIT_DONE


if __name__ == "__main__":
    sys.exit(main())
