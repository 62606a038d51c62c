"""The loop does one tick's things in order, and whatever ends it, the drive is halted."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import cast

import pytest

from bridge import node as shell_file
from bridge.core import BridgeState, CoreConfig, Decision, Inbox, LoopFacts
from bridge.core.state_motion import Learnt
from bridge.core.state_orders import Marks
from bridge.node import EXIT_BROKEN, EXIT_LEFT, BridgeNode, Parts
from bridge.realtime import Pacer, PacerTick
from tests.bridge.ground import FakeClock, core_config
from tests.wire.examples import EXAMPLES
from wire import DecodeFailure, DriveCommand, DriveState, Imu

CONFIG = core_config()


class Diary:
    """Be every hand of the shell at once, and write down who was asked what in which order."""

    kind, virtual, braking = "sim", True, "brake"

    def __init__(self) -> None:
        self.words: list[str] = []
        self.inboxes: list[Inbox] = []
        self.commands: list[DriveCommand | None] = []
        self.slack_s: list[float] = []
        self.gaps = 3
        self.trouble = ""
        self.imu = cast("Imu", EXAMPLES[Imu])

    def read(self) -> tuple[DriveState | DecodeFailure, ...]:
        self.words.append("read")
        return ()

    def take_imu(self) -> Imu | None:
        return self.imu

    def write(self, command: DriveCommand | None) -> None:
        self.words.append("write")
        self.commands.append(command)

    def halt(self) -> None:
        self.words.append("halt")

    def drain(
        self,
        drive: tuple[DriveState | DecodeFailure, ...],
        loop: LoopFacts,
        *,
        imu: Imu | None,
        fence_done: None,
        marks_done: None,
        real_time: bool,
        is_repeat: Callable[[str, str], bool],
        recorder_says: str,
        chance: str,
    ) -> Inbox:
        self.words.append("drain")
        self.inboxes.append(
            Inbox(
                loop=loop,
                real_time=real_time,
                recorder_ok=not recorder_says,
                recorder_says=recorder_says,
                chance=chance,
            )
        )
        assert drive == ()
        assert imu is self.imu, "the drive's own gyro is passed on"
        return self.inboxes[-1]

    def publish(self, decision: Decision) -> None:
        self.words.append("publish")

    def tick(self, state: BridgeState, inbox: Inbox, now_s: float, decision: Decision) -> None:
        self.words.append("record")
        assert inbox is self.inboxes[-1]
        assert decision.command is self.commands[-1]
        assert state is not decision.state

    def note(self, learnt: Learnt) -> None:
        assert learnt == CONFIG.learnt

    def use(self, slack_s: float) -> None:
        self.words.append("collect")
        self.slack_s.append(slack_s)

    def feed(self, now_s: float) -> None:
        self.words.append("feed")


class Desk:
    """Have no fence to put in force."""

    def note(self, asked: None, now_s: float) -> None:
        assert asked is None

    def take(self) -> None:
        return None


class NoMarks:
    """Stand for the desk of marks where nobody draws any."""

    def note(self, marks: Marks) -> None:
        assert marks.asked is None

    def take(self) -> None:
        return None


@pytest.fixture
def diary() -> Diary:
    return Diary()


@pytest.fixture
def shell(diary: Diary) -> BridgeNode:
    parts = Parts(diary, diary, diary, diary, diary, diary, Desk(), NoMarks())  # type: ignore[arg-type]  # a Diary is most of them
    return BridgeNode(CONFIG, parts, 100.0, real_time=True)


def countdown(turns: int) -> Iterator[bool]:
    yield from [False] * turns
    while True:
        yield True


def test_one_tick_is_drain_step_drive_tell_record(shell: BridgeNode, diary: Diary) -> None:
    before = shell.state
    shell.tick(PacerTick(100.01, 0.0, 0), CONFIG.period_s)
    assert diary.words == ["read", "drain", "write", "publish", "record", "feed"]
    assert shell.state is not before


def test_the_core_is_told_how_the_loop_goes(shell: BridgeNode, diary: Diary) -> None:
    shell.tick(PacerTick(100.034, 0.004, 2), CONFIG.period_s)
    (inbox,) = diary.inboxes
    assert inbox.loop == LoopFacts(late_s=0.004, missed_ticks=2, record_gaps=3)
    assert inbox.real_time
    assert (inbox.recorder_ok, inbox.recorder_says) == (True, "")
    diary.trouble = "disk_full: no space left"
    shell.tick(PacerTick(100.044, 0.0, 0), CONFIG.period_s)
    inbox = diary.inboxes[-1]
    assert (inbox.recorder_ok, inbox.recorder_says) == (False, "disk_full: no space left")


def test_each_tick_is_given_chance_of_its_own_that_nobody_can_foretell(
    shell: BridgeNode, diary: Diary
) -> None:
    for number in range(100):
        shell.tick(PacerTick(100.0 + number * 0.01, 0.0, 0), CONFIG.period_s)
    drawn = [inbox.chance for inbox in diary.inboxes]
    assert len(set(drawn)) == 100
    assert all(re.fullmatch(r"[0-9a-f]{16}", one) for one in drawn)
    bits = sum(int(one, 16).bit_count() for one in drawn)
    assert 2_800 < bits < 3_600, "10 sigma of 6 400 fair coins"


def test_lateness_of_a_second_counts_skipped_periods(shell: BridgeNode, diary: Diary) -> None:
    for number in range(101):
        shell.tick(
            PacerTick(100.0 + number * 0.01, 0.001, 1 if number == 50 else 0), CONFIG.period_s
        )
    facts = diary.inboxes[-1].loop
    assert facts.late_p50_us == pytest.approx(1_000.0)
    assert facts.late_max_us == pytest.approx(11_000.0)
    assert facts.step_max_us > 0.0


def test_the_loop_turns_until_told_and_then_halts(shell: BridgeNode, diary: Diary) -> None:
    turns = countdown(5)
    status = shell.run(Pacer(FakeClock(), CONFIG.period_s), lambda: next(turns))
    assert status == EXIT_LEFT
    assert len(diary.commands) == 5
    assert diary.words[-1] == "halt"
    assert diary.words.count("halt") == 1
    assert diary.slack_s == pytest.approx([0.01] * 5)


def test_a_step_that_raises_halts_the_drive_and_says_so(
    shell: BridgeNode,
    diary: Diary,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    def broken(config: CoreConfig, state: BridgeState, inbox: Inbox, now_s: float) -> Decision:
        raise ZeroDivisionError("as if")

    monkeypatch.setattr(shell_file, "step", broken)
    turns = countdown(5)
    assert shell.run(Pacer(FakeClock(), CONFIG.period_s), lambda: next(turns)) == EXIT_BROKEN
    assert diary.words == ["read", "drain", "halt"]
    assert "bridge_broken" in caplog.text
    assert "as if" in caplog.text


def test_a_drive_that_raises_is_halted_too(
    shell: BridgeNode, diary: Diary, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: DriveCommand | None) -> None:
        raise OSError("the cable is out")

    monkeypatch.setattr(diary, "write", broken)
    turns = countdown(5)
    assert shell.run(Pacer(FakeClock(), CONFIG.period_s), lambda: next(turns)) == EXIT_BROKEN
    assert diary.words[-1] == "halt"


def test_nothing_of_the_loop_depends_on_the_mode(repository: Path) -> None:
    text = (repository / "bridge" / "node.py").read_text()
    for word in ("Mode", ".mode", "Action", "speed", "epoch", "armed"):
        assert word not in text
