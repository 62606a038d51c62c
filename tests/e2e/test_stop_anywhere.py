"""A person makes the robot stand from wherever they are, as any user, whatever else is said."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pons.running import NOTES
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ROOT
from wire import Mode
from wire.keys import OPS, STOP

pytestmark = [pytest.mark.e2e, pytest.mark.long, pytest.mark.nightly(keep=4)]

STRANGER = 61_001
FLOOD_S = 0.0002
"""Between two messages: 5 000 times a second and key."""
ENDS = {"stop": {Mode.STOPPING, Mode.HOLD}, "estop": {Mode.ESTOPPED},
        "disarm": {Mode.STOPPING, Mode.DISARMED}}  # fmt: skip


@pytest.fixture(scope="module")
def driven() -> Iterator[Robot]:
    """Start a robot on a port of its own, its note where all users may look."""
    with TemporaryDirectory(prefix="pons-e2e-") as home, TemporaryDirectory(prefix="pr-") as notes:
        Path(notes).chmod(0o1777)
        robot = Robot(Path(home), PONS_RUNNING=notes)
        robot.start()
        yield robot
        robot.close()


def told(robot: Robot, folder: str, word: str, user: int) -> subprocess.CompletedProcess[str]:
    """Type a word in a folder, with nothing that names a robot."""
    environment = {name: text for name, text in os.environ.items() if not name.startswith("PONS_")}
    environment |= {NOTES: robot.system.environment[NOTES], "PYTHONPATH": str(ROOT)}
    other = ["tests.as_user", str(user), str(user)] if user != os.geteuid() else []
    return subprocess.run(
        [sys.executable, "-m", *other, "pons.__main__" if other else "pons", word],
        cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=30,
    )  # fmt: skip


@contextmanager
def flooded(robot: Robot, word: str) -> Iterator[None]:
    """Let somebody repeat a known id on the word's key, as fast as it goes, after a resume."""
    op = next((key for key in OPS if key.path == f"op/{word}"), None)
    session = robot.judge.session
    put_bytes = (session.publisher(op) if op is not None else session.publisher(STOP)).put_bytes
    over = threading.Event()

    def say() -> None:
        number = 0
        while not over.wait(FLOOD_S):
            number += 1
            put_bytes(b'{"id":"old%d","source":"flood"}' % (number % 6))

    flood = threading.Thread(target=say)
    flood.start()
    try:
        yield
    finally:
        over.set()
        flood.join()


@pytest.mark.parametrize("word", list(ENDS))
@pytest.mark.parametrize("place", ["other folder", "other user", "planner hung", "flood"])
def test_a_word_from_anywhere_makes_it_stand(driven: Robot, place: str, word: str) -> None:
    if place == "other user" and os.geteuid() != 0:
        pytest.skip("only root may become another user")
    driven.rest()
    driven.drive_off(driven.farthest())
    user = STRANGER if place == "other user" else os.geteuid()
    if place == "planner hung":
        driven.system.freeze("planner")
    if place == "flood":
        with flooded(driven, word):
            done = told(driven, "/", word, user)
    else:
        done = told(driven, "/", word, user)
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert done.stdout.startswith(f"r1 in {driven.system.home}, user {os.geteuid()}: ") or (
        "confirmed" in done.stdout or "accepted" in done.stdout
    )
    if place == "planner hung":
        driven.system.thaw("planner")
    until(
        lambda: driven.judge.standing() and driven.judge.status.mode in ENDS[word],
        5.0, "standing", driven.judge.describe,
    )  # fmt: skip
