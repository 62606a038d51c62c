"""One ``pons up`` owns a home; the right comes back with its holder's end, however it ends."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons.home_lock import HomeLock, HomeTaken, HomeUnwritable
from tests.known import known

ROOT = Path(__file__).resolve().parents[2]
AS_STRANGER = (
    "import sys\nimport pons.grammar\nfrom tests.as_user import main\n"
    "sys.exit(main(['61001', '61001', 'pons.__main__', *sys.argv[1:]]))\n"
)
"""The grammar loads while root may still read the interpreter."""
HOLDER = (
    "import sys, time\nfrom pathlib import Path\nfrom pons.home_lock import HomeLock\n"
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
        assert known(holder.stdout).readline() == "held\n"
        with pytest.raises(HomeTaken, match=str(holder.pid)):
            HomeLock(tmp_path)
        holder.kill()
        holder.wait()
        with HomeLock(tmp_path):
            pass


def test_a_lock_that_cannot_be_written_is_told_with_its_path(tmp_path: Path) -> None:
    (tmp_path / "run" / "up.lock").mkdir(parents=True)
    with pytest.raises(HomeUnwritable, match=rf"home_unwritable: {tmp_path}/run/up\.lock: "):
        HomeLock(tmp_path)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
@pytest.mark.parametrize(
    ("locale", "told"), [("C", "Permission denied"), ("zh_CN.UTF-8", "无法写入")]
)
def test_pons_up_in_a_home_that_it_may_not_write_says_so(locale: str, told: str) -> None:
    """As on a disk that was remounted read-only: the folders are there, the lock can't be had."""
    with TemporaryDirectory(prefix="ph-") as folder:
        home = Path(folder)
        home.chmod(0o755)
        (home / "logs").mkdir()
        (home / "run").mkdir()
        (home / "run" / "up.lock").write_text("1")
        done = subprocess.run(
            [sys.executable, "-c", AS_STRANGER, "up"],
            cwd=ROOT, capture_output=True, text=True, check=False, timeout=60,
            env={**os.environ, "PONS_HOME": folder, "PONS_PORT": "1", "LC_ALL": locale},
        )  # fmt: skip
    assert done.returncode == 2, done
    assert done.stderr.startswith("pons up: home_unwritable: ")
    assert done.stderr.count("\n") == (1 if locale == "C" else 2)
    assert told in done.stderr.splitlines()[-1]
