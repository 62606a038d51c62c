"""Each process, started alone by the very commands of units and compose, makes the whole robot."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons.robot_processes import free_port
from tests.deploy.installed import PROCESSES, ROOT, by_compose, by_units, moved

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(120), pytest.mark.nightly(keep=1)]
TWO_ROOM = ROOT / "sites" / "two_room"
READY_S = 60.0


@contextmanager
def running(command: list[str], home: Path, notify: str) -> Iterator[subprocess.Popen[bytes]]:
    """Run one process as a service manager would; end it by SIGTERM and hold that it ends well."""
    environment = {**os.environ, "PONS_HOME": str(home), "NOTIFY_SOCKET": notify}
    for name in ("PONS_OPERATOR_TOKEN", "PONS_VIEWER_TOKEN", "PONS_MODEL_URL"):
        environment.pop(name, None)
    with (home / "log").open("ab") as log:
        process = subprocess.Popen(
            command, cwd=ROOT, env=environment, stdout=log, stderr=log, start_new_session=True
        )
    try:
        yield process
        process.terminate()
        assert process.wait(10.0) in (0, -signal.SIGTERM), command
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def ready(port: int, home: Path) -> bool:
    token = home / "operator.token"
    headers = {"Authorization": f"Bearer {token.read_text()}"} if token.exists() else {}
    asked = urllib.request.Request(f"http://127.0.0.1:{port}/readyz", headers=headers)
    try:
        with urllib.request.urlopen(asked, timeout=2.0) as answer:
            return bool(json.load(answer)["status"] == "ready")
    except (urllib.error.URLError, OSError):
        return False


@pytest.mark.parametrize("commands", [by_units, by_compose])
def test_the_robot_is_ready(commands: Callable[[], dict[str, list[str]]]) -> None:
    with TemporaryDirectory(prefix="pd-") as folder, ExitStack() as stack:
        home = Path(folder)
        manager = stack.enter_context(closing(socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)))
        manager.bind(str(home / "notify"))
        manager.settimeout(READY_S)
        port = free_port()
        started = {
            name: stack.enter_context(
                running(moved(commands()[name], home, TWO_ROOM, port), home, str(home / "notify"))
            )
            for name in PROCESSES
        }
        words = {manager.recv(100) for _ in range(2)}
        assert words == {b"READY=1", b"WATCHDOG=1"}, (home / "log").read_text()
        end_s = time.monotonic() + READY_S
        while not ready(port, home):
            died = {name: one.poll() for name, one in started.items() if one.poll() is not None}
            assert not died, (died, (home / "log").read_text())
            assert time.monotonic() < end_s, (home / "log").read_text()
            time.sleep(0.2)


def test_a_token_is_made_once_for_its_user_alone(tmp_path: Path) -> None:
    script = str(ROOT / "deploy" / "with-token.sh")
    show = [script, "sh", "-c", 'printf %s "$PONS_OPERATOR_TOKEN"']
    environment = {**os.environ, "PONS_HOME": str(tmp_path)}
    both = [subprocess.Popen(show, env=environment, stdout=subprocess.PIPE) for _ in range(4)]
    tokens = {one.communicate()[0] for one in both}
    assert len(tokens) == 1
    (token,) = tokens
    assert len(token) == 48
    file = tmp_path / "operator.token"
    assert file.read_bytes() == token
    assert file.stat().st_mode & 0o077 == 0
    assert [path.name for path in tmp_path.iterdir()] == ["operator.token"]
    again = subprocess.run(show, env=environment, capture_output=True, check=True)
    assert again.stdout == token
    assert token not in again.stderr
    nowhere = {name: value for name, value in os.environ.items() if name != "PONS_HOME"}
    refused = subprocess.run(show, env=nowhere, capture_output=True, check=False)
    assert refused.returncode != 0
    assert b"PONS_HOME" in refused.stderr
