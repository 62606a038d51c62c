"""The real bridge process: it tests itself, arms, halts when told to end, and refuses clearly."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from bridge.__main__ import _config, main
from bridge.core import Inbox, initial, step
from bridge.recording.mcap_reader import McapReader
from bridge.replay import replay
from bridge.warmup import warm_up
from tests.bridge.fake_robot import FakeRobot
from tests.bridge.ground import ROOT, SITE
from tests.waiting import until
from wire import VIRTUAL_KEY, Mode, OpRequest, RobotDescription, Status, sign
from wire.keys import ARM, STATUS, Party
from wire.session import Subscriber, open_session

REFUSED = 2


def command(home: Path, *more: str) -> list[str]:
    words = [sys.executable, "-m", "bridge", "--home", str(home), "--site", str(SITE)]
    return [*words, *more]


@contextmanager
def bridge(home: Path, **settings: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        command(home),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **settings},
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def refusal(*words: str) -> str:
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False, timeout=30)
    assert done.returncode == REFUSED
    return done.stderr


class Watch:
    """Remember the newest status."""

    def __init__(self, ears: Subscriber[Status]) -> None:
        self._ears = ears
        self.status: Status | None = None

    def sees(self, mode: Mode) -> bool:
        self.status = self._ears.newest() or self.status
        return self.status is not None and self.status.mode is mode


@pytest.mark.slow
def test_a_life_from_self_test_to_halt(tmp_path: Path) -> None:
    with (
        FakeRobot(tmp_path) as robot,
        bridge(tmp_path) as process,
        open_session(Party.OPERATOR, "r1", tmp_path) as operator,
    ):
        watch = Watch(operator.subscriber(STATUS))
        until(lambda: watch.sees(Mode.SELFTEST))
        until(lambda: watch.sees(Mode.DISARMED)), watch.status and watch.status.waiting_for
        assert robot.last is not None
        assert not robot.last.enable

        assert "already_running" in refusal(*command(tmp_path))
        assert process.poll() is None

        arm(watch, operator.publisher(ARM).put)
        until(lambda: robot.last is not None and robot.last.enable)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=10) == 0
        until(lambda: robot.last is not None and not robot.last.enable)
        last = robot.last
        assert (last.left_radps, last.right_radps) == (0.0, 0.0)
    (recording,) = (tmp_path / "recordings").iterdir()
    report = replay([recording])
    assert (report.differing, report.gaps, report.first_difference) == (0, 0, None)
    assert report.ticks > 100


def arm(watch: Watch, send: Callable[[OpRequest], None]) -> None:
    """Ask with a proof until the mode is HOLD."""
    tries = iter(range(1_000_000))

    def held() -> bool:
        if watch.sees(Mode.HOLD):
            return True
        status = watch.status
        if status is not None and next(tries) % 20 == 0:
            request_id = f"arm-{status.seq}"
            proof = sign(VIRTUAL_KEY, "arm", "r1", status.nonce, request_id)
            send(OpRequest(id=request_id, source="test", proof=proof))
        return False

    until(held), watch.status


def whole(path: Path) -> bool:
    with McapReader(path) as box:
        return box.complete


def test_killed_it_leaves_a_recording_that_replays(tmp_path: Path) -> None:
    with FakeRobot(tmp_path) as robot, bridge(tmp_path) as process:
        until(lambda: len(robot.heard) > 60)
        process.kill()
        process.wait()
    folder = tmp_path / "recordings"

    def written() -> bool:
        """Hold that all is there but what was not handed over yet: at most 19 ticks."""
        closed = [path for path in folder.glob("*.mcap") if whole(path)]
        return bool(closed) and replay(closed).ticks > 40

    until(written)
    assert replay(folder.glob("*.mcap")).differing == 0


@pytest.fixture
def refused(capfd: pytest.CaptureFixture[str]) -> Iterator[Callable[[list[str]], str]]:
    """Start the bridge in this process, which is quick where it refuses; give its signals back."""
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGINT)}

    def run(words: list[str]) -> str:
        assert main(words[3:]) == REFUSED
        return capfd.readouterr().err

    yield run
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize(
    ("content", "code", "word"),
    [
        ("max_sped = 1\n", "robot_toml_invalid", "unknown key 'max_sped'"),
        ("[limits]\nmax_speed_mps = 99.0\n", "robot_toml_invalid", "limits.max_speed_mps"),
        ("[limits\n", "robot_toml_syntax", "robot.toml"),
    ],
)
def test_a_wrong_robot_refuses_to_start(
    tmp_path: Path, content: str, code: str, word: str, refused: Callable[[list[str]], str]
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(content)
    said = refused(command(tmp_path, "--robot", str(path)))
    assert code in said
    assert word in said


@pytest.mark.parametrize(
    ("content", "code"),
    [(None, "fence_missing"), ("{}", "fence_invalid"), ("[1e999", "fence_invalid")],
)
def test_a_wrong_fence_refuses_to_start(
    tmp_path: Path, content: str | None, code: str, refused: Callable[[list[str]], str]
) -> None:
    if content is not None:
        (tmp_path / "fence.json").write_text(content)
    words = command(tmp_path)
    words[words.index(str(SITE))] = str(tmp_path)
    assert code in refused(words)


@pytest.fixture
def other_site(tmp_path: Path) -> Path:
    """Return a site whose map is not the one that its fence was drawn on."""
    site = tmp_path / "site"
    site.mkdir()
    for name in ("map.yaml", "map.pgm", "fence.json"):
        (site / name).write_bytes((SITE / name).read_bytes())
    (site / "map.pgm").write_bytes((SITE / "map.pgm").read_bytes() + b" ")
    return site


def test_a_fence_of_another_map_is_never_armed(tmp_path: Path, other_site: Path) -> None:
    right, wrong = (_config(RobotDescription(), site, tmp_path) for site in (SITE, other_site))
    assert right.fence is not None
    assert wrong.fence is not None
    assert right.map_id == right.fence.map_id == wrong.fence.map_id != wrong.map_id
    warm_up(wrong, 0.0)  # before its self test says so it begins as any other
    state = initial(wrong, 0.0)
    for number in range(1, 3):
        state = step(wrong, state, Inbox(), number * 0.01).state
    assert (state.mode, state.fault) == (Mode.FAULT, "fence_of_another_map")


def test_a_site_without_its_map_refuses_to_start(
    tmp_path: Path, other_site: Path, refused: Callable[[list[str]], str]
) -> None:
    (other_site / "map.yaml").unlink()
    words = command(tmp_path)
    words[words.index(str(SITE))] = str(other_site)
    assert "map_missing" in refused(words)


def test_a_home_too_deep_for_a_socket_refuses_to_start(
    tmp_path: Path, refused: Callable[[list[str]], str]
) -> None:
    assert "socket_path_too_long" in refused(command(tmp_path / ("deep" * 25)))
