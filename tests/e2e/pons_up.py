"""Run ``pons up`` as a person does, in a home of its own: the rig of stories and of chaos.

Owns its command line, environment and log, the search for its processes, and its end; opens no
session and judges nothing. ``pons.robot_processes`` is the rig without a supervisor, for those who
put a module of theirs in the place of a process.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from typing import TYPE_CHECKING

import psutil

from pons.robot_processes import ProcessGone, free_port
from pons.settings import CHECKOUT
from processes.parent_death import child_command

if TYPE_CHECKING:
    from pathlib import Path


class PonsUp:
    """Hold one ``pons up`` and all that it starts; it dies with this process."""

    def __init__(self, home: Path, site: Path, log: Path, **settings: str) -> None:
        """Describe it; ``launch`` starts it, and the caller may change it before.

        Args:
            home: becomes its ``$PONS_HOME``.
            site: folder of the site.
            log: takes what it prints.
            settings: more of its environment.
        """
        self.home, self.site, self.log = home, site, log
        self.port = free_port()
        self.scheme = "https" if settings.get("PONS_TLS") == "1" else "http"
        self.arguments: tuple[str, ...] = ()
        self.python, self.folder = sys.executable, CHECKOUT
        self.up: subprocess.Popen[bytes] | None = None
        self._settings = settings

    @property
    def environment(self) -> dict[str, str]:
        """Return what every process of this robot is started with."""
        ours = {
            "PONS_HOME": str(self.home),
            "PONS_PORT": str(self.port),
            "PONS_SITE": str(self.site),
            "PYTHONUNBUFFERED": "1",
        }
        return {**os.environ, **ours, **self._settings}

    def read_log(self) -> str:
        """Return what ``pons up`` has printed."""
        return self.log.read_text("utf-8", "replace") if self.log.is_file() else ""

    def launch(self) -> None:
        """Start ``pons up`` and come back at once; what it prints begins anew."""
        self.home.mkdir(parents=True, exist_ok=True)
        self.log.unlink(missing_ok=True)
        with self.log.open("ab") as log:
            self.up = subprocess.Popen(
                (self.python, *child_command("pons", "up", *self.arguments)[1:]),
                cwd=self.folder,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env=self.environment,
                start_new_session=True,
            )

    def has_greeted(self) -> bool:
        """Tell whether it has printed the line with its URL.

        Raises:
            ProcessGone: it does not run.
        """
        if self.up is None or self.up.poll() is not None:
            raise ProcessGone(f"pons up ended: {self.read_log()[-1500:]}")
        return f"{self.scheme}://127.0.0.1:{self.port}" in self.read_log()

    def command(self, *words: str) -> list[str]:
        """Return the command line of a ``pons`` command, as of a person in a shell."""
        return [self.python, "-m", "pons", *words]

    # Processes ----------------------------------------------------------------------------------

    def processes(self) -> list[psutil.Process]:
        """Return every living process that was started for this home, however deep."""
        found = []
        for process in psutil.process_iter():
            with suppress(psutil.NoSuchProcess, psutil.AccessDenied):
                ours = process.environ().get("PONS_HOME") == str(self.home)
                living = process.status() != psutil.STATUS_ZOMBIE
                if ours and living and process.pid != os.getpid():
                    found.append(process)
        return found

    def tree(self) -> list[psutil.Process]:
        """Return ``pons up`` and all below it, in this order; empty where it is gone."""
        if self.up is None:
            return []
        try:
            top = psutil.Process(self.up.pid)
            return [top, *top.children(recursive=True)]
        except psutil.NoSuchProcess:
            return []

    # End ----------------------------------------------------------------------------------------

    def end_by(self, number: signal.Signals, limit_s: float) -> None:
        """Send a signal and wait for the end.

        Raises:
            subprocess.TimeoutExpired: it still runs.
        """
        if self.up is not None:
            self.up.send_signal(number)
            self.up.wait(timeout=limit_s)
            self.up = None

    def destroy(self) -> None:
        """Leave nothing behind, whatever happened."""
        if self.up is not None:
            self.up.kill()
            self.up.wait()
            self.up = None
        for process in self.processes():
            with suppress(psutil.NoSuchProcess):
                process.kill()

    def tails(self, lines: int, newer_s: float = 0.0) -> dict[str, list[str]]:
        """Return the last lines of all logs by name, where written to since a time of the disk."""
        found = {}
        for path in (self.log, *sorted((self.home / "logs").glob("*.log"))):
            with suppress(OSError):
                if path == self.log or path.stat().st_mtime >= newer_s:
                    text = path.read_text("utf-8", "replace")
                    found[path.stem] = text.splitlines()[-lines:]
        return found
