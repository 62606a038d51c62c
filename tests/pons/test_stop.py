"""A stop from a shell needs no lock, no disk, no right robot.toml and no planner.

Each test runs ``pons`` as its own process, as a person would, beside a bridge of robot r7.
"""

from __future__ import annotations

import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, suppress
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons.stop import CONFIRMED, SAID_BY_PLANNER, SENT
from tests.known import known
from tests.pons.lying_planner import lying_planner
from tests.pons.standing_bridge import StandingBridge
from wire.doors import BRIDGE_DOOR
from wire.sockets import Endpoints

pytestmark = pytest.mark.nightly(keep=12)


ROOT = Path(__file__).resolve().parents[2]
STRANGER, IMPOSTOR = 61_001, 61_002
STANDS_STILL = ("stop", "estop", "disarm")
MOVES_AGAIN = ("arm", "reset")


def pons(
    home: Path,
    *words: str,
    robot: Path | None = None,
    port: int = 1,
    user: int | None = None,
    limited: Callable[[], None] | None = None,
) -> subprocess.CompletedProcess[str]:
    environment = {
        **os.environ,
        "PONS_HOME": str(home),
        "PONS_PORT": str(port),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    environment.pop("PONS_ROBOT", None)
    if robot is not None:
        environment["PONS_ROBOT"] = str(robot)
    other = [] if user is None else ["tests.as_user", str(user), str(user)]
    me = "pons" if user is None else "pons.__main__"
    return subprocess.run(
        [sys.executable, "-m", *other, me, *words],
        cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=30,
        preexec_fn=limited,
    )  # fmt: skip


@pytest.fixture
def home() -> Iterator[Path]:
    """Give a folder that any user may enter: pytest's own are for one user."""
    with TemporaryDirectory(prefix="ps-") as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


@pytest.fixture
def bridge(home: Path) -> Iterator[StandingBridge]:
    with StandingBridge(home, "r7") as made:
        yield made


def assert_taken(done: subprocess.CompletedProcess[str], word: str) -> None:
    assert "Traceback" not in done.stderr
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == (CONFIRMED[0] if word == "stop" else f"{word}: accepted")


@pytest.mark.parametrize("word", STANDS_STILL)
@pytest.mark.parametrize("text", [None, 'id = "r1"\n', "id = \n", "\x00"])
def test_whatever_robot_toml_says_the_robot_that_is_there_stands_still(
    home: Path, bridge: StandingBridge, tmp_path: Path, text: str | None, word: str
) -> None:
    robot = tmp_path / "robot.toml"
    if text is not None:
        robot.write_text(text)
    assert_taken(pons(home, word, robot=robot), word)
    assert bridge.asked == ["cmd/stop" if word == "stop" else f"op/{word}"]


@pytest.mark.parametrize("word", MOVES_AGAIN)
def test_what_lets_a_robot_move_again_needs_the_right_robot_toml(
    home: Path, bridge: StandingBridge, tmp_path: Path, word: str
) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text('id = "r1"\n')
    done = pons(home, word, robot=robot)
    assert done.returncode == 6
    assert done.stderr.startswith("other_robot: ")
    assert "describes r1, but r7 answers" in done.stderr
    assert pons(home, word, robot=tmp_path / "none.toml").stderr.startswith("robot_toml_missing")
    assert bridge.asked == []
    robot.write_text('id = "r7"\n')
    assert_taken(pons(home, word, robot=robot), word)


@pytest.mark.parametrize("word", STANDS_STILL)
def test_the_robot_stands_still_with_no_byte_left_to_write(
    home: Path, bridge: StandingBridge, word: str
) -> None:
    def full() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

    assert_taken(pons(home, word, limited=full), word)
    assert bridge.asked


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may mount a disk and fill it")
def test_the_robot_stands_still_on_a_full_disk(tmp_path: Path) -> None:
    home = tmp_path / "h"
    home.mkdir()
    mounted = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(home)]
    if shutil.which("mount") is None or subprocess.run(mounted, check=False).returncode:
        pytest.skip("this machine lets nobody mount a tmpfs")
    with ExitStack() as stack:
        stack.callback(subprocess.run, ["umount", "-l", str(home)], check=True)
        stack.enter_context(StandingBridge(home, "r7"))
        fill(home / "filler")
        for word in STANDS_STILL:
            assert_taken(pons(home, word), word)


def fill(path: Path) -> None:
    with path.open("wb", buffering=0) as file, suppress(OSError):
        while True:
            file.write(bytes(4096))


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
@pytest.mark.parametrize("word", STANDS_STILL)
def test_the_robot_stands_still_for_who_may_write_nothing_in_its_home(
    home: Path, bridge: StandingBridge, word: str
) -> None:
    """Of what users before have left there, nothing is in the way of the next."""
    left = home / "run" / "operator.lock"
    left.write_text("1")
    left.chmod(0o644)
    opened_to_others(home / "run")
    before = contents(home)

    assert_taken(pons(home, word, user=STRANGER), word)
    assert contents(home) == before


def opened_to_others(run: Path) -> None:
    """Let the stranger reach the sockets, as a group does on a robot, and write no folder."""
    for path in (run, *run.rglob("*")):
        path.chmod(0o755 if path.is_dir() else 0o777 if path.is_socket() else 0o644)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_who_took_the_bridges_place_is_told_to_stop_but_not_believed(home: Path) -> None:
    """Its socket lies in a folder of another's; what it answers confirms nothing."""
    impostor = [sys.executable, "-m", "tests.as_user", str(IMPOSTOR), str(IMPOSTOR)]
    folders = [home / "run" / name for name in ("bridge", "senses")]
    for folder in folders:
        folder.mkdir(parents=True)
        folder.chmod(0o755)
        os.chown(folder, IMPOSTOR, IMPOSTOR)
    (home / "run").chmod(0o755)
    command = [*impostor, "tests.pons.standing_bridge", str(home), "r7"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as other:
        try:
            assert known(other.stdout).readline() == "speaks\n"
            os.chown(folders[0], STRANGER, STRANGER)
            Endpoints(home).socket(BRIDGE_DOOR).chmod(0o777)
            robot = home / "robot.toml"
            robot.write_text('id = "r7"\n')
            told = [pons(home, word, robot=robot) for word in (*STANDS_STILL, *MOVES_AGAIN)]
        finally:
            other.terminate()
        heard, _ = other.communicate(timeout=10)
    for done in told:
        assert done.returncode == 6
        assert f"wrong_listener: user {IMPOSTOR} listens at " in done.stderr
        assert CONFIRMED[0] not in done.stdout
        assert "accepted" not in done.stdout
    assert heard.split() == ["cmd/stop", "op/estop", "op/disarm"], "no proof was given to it"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_who_may_not_reach_the_bridge_is_told_why(home: Path, bridge: StandingBridge) -> None:
    done = pons(home, "estop", user=STRANGER)
    assert done.returncode == 6
    assert done.stderr.startswith("no_bridge: ")
    assert f"{home}/run/bridge/bridge.sock: Permission denied" in done.stderr
    assert bridge.asked == []


def contents(folder: Path) -> dict[Path, float]:
    return {path: path.stat().st_mtime for path in folder.rglob("*")}


def test_a_bad_port_is_no_reason_not_to_stop(home: Path, bridge: StandingBridge) -> None:
    environment = {**os.environ, "PONS_HOME": str(home), "PONS_PORT": "none"}
    done = subprocess.run(
        [sys.executable, "-m", "pons", "stop"],
        cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=30,
    )  # fmt: skip
    assert_taken(done, "stop")
    assert bridge.asked == ["cmd/stop"]


HUNG = """
import socket, sys, time
listener = socket.create_server(("127.0.0.1", 0))
print(listener.getsockname()[1], flush=True)
time.sleep(60)
"""


def test_a_hung_planner_does_not_keep_the_stop(home: Path, bridge: StandingBridge) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", HUNG], stdout=subprocess.PIPE, text=True
    ) as planner:
        port = int(known(planner.stdout).readline())
        planner.send_signal(signal.SIGSTOP)
        try:
            assert_taken(pons(home, "stop", port=port), "stop")
        finally:
            planner.kill()
    assert bridge.asked == ["cmd/stop"]


def test_whatever_breaks_the_second_way_the_first_is_waited_for(tmp_path: Path) -> None:
    """A home whose sockets can't have an address breaks it before anything is sent."""
    with closing(socket.create_server(("127.0.0.1", 0))) as planner:
        port = int(planner.getsockname()[1])
        command = [sys.executable, "-m", "pons", "stop"]
        long_home = tmp_path / ("x" * 120)
        environment = {**os.environ, "PONS_HOME": str(long_home), "PONS_PORT": str(port)}
        with subprocess.Popen(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as stop:  # fmt: skip
            accepted, _ = planner.accept()
            with closing(accepted):
                accepted.recv(65_536)
                with pytest.raises(subprocess.TimeoutExpired):
                    stop.wait(1.0)  # the second way has failed by now; the first is still asked
                body = b'{"confirmed": true}'
                accepted.sendall(
                    b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n"
                    b"Content-Length: %d\r\n\r\n%s" % (len(body), body)
                )
            out, err = stop.communicate(timeout=20)
    assert (stop.returncode, err) == (0, "")
    assert out.strip() == said_by_planner(f"{bridge_socket(long_home)}: AF_UNIX path too long")


@pytest.fixture
def liar() -> Iterator[int]:
    """Give the port of a planner that says of each stop that the bridge confirmed it."""
    with lying_planner() as port:
        yield port


def bridge_socket(home: Path) -> Path:
    return Endpoints(home).socket(BRIDGE_DOOR)


def said_by_planner(why: str) -> str:
    return SAID_BY_PLANNER[0].format(word="stop", why=why)


@pytest.mark.parametrize("lives", [True, False], ids=["a bridge that hangs", "a dead bridge"])
def test_a_planner_that_says_confirmed_is_not_believed_where_the_bridge_is_silent(
    home: Path, liar: int, lives: bool
) -> None:
    path = bridge_socket(home)
    path.parent.mkdir(parents=True)
    with closing(socket.socket(socket.AF_UNIX)) as bridge:
        bridge.bind(str(path))
        if lives:
            bridge.listen()
        done = pons(home, "stop", port=liar)
    assert (done.returncode, done.stdout) == (6, "")
    sent, _, told = done.stderr.partition("\n")
    assert sent == SENT[0].format(word="stop")
    assert told.startswith("no_bridge: the bridge itself did not confirm the stop")
    assert "Planner: it says that the bridge confirmed, and is not believed. " in told


def test_the_bridge_is_asked_even_where_the_planner_has_confirmed(
    home: Path, bridge: StandingBridge, liar: int
) -> None:
    assert_taken(pons(home, "stop", port=liar), "stop")
    assert bridge.asked == ["cmd/stop"], "by the shell itself: this planner asks nobody"


def test_where_no_bridge_is_in_reach_the_planners_word_is_called_so(home: Path, liar: int) -> None:
    """As on a laptop that stops a robot elsewhere."""
    done = pons(home, "stop", port=liar)
    why = f"{bridge_socket(home)}: No such file or directory"
    assert (done.returncode, done.stdout.strip()) == (0, said_by_planner(why))
    assert "confirmed" not in done.stdout


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may become another user")
def test_who_may_not_ask_the_bridge_is_told_the_planners_word(
    home: Path, bridge: StandingBridge, liar: int
) -> None:
    done = pons(home, "stop", port=liar, user=STRANGER)
    why = f"{bridge_socket(home)}: Permission denied"
    assert (done.returncode, done.stdout.strip()) == (0, said_by_planner(why))
    assert bridge.asked == []


def test_where_both_ways_fail_each_is_told_in_one_line(tmp_path: Path) -> None:
    done = pons(tmp_path / ("x" * 120), "stop")
    assert done.returncode == 6
    assert done.stderr.startswith("no_bridge: ")
    assert "Planner: http://127.0.0.1:1/v1/stop: " in done.stderr
    assert "Bridge: socket_path_too_long: " in done.stderr
    assert done.stderr.count("\n") == 1


LIGHT = (
    "import sys, pons.stop; print([m for m in ('numpy', 'pydantic', 'zenoh') if m in sys.modules])"
)


def test_the_stop_that_the_planner_takes_loads_neither_numpy_nor_pydantic_nor_zenoh() -> None:
    done = subprocess.run(
        [sys.executable, "-c", LIGHT], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_what_breaks_at_the_interpreters_end_does_not_change_the_status(
    tmp_path: Path, home: Path, bridge: StandingBridge
) -> None:
    (tmp_path / "breaks_at_exit.py").write_text(
        "import atexit, os, runpy, sys\n"
        "atexit.register(os.abort)\n"
        "sys.argv = ['pons', 'stop']\n"
        "runpy.run_module('pons', run_name='__main__')\n",
        "utf-8",
    )
    done = subprocess.run(
        [sys.executable, str(tmp_path / "breaks_at_exit.py")],
        cwd=ROOT,
        env={**os.environ, "PONS_HOME": str(home), "PONS_PORT": "1", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
        timeout=30,
    )
    assert_taken(done, "stop")
