"""A run in which a robot touched something ends with a status that nobody takes for a stall."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.contact import SEEN, STATUS

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize(("said", "ends_with"), [(f"{SEEN}: 1", STATUS), ("too late", 1)])
@pytest.mark.parametrize("apart", ["0", "1"])
def test_the_exit_status_tells_a_contact(
    said: str, ends_with: int, apart: str, repository: Path, tmp_path: Path
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
        [sys.executable, "-m", "pytest", "-q", "-n", apart, "-p", "no:cacheprovider", "."],
        cwd=tmp_path, env={"PYTHONPATH": str(repository), "PATH": ""},
        capture_output=True, text=True, check=False, timeout=50,
    )  # fmt: skip
    assert done.returncode == ends_with, done.stdout + done.stderr
