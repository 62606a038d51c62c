"""Build the firmware once a run: its core for this computer, and its own bytes with their board."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.conftest import ROOT

FIRMWARE = ROOT / "firmware"


@pytest.fixture(scope="session")
def host_library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the library with the firmware's core, or skip."""
    require("gcc", "make")
    return build(tmp_path_factory.mktemp("firmware-host"), "host") / "libpons_mcu.so"


@pytest.fixture(scope="session")
def board_build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder with the simulated board and the firmware's bytes, or skip."""
    require("gcc", "make", "avr-gcc")
    if not Path("/usr/include/simavr/sim_avr.h").is_file():
        pytest.skip("simavr's headers are not installed (apt: libsimavr-dev libelf-dev)")
    return build(tmp_path_factory.mktemp("firmware-board"), "board")


def require(*programs: str) -> None:
    """Skip, and say which program is missing."""
    for program in programs:
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not installed (apt: gcc gcc-avr avr-libc)")


def build(folder: Path, target: str, *words: str) -> Path:
    """Build a target of firmware/Makefile into a folder of its own."""
    done = subprocess.run(
        ["make", "-s", "-C", FIRMWARE, target, f"BUILD={folder}", *words],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder
