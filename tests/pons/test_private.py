"""What ``pons up`` keeps is for the user who runs it."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from pons import launch
from pons.settings import load
from pons.supervisor import REFUSED_TO_START


def test_what_a_robot_keeps_is_readable_by_its_own_user_alone(tmp_path: Path) -> None:
    """Children inherit the mask: journal, recordings, places and logs are made under it."""
    before = os.umask(0o022)
    try:
        settings = replace(load(), home=tmp_path / "h", site=tmp_path / "none")
        assert launch.run(settings) == REFUSED_TO_START
        (tmp_path / "file").touch()
    finally:
        os.umask(before)
    assert (tmp_path / "file").stat().st_mode & 0o777 == 0o600
