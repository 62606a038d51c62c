"""Priorities count among processes and among sessions, or the log says that they do not."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from processes import priority
from processes.priority import (
    MAX_NICE,
    MIN_NICE,
    PAUSE_S,
    TRIES,
    add_nice,
    add_session_nice,
    session_nice,
    set_fifo,
)
from tests.processes.nice_values import leads_its_session, stand_of

ME = 4711


class Kernel:
    """Answer as Linux does, and remember what was asked."""

    def __init__(self, leader: int = ME, *, leaves: bool = True) -> None:
        self.leader, self.leaves = leader, leaves
        self.asked: list[str] = []
        self.session: int | None = 0
        self.begins_at: int | None = 0
        """How it weighs a new session; None if it weighs none."""
        self.alone = 0
        """The process's own nice."""
        self.again = 0
        """How often it says EAGAIN."""

    def getpid(self) -> int:
        return ME

    def getsid(self, _pid: int) -> int:
        return self.leader

    def setsid(self) -> None:
        if not self.leaves:
            raise PermissionError(errno.EPERM, "Operation not permitted")
        self.leader, self.session = ME, self.begins_at

    def getpriority(self, _which: int, _pid: int) -> int:
        return self.alone

    def nice(self, steps: int) -> int:
        self.asked.append(f"nice {steps:+d}")
        return steps

    def put(self, said: bytes) -> None:
        self.asked.append(f"session {int(said)}")
        if self.again:
            self.again -= 1
            raise BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable")
        self.session = int(said)

    def sleep(self, pause_s: float) -> None:
        assert pause_s == PAUSE_S
        self.asked.append("sleep")


@pytest.fixture
def kernel(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Kernel:
    made = Kernel(**getattr(request, "param", {}))
    for name in ("getpid", "getsid", "setsid", "getpriority", "nice"):
        monkeypatch.setattr(os, name, getattr(made, name))
    monkeypatch.setattr(priority, "time", SimpleNamespace(sleep=made.sleep))
    monkeypatch.setattr(priority, "_write_autogroup", made.put)
    monkeypatch.setattr(priority, "session_nice", lambda: made.session)
    return made


@pytest.mark.parametrize("kernel", [{}, {"leader": 1}], indirect=True)
def test_who_leads_a_session_or_leaves_one_weighs_his_own(
    kernel: Kernel, caplog: pytest.LogCaptureFixture
) -> None:
    add_nice(5, own_session=kernel.leader != ME)
    assert kernel.asked == ["nice +5", "session 5"]
    assert caplog.text == ""


@pytest.mark.parametrize("kernel", [{"leader": 1}], indirect=True)
def test_who_leaves_stands_behind_the_session_that_started_it(kernel: Kernel) -> None:
    kernel.session = -10
    add_nice(10, own_session=True)
    assert kernel.asked == ["nice +10"], "a new session has that weight already"
    kernel.leader, kernel.session = 1, -7
    add_nice(10, own_session=True)
    assert kernel.asked[2:] == ["session 3"]


@pytest.mark.parametrize(("steps", "held"), [(30, MAX_NICE), (-30, MIN_NICE)])
def test_no_session_is_weighed_beyond_what_there_is(kernel: Kernel, steps: int, held: int) -> None:
    add_nice(steps)
    assert kernel.session == held


@pytest.mark.parametrize("kernel", [{"leader": 1, "leaves": False}], indirect=True)
@pytest.mark.parametrize("apart", [False, True])
def test_the_session_of_another_keeps_its_weight(
    kernel: Kernel, apart: bool, caplog: pytest.LogCaptureFixture
) -> None:
    add_nice(5, own_session=apart)
    assert kernel.asked == ["nice +5"]
    assert "nice +5 does not count in full: another process leads this session" in caplog.text


def test_who_chose_his_nice_moves_his_session_alone(
    kernel: Kernel, caplog: pytest.LogCaptureFixture
) -> None:
    add_session_nice(5)
    assert kernel.asked == ["session 5"]
    kernel.leader = 1
    add_session_nice(5)
    assert kernel.session == 5
    assert "nice +5 does not count among sessions: another process leads" in caplog.text


def test_a_kernel_that_weighs_no_sessions_is_asked_for_none(
    kernel: Kernel, caplog: pytest.LogCaptureFixture
) -> None:
    kernel.session, kernel.begins_at, kernel.leader = None, None, 1
    add_nice(5)
    add_nice(5, own_session=True)
    assert kernel.asked == ["nice +5"] * 2
    assert caplog.text == ""


def test_what_was_given_no_session_yet_stands_behind_its_own_nice(kernel: Kernel) -> None:
    """As what a container's first process starts: its session is the kernel's, and says nothing."""
    kernel.session, kernel.leader, kernel.alone = None, 1, -3
    add_nice(5, own_session=True)
    assert kernel.asked == ["nice +5", "session 2"]


@pytest.mark.parametrize(("text", "expected"), [("/autogroup-25 nice -10\n", -10), ("", None)])
def test_the_weight_of_a_session_is_read(
    text: str, expected: int | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(priority, "AUTOGROUP", tmp_path / "autogroup")
    assert session_nice() is None
    (tmp_path / "autogroup").write_text(text)
    assert session_nice() == expected


def test_a_session_weighed_a_moment_ago_is_weighed_again_soon(
    kernel: Kernel, caplog: pytest.LogCaptureFixture
) -> None:
    kernel.again = TRIES - 1
    add_nice(5)
    assert kernel.asked.count("sleep") == TRIES - 1
    assert (kernel.session, caplog.text) == (5, "")
    kernel.again = TRIES
    add_nice(5)
    assert kernel.session == 5
    assert "Resource temporarily unavailable" in caplog.text


def test_what_is_refused_is_said_and_no_more(
    kernel: Kernel, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "nice", refuse)
    add_nice(-10)
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    set_fifo(30)
    monkeypatch.setattr(sys, "platform", "plan9")
    set_fifo(30)
    assert [record.getMessage() for record in caplog.records] == [
        "nice -10 does not count in full: Operation not permitted",
        "SCHED_FIFO 30 refused: Operation not permitted",
        "SCHED_FIFO 30 refused: not on plan9",
    ]
    assert kernel.asked == []


TAKE = """
import sys
from processes.priority import add_nice
add_nice(int(sys.argv[1]), own_session=len(sys.argv) > 2)
print("taken", flush=True)
sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize("apart", [False, True])
def test_a_real_child_stands_behind_in_both(repository: Path, apart: bool) -> None:
    """To stand behind takes no right, so here nothing may be refused."""
    command = [sys.executable, "-c", TAKE, "5", *(["apart"] if apart else [])]
    ours = stand_of(os.getpid())
    with subprocess.Popen(
        command,
        cwd=repository,
        start_new_session=not apart,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "taken\n"
        its = stand_of(child.pid)
        assert leads_its_session(child.pid)
        assert child.communicate()[1] == ""
    assert its == (ours if apart else ours.leaving()).behind(5)
