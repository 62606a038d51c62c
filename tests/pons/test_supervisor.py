"""A child is started, noticed dead, started again later each time, and never outlives us."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from pons.supervisor import BEHIND, FIRST_PAUSE_S, HANG_S, TOKENS, Child
from sim.camera.__main__ import NICE
from tests.known import known
from tests.processes.nice_values import leads_its_session, stand_of

SLEEPER = "import time\nprint('awake', flush=True)\ntime.sleep(60)\n"
STUBBORN = (
    "import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
    "print('deaf', flush=True)\ntime.sleep(60)\n"
)
LOUD = "import time\nwhile True:\n    print('loud ' * 40, flush=True)\n    time.sleep(0.0001)\n"
SHOWING = "import os\nprint(sorted(n for n in os.environ if n.endswith('_TOKEN')), flush=True)\n"
FAILING = "import sys\nprint('my last words')\nsys.exit(7)\n"
FED = (
    "import os, socket, time\n"
    "ears = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)\n"
    "ears.connect(chr(0) + os.environ['NOTIFY_SOCKET'][1:])\n"
    "ears.send(b'READY=1')\nprint('fed', flush=True)\ntime.sleep(60)\n"
)
PARENT = """
import sys, time
from pathlib import Path
from pons.supervisor import Child
child = Child("sleeper", ["sleeper"], Path(sys.argv[1]) / "log")
child.start(0.0)
print(child.process.pid, flush=True)
time.sleep(60)
"""


@pytest.fixture
def modules(tmp_path: Path) -> Path:
    bodies = {"sleeper": SLEEPER, "stubborn": STUBBORN, "failing": FAILING, "loud": LOUD,
              "fed": FED, "showing": SHOWING}  # fmt: skip
    for name, body in bodies.items():
        (tmp_path / f"{name}.py").write_text(body)
    return tmp_path


@pytest.fixture
def child(modules: Path, request: pytest.FixtureRequest) -> Iterator[Child]:
    module = str(request.param)
    made = Child(
        module, [module], modules / "log", {"PYTHONPATH": f"{modules}:{Path(__file__).parents[2]}"}
    )
    yield made
    made.stop(0.1)


def gone(pid: int, limit_s: float = 10.0) -> bool:
    try:
        psutil.Process(pid).wait(timeout=limit_s)
    except psutil.NoSuchProcess:
        return True
    except psutil.TimeoutExpired:
        return False
    return True


def wait_for_word(log: Path, word: str) -> None:
    """Wait for a real process, which needs real time, to have come so far."""
    end_s = time.monotonic() + 10.0
    while time.monotonic() < end_s:
        if log.is_file() and word in log.read_text():
            return
        time.sleep(0.02)
    pytest.fail(f"{word!r} never came")


@pytest.mark.parametrize("child", ["failing"], indirect=True)
def test_a_death_is_noticed_once_and_its_words_kept(child: Child) -> None:
    child.log.write_text("words of an earlier run\n")
    child.start(100.0)
    known(child.process).wait()
    assert child.died(101.0) == 7
    assert child.died(101.1) is None
    assert child.last_words() == "my last words"
    assert not child.due(101.0 + FIRST_PAUSE_S / 2)
    assert child.due(101.0 + FIRST_PAUSE_S)


@pytest.mark.parametrize("child", ["failing"], indirect=True)
def test_a_child_whose_log_cannot_be_opened_runs_all_the_same(child: Child) -> None:
    child.log.mkdir()  # root may write where a mode forbids it, but not this
    child.start(100.0)
    assert known(child.process).wait() == 7
    assert child.died(101.0) == 7
    assert child.last_words() == ""


@pytest.mark.parametrize("child", ["sleeper"], indirect=True)
def test_stopping_ends_the_process(child: Child) -> None:
    child.start(0.0)
    pid = known(child.process).pid
    child.stop(5.0)
    assert gone(pid)
    assert child.process is None


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_the_session_of_a_camera_stands_behind_the_others(
    modules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (modules / "sim").mkdir()
    (modules / "sim" / "__init__.py").touch()
    (modules / "sleeper.py").rename(modules / "sim" / "camera.py")
    monkeypatch.chdir(modules)  # in its place
    path = {"PYTHONPATH": str(Path(__file__).parents[2])}
    child = Child("camera", ["sim.camera"], modules / "log", path)
    try:
        child.start(0.0)
        wait_for_word(child.log, "awake")
        assert leads_its_session(known(child.process).pid)
        nice, session = stand_of(known(child.process).pid)
        assert (nice, session) == (os.nice(0), None if session is None else NICE)
        assert child.log.read_text() == "awake\n", "to stand behind takes no right"
    finally:
        child.stop(5.0)
    assert BEHIND == {"sim.camera": NICE}


@pytest.mark.parametrize("child", ["fed"], indirect=True)
def test_a_child_whose_loop_falls_silent_is_killed_and_due_again(child: Child) -> None:
    child.is_watched = True
    child.start(0.0)
    wait_for_word(child.log, "fed")
    assert not child.kill_if_hung(100.0), "counted from what it said, however late that is read"
    assert not child.kill_if_hung(100.0 + HANG_S)
    known(child.process).send_signal(signal.SIGSTOP)
    assert child.kill_if_hung(100.1 + HANG_S)
    known(child.process).wait(10.0)
    assert child.died(101.0 + HANG_S) == -signal.SIGKILL
    assert child.due(101.0 + HANG_S + FIRST_PAUSE_S)


@pytest.mark.parametrize("child", ["sleeper"], indirect=True)
@pytest.mark.parametrize("is_watched", [True, False])
def test_a_slow_start_and_an_unwatched_child_are_let_be(child: Child, is_watched: bool) -> None:
    child.is_watched = is_watched
    child.start(0.0)
    assert not child.kill_if_hung(1e6)


@pytest.mark.parametrize("child", ["stubborn"], indirect=True)
def test_a_child_that_will_not_end_is_killed(child: Child) -> None:
    child.start(0.0)
    pid = known(child.process).pid
    wait_for_word(child.log, "deaf")
    child.stop(0.2)
    assert gone(pid)


def test_a_killed_parent_takes_its_child_along(modules: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": f"{modules}:{Path(__file__).parents[2]}"}
    parent = subprocess.Popen(
        [sys.executable, "-c", PARENT, str(modules)],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
    )
    pid = int(known(parent.stdout).readline())
    wait_for_word(modules / "log", "awake")
    parent.send_signal(signal.SIGKILL)
    parent.wait()
    known(parent.stdout).close()
    assert gone(pid)


@pytest.mark.parametrize("child", ["loud"], indirect=True)
def test_a_log_that_floods_fills_no_disk_and_its_writer_lives(child: Child) -> None:
    most, seen = 20_000, []
    child.start(0.0)
    for _ in range(6):
        end_s = time.monotonic() + 10.0
        while child.log.stat().st_size <= most and time.monotonic() < end_s:
            time.sleep(0.01)
        child.bound_log(most)
        seen.append(child.log.stat().st_size)
    files = sorted(path.name for path in child.log.parent.glob("log*"))
    assert files == ["log", "log.1", "log.2"]
    assert max(seen) < most
    assert all(child.log.with_name(name).stat().st_size <= most for name in files[1:])
    assert known(child.process).poll() is None
    wait_for_word(child.log, "loud")  # it was cut just now
    assert child.last_words(1).startswith("loud")
    assert b"\0" not in child.log.read_bytes(), "it writes at the end, not where it was"


def test_a_short_log_is_left_alone(tmp_path: Path) -> None:
    child = Child("quiet", ["quiet"], tmp_path / "log")
    child.bound_log()
    child.log.write_text("a line\n")
    child.bound_log()
    assert [path.name for path in tmp_path.iterdir()] == ["log"]


@pytest.mark.parametrize("child", ["showing"], indirect=True)
@pytest.mark.parametrize("knows", [True, False])
def test_only_the_planner_inherits_the_tokens(
    child: Child, knows: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in TOKENS:
        monkeypatch.setenv(name, "a good and long token")
    child.knows_tokens = knows
    child.start(0.0)
    known(child.process).wait()
    assert child.last_words() == str(sorted(TOKENS) if knows else [])
