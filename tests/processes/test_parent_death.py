"""A bound process never begins for a parent that is gone, and its command line says its module."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from processes.parent_death import (
    MODULE,
    PARENT_GONE,
    USAGE,
    child_command,
    module_in,
    worker_command,
)

SHOWING = "import os, sys\nprint(__name__, sys.argv, os.nice(0), flush=True)\n"


@pytest.fixture
def showing(tmp_path: Path, repository: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    (tmp_path / "showing.py").write_text(SHOWING)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}:{repository}")
    return "showing"


def run(command: tuple[str, ...]) -> tuple[int, str]:
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=30)
    return done.returncode, done.stdout + done.stderr


def test_the_module_becomes_main_with_its_own_arguments(showing: str) -> None:
    status, text = run(child_command(showing, "--kill", "a"))
    assert (status, text) == (0, f"__main__ {[showing_file(text), '--kill', 'a']} {os.nice(0)}\n")
    assert run(worker_command(showing))[1].endswith(f" {min(os.nice(0) + 10, 19)}\n")


def showing_file(text: str) -> str:
    """Return the path that runpy puts in the place of the module's name."""
    return text.split("'")[1]


@pytest.mark.parametrize("make", [child_command, worker_command])
def test_nothing_begins_for_a_parent_that_is_gone(
    showing: str, make: Callable[[str], tuple[str, ...]]
) -> None:
    command = list(make(showing))
    command[command.index(str(os.getpid()))] = str(os.getpid() + 1)
    assert run(tuple(command)) == (PARENT_GONE, "")


@pytest.mark.parametrize("words", [[], ["1"], ["1", "--kill"], ["pid", "module"]])
def test_a_command_line_without_parent_or_module_is_refused(words: list[str]) -> None:
    assert run((sys.executable, "-m", MODULE, *words)) == (2, f"{USAGE}\n")


def test_the_module_of_a_command_line_is_known() -> None:
    assert module_in(child_command("sim", "--home", "/h")) == "sim"
    assert module_in(child_command("sim.camera", session_nice=5)) == "sim.camera"
    assert module_in(worker_command("planner.voice.process_main")) == "planner.voice.process_main"
    assert module_in([sys.executable, "-m", "sim"]) is None
    assert module_in([sys.executable, "-m", MODULE]) is None
