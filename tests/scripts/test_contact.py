"""A run in which a robot touched something ends with a status that nobody takes for a stall."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest

from tests.contact import SEEN, STATUS, Contacts

TOLD = [(f"{SEEN}: 1", STATUS), ("too late", 1)]


@pytest.mark.parametrize(("said", "ends_with"), TOLD)
def test_the_exit_status_tells_a_contact(
    said: str, ends_with: int, repository: Path, tmp_path: Path
) -> None:
    (tmp_path / "conftest.py").write_text(
        "from tests.contact import Contacts\n\n"
        "def pytest_configure(config):\n    config.pluginmanager.register(Contacts())\n",
        "utf-8",
    )
    (tmp_path / "test_a.py").write_text(
        f"def test_a() -> None:\n    assert 1 == 0, {said!r}\n\n\ndef test_b() -> None:\n    ...\n",
        "utf-8",
    )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-n", "0", "-p", "no:cacheprovider", "."],
        cwd=tmp_path, env={"PYTHONPATH": str(repository), "PATH": ""},
        capture_output=True, text=True, check=False, timeout=50,
    )  # fmt: skip
    assert done.returncode == ends_with, done.stdout + done.stderr


@pytest.mark.parametrize(("said", "ends_with"), TOLD)
def test_a_contact_is_heard_from_a_report_that_came_as_text(
    said: str, ends_with: int, request: pytest.FixtureRequest
) -> None:
    # The processes of xdist send their reports through these two hooks.
    failed = pytest.TestReport(
        "test_a.py::test_a", ("test_a.py", 0, "test_a"), {}, "failed", said, "call"
    )
    hook = request.config.hook
    sent = hook.pytest_report_to_serializable(config=request.config, report=failed)
    contacts = Contacts()
    contacts.pytest_runtest_logreport(
        hook.pytest_report_from_serializable(config=request.config, data=sent)
    )
    session = SimpleNamespace(exitstatus=1)
    contacts.pytest_sessionfinish(cast("pytest.Session", session))
    assert session.exitstatus == ends_with
