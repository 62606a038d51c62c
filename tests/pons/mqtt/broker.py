"""Run Debian's mosquitto on a free port, with a password and TLS, for tests of the smart home."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import pytest

from pons.authority import issue
from pons.robot_processes import free_port

USER, PASSWORD = "robot", "s3cret word"
LIMIT_S = 10.0


def require_mosquitto() -> str:
    """Return the broker's program; skip aloud where it is not installed."""
    found = shutil.which("mosquitto", path="/usr/sbin:/usr/bin:/usr/local/sbin:/usr/local/bin")
    if found is None:
        pytest.skip("mosquitto is not installed (apt install mosquitto)")
    return found


class Broker:
    """Be one broker; entering starts it, and ``restart`` is a power cut."""

    def __init__(self, folder: Path) -> None:
        self._program, self._folder = require_mosquitto(), folder
        self.port = free_port()
        issued = issue(folder, "broker", {"127.0.0.1"}, set(), datetime.now(UTC))
        self.ca_file = issued.authority
        self._process: subprocess.Popen[bytes] | None = None
        passwords = folder / "passwords"
        passwords.touch(0o600)
        subprocess.run(
            ["mosquitto_passwd", "-b", str(passwords), USER, PASSWORD],
            check=True,
            capture_output=True,
        )
        (folder / "mosquitto.conf").write_text(
            f"listener {self.port} 127.0.0.1\nallow_anonymous false\npassword_file {passwords}\n"
            f"cafile {self.ca_file}\ncertfile {issued.planner}\nkeyfile {issued.planner}\n"
            f"persistence false\nlog_type error\nuser root\nmax_queued_messages 10000\n"
        )

    def start(self) -> None:
        """Start it and wait until it listens."""
        with (self._folder / "mosquitto.log").open("ab") as log:
            self._process = subprocess.Popen(
                [self._program, "-c", str(self._folder / "mosquitto.conf")],
                stdout=subprocess.DEVNULL,
                stderr=log,
            )
        end_s = time.monotonic() + LIMIT_S
        while time.monotonic() < end_s:
            with suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 1.0):
                return
            time.sleep(0.02)
        raise AssertionError((self._folder / "mosquitto.log").read_text())

    def end(self) -> None:
        """End it; its clients are cut off."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def table(self, home: Path, port: int | None = None) -> str:
        """Return the [mqtt] table that joins it, and write the files that it names.

        Args:
            home: the robot's home.
            port: another than the broker's own: of a line that leads to it.
        """
        secret = home / "broker-password"
        secret.write_text(PASSWORD)
        secret.chmod(0o600)
        return (
            f'[mqtt]\nhost = "127.0.0.1"\nport = {port or self.port}\nca_file = "{self.ca_file}"\n'
            f'username = "{USER}"\npassword_file = "{secret.name}"\npicture_s = 1.0\n'
        )
