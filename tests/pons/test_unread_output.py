"""A reader that has enough (``pons site list | head -1``) ends a command without a traceback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pons.__main__ import EXIT_UNREAD, main

PARSING = ["site", "list"]


def test_nothing_is_said_where_nobody_reads(repository: Path, tmp_path: Path) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)  # the reader has left before the first word
    made = subprocess.run(
        [sys.executable, "-m", "pons", *PARSING],
        stdout=write_end,
        stderr=subprocess.PIPE,
        cwd=repository,
        env={**os.environ, "PONS_HOME": str(tmp_path)},
        text=True,
        check=False,
    )
    os.close(write_end)
    assert (made.returncode, made.stderr) == (EXIT_UNREAD, "")


def test_another_pipe_that_breaks_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A socket or a serial line that breaks is a fault, and not a reader that has enough."""

    def breaks(words: list[str]) -> int:
        raise BrokenPipeError(words)

    monkeypatch.setattr("pons.__main__._run_command", breaks)
    with Path(os.devnull).open("w") as readable:
        monkeypatch.setattr(sys, "stdout", readable)
        with pytest.raises(BrokenPipeError):
            main(PARSING)
