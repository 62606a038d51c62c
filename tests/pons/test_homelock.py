"""One ``pons up`` owns a home; the right comes back with its holder's end, however it ends."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pons.homelock import HomeLock, HomeTaken

ROOT = Path(__file__).resolve().parents[2]
HOLDER = (
    "import sys, time\nfrom pathlib import Path\nfrom pons.homelock import HomeLock\n"
    "with HomeLock(Path(sys.argv[1])):\n    print('held', flush=True)\n    time.sleep(60)\n"
)


def test_a_second_holder_is_refused_and_told_who_holds(tmp_path: Path) -> None:
    with HomeLock(tmp_path), pytest.raises(HomeTaken, match=f"already_running.*{os.getpid()}"):
        HomeLock(tmp_path)


def test_what_was_given_back_can_be_taken(tmp_path: Path) -> None:
    with HomeLock(tmp_path):
        pass
    with HomeLock(tmp_path):
        pass


def test_two_homes_are_two_rights(tmp_path: Path) -> None:
    with HomeLock(tmp_path / "a"), HomeLock(tmp_path / "b"):
        pass


def test_a_killed_holder_leaves_no_lock(tmp_path: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(tmp_path)], stdout=subprocess.PIPE, text=True, cwd=ROOT
    ) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(HomeTaken, match=str(holder.pid)):
            HomeLock(tmp_path)
        holder.kill()
        holder.wait()
        with HomeLock(tmp_path):
            pass
