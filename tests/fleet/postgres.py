"""Run Debian's Postgres as a cluster of our own, on a socket, by a user without rights."""

from __future__ import annotations

import os
import pwd
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


class Cluster:
    """Hold one cluster; it may be stopped as a machine that fails, and begun again."""

    def __init__(self, tools: Path, place: Path) -> None:
        self._tools, self.place = tools, place
        self._user = pwd.getpwnam("nobody") if os.geteuid() == 0 else pwd.getpwuid(os.geteuid())
        os.chown(place, self._user.pw_uid, self._user.pw_gid)
        self.run("initdb", "-D", str(place / "data"), "-U", "fleet", "-A", "trust", "-N")
        self.start()

    def url(self, database: str = "postgres") -> str:
        """Return the URL of a database."""
        return f"postgresql://fleet@/{database}?host={self.place}"

    def run(self, tool: str, *words: str) -> str:
        """Run one of Postgres' tools as the cluster's user; return what it prints."""
        return subprocess.run(
            [str(self._tools / tool), *words], check=True, capture_output=True, text=True,
            cwd=self.place, user=self._user.pw_uid, group=self._user.pw_gid, timeout=120,
            env={"PATH": os.environ["PATH"], "LC_ALL": "C.UTF-8", "PGHOST": str(self.place),
                 "PGUSER": "fleet"},
        ).stdout  # fmt: skip

    def make_database(self) -> str:
        """Make an empty database and return its URL."""
        name = f"fleet_{os.getpid()}_{time.monotonic_ns()}"
        self.run("createdb", name)
        return self.url(name)

    def start(self) -> None:
        """Start it and wait until it answers."""
        options = f"-k {self.place} -c listen_addresses= -c fsync=off"
        self.run("pg_ctl", "-D", str(self.place / "data"), "-l", str(self.place / "log"), "-w",
                 "-o", options, "start")  # fmt: skip

    def stop(self) -> None:
        """Let it fall: nothing is flushed and no client is told."""
        self.run("pg_ctl", "-D", str(self.place / "data"), "-m", "immediate", "-w", "stop")


@contextmanager
def running_cluster() -> Iterator[Cluster]:
    """Run a cluster in a folder of its own; skip the test where Postgres is not installed."""
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"))
    if not folders or not (folders[-1] / "initdb").exists():
        pytest.skip("no initdb and pg_ctl here: Postgres is not tried")
    place = Path(tempfile.mkdtemp(prefix="pg-", dir="/tmp"))  # names of sockets are short
    cluster = Cluster(folders[-1], place)
    try:
        yield cluster
    finally:
        cluster.stop()
        shutil.rmtree(place, ignore_errors=True)
