"""Over TLS, with the robot's own authority trusted, the page works by the machine's own name."""

from __future__ import annotations

import http.client
import os
import shutil
import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from playwright.sync_api import Browser

from pons.stop import CONFIRMED
from scripts.browser import behind, chromium
from tests.e2e.system import System, new_home

TOKEN = "a-token-of-this-story"
MACHINE = socket.gethostname().partition(".")[0].lower()


@pytest.fixture(scope="module")
def robot(browser: Browser) -> Iterator[System]:
    assert browser.is_connected()
    with new_home() as home:
        system = System(Path(home), PONS_TLS="1", PONS_HOST="0.0.0.0", PONS_OPERATOR_TOKEN=TOKEN)
        with system.running():
            yield system


@pytest.mark.nightly
@pytest.mark.e2e
def test_the_shell_speaks_tls_and_nobody_is_heard_in_clear(robot: System) -> None:
    done = robot.pons("stop")
    assert (done.returncode, done.stdout.strip()) == (0, CONFIRMED[0]), done.stderr
    done = robot.pons("status")
    assert done.returncode == 0, done.stderr
    with pytest.raises((http.client.HTTPException, OSError)):
        robot.http("GET", "/healthz")


@pytest.mark.nightly
@pytest.mark.e2e
def test_the_page_is_secure_by_the_machines_name_and_may_use_the_microphone(
    browser: Browser, robot: System
) -> None:
    if (certutil := shutil.which("certutil")) is None:
        pytest.skip(
            "no certutil here (Debian: libnss3-tools), so Chromium can't trust an authority"
        )
    with TemporaryDirectory(prefix="pons-tls-") as folder:
        trusted = Path(folder, ".pki", "nssdb")
        trusted.mkdir(parents=True)
        database = [certutil, "-d", f"sql:{trusted}"]
        subprocess.run([*database, "-N", "--empty-password"], check=True)
        authority = str(robot.home / "tls" / "ca.crt")
        subprocess.run([*database, "-A", "-t", "C,,", "-n", "pons", "-i", authority], check=True)
        own = browser.browser_type.launch(
            executable_path=behind(Path(folder), chromium() or ""),
            args=[
                *(["--no-sandbox"] if os.geteuid() == 0 else []),
                "--use-fake-device-for-media-stream",
                "--use-fake-ui-for-media-stream",
                f"--host-resolver-rules=MAP {MACHINE}.local 127.0.0.1",
            ],
            env={**os.environ, "HOME": folder},
        )
        try:
            page = own.new_page()
            page.set_default_timeout(60_000)  # this browser starts beside a robot and another one
            sockets: list[str] = []
            page.on("websocket", lambda opened: sockets.append(opened.url))
            page.goto(f"https://{MACHINE}.local:{robot.port}/#token={TOKEN}")
            page.wait_for_selector("#link[data-state=good]")
            assert page.evaluate("window.isSecureContext")
            assert set(sockets) == {f"wss://{MACHINE}.local:{robot.port}/v1/events"}
            tracks = (
                "navigator.mediaDevices.getUserMedia({audio: true}).then(s => s.getTracks().length)"
            )
            assert page.evaluate(tracks) == 1
        finally:
            own.close()
