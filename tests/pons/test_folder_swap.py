"""Two folders change places in one step: whoever looks, or is killed, finds one of the two."""

from __future__ import annotations

import signal
import sys
from pathlib import Path
from subprocess import PIPE, Popen

import pytest

from pons.folder_swap import swap_folders
from pons.settings import CHECKOUT
from tests.known import known

LOOKS = 2_000
SWAPPER = """
import sys
from pathlib import Path
from pons.folder_swap import swap_folders
print("begun", flush=True)
while True:
    swap_folders(Path(sys.argv[1]), Path(sys.argv[2]))
"""


def folders(parent: Path) -> tuple[Path, Path]:
    for name in ("one", "other"):
        (parent / name).mkdir()
        (parent / name / "file").write_text(name)
    return parent / "one", parent / "other"


def test_each_has_what_the_other_had(tmp_path: Path) -> None:
    one, other = folders(tmp_path)
    swap_folders(one, other)
    assert [(path / "file").read_text() for path in (one, other)] == ["other", "one"]


def test_without_the_other_nothing_happens(tmp_path: Path) -> None:
    one, other = folders(tmp_path)
    with pytest.raises(FileNotFoundError):
        swap_folders(one, tmp_path / "third")
    assert (one / "file").read_text() == "one"
    assert (other / "file").read_text() == "other"


def test_there_is_always_one_of_the_two_and_a_kill_leaves_both_whole(tmp_path: Path) -> None:
    one, other = folders(tmp_path)
    words = [sys.executable, "-c", SWAPPER, str(one), str(other)]
    with Popen(words, cwd=CHECKOUT, stdout=PIPE) as child:
        known(child.stdout).readline()
        for _ in range(LOOKS):
            assert (one / "file").stat().st_size in {3, 5}
        child.send_signal(signal.SIGKILL)
    found = {(path / "file").read_text() for path in (one, other)}
    assert found == {"one", "other"}
