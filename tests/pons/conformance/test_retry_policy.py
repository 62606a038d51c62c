"""What fails while the machine keeps no time is played again after calm; its last try stands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import TYPE_CHECKING, cast

import pytest

from pons.conformance import runner
from pons.conformance.catalogue import FAULTS
from pons.conformance.record import DriveRecord
from pons.conformance.retry_policy import EXTRA_S, WAIT_S, Fairness
from pons.conformance.runner import AGAIN, COLUMNS, TRIES, Runner
from pons.conformance.scheduler_probe import HostTiming
from pons.conformance.verdict import MatrixCell
from tests.pons.conformance.made_up import BOUNDS, record

if TYPE_CHECKING:
    from pons.conformance.adapter import Adapter

CALM, LATE = HostTiming(400, 0, 0.004), HostTiming(90, 40, 0.3)
GOOD = dict.fromkeys(COLUMNS, MatrixCell(True, "1"))
BAD = GOOD | {"stands": MatrixCell(False, "still moves after 90 ticks")}
TOUCHED = GOOD | {"contacts": MatrixCell(False, "1")}
UNSEEN = GOOD | {"contacts": MatrixCell(False, "no truth was heard", measured=False)}
NOT_BEGUN = GOOD | {"stands": MatrixCell(False, "driving fast: not within 5 s")}
LOST = GOOD | {AGAIN: MatrixCell(False, "not within 9 s")}
PLAY_S, LOOK_S = 15.0, 2.0


@dataclass
class Machine:
    """Be a clock and what naps say: at each play, and when they are looked at."""

    plays: list[HostTiming]
    looks: HostTiming = CALM
    now_s: float = 0.0
    said: list[str] = field(default_factory=list)

    def timing_since(self, from_s: float) -> HostTiming:
        return self.plays.pop(0)

    def look(self) -> HostTiming:
        self.now_s += LOOK_S
        return self.looks

    def fair(self) -> Fairness:
        return Fairness(self, self.said.append, lambda: self.now_s)


def adapter(seen: DriveRecord | None = None) -> Adapter:
    return cast("Adapter", SimpleNamespace(record=seen or DriveRecord(), bounds=BOUNDS))


@pytest.mark.parametrize(
    ("cells", "machine", "excused"),
    [
        (BAD, CALM, False),
        (BAD, LATE, True),
        (LOST, LATE, True),
        (UNSEEN, LATE, True),
        (TOUCHED, LATE, False),
        (BAD | {"speed": MatrixCell(False, "3.00 m/s")}, LATE, False),
    ],
    ids=["kept time", "late", "lost", "nothing seen", "a contact", "a speed"],
)
def test_a_late_machine_excuses_all_but_facts(
    cells: dict[str, MatrixCell], machine: HostTiming, excused: bool
) -> None:
    failed = Machine([machine]).fair().judge(adapter(), cells, 0.0)
    assert failed is not None
    assert (failed.excused, failed.kept_time) == (excused, machine is CALM)
    assert str(machine) in str(failed)


def test_what_passed_is_no_failed_try() -> None:
    assert Machine([LATE]).fair().judge(adapter(), GOOD, 0.0) is None


def test_a_simulator_that_was_held_up_excuses_as_well() -> None:
    seen = record(2.0, lambda _s: 0.3)
    seen.wheels = [replace(one, made_s=one.made_s + (one.at_s > 1.0)) for one in seen.wheels]
    machine = Machine([CALM], now_s=2.0)
    failed = machine.fair().judge(adapter(seen), BAD, 0.0)
    assert failed is not None
    assert failed.excused
    assert "the simulator was held up" in failed.machine


def test_waiting_ends_and_so_does_what_is_excused() -> None:
    machine = Machine([LATE] * 9, looks=LATE)
    fair = machine.fair()
    excused = 0
    while (failed := fair.judge(adapter(), BAD, machine.now_s - PLAY_S)) and failed.excused:
        excused += 1
        began_s = machine.now_s
        fair.wait("velocity nan", failed)
        assert machine.now_s - began_s <= WAIT_S + LOOK_S
        machine.now_s += PLAY_S
    assert 2 <= excused <= 3
    assert failed is not None
    assert not failed.kept_time, "no more is excused, and yet the truth is told"
    assert machine.now_s <= EXTRA_S + LOOK_S + 2 * PLAY_S
    assert "did not keep time: 40 of 90 naps over 20 ms late" in machine.said[0]
    assert "no calm after 60 s" in machine.said[1]


@pytest.mark.parametrize(
    ("plays", "machine", "passes", "waits"),
    [
        ([(BAD, True)], [CALM], False, 0),
        ([(BAD, True), (GOOD, True)], [LATE], True, 1),
        ([(LOST, True), (LOST, False), (GOOD, True)], [LATE, LATE], True, 2),
        ([(BAD, True), (BAD, True)], [LATE, CALM], False, 1),
        ([(BAD, True), (TOUCHED, True)], [LATE, LATE], False, 1),
        ([(BAD, True)] * TRIES, [LATE] * TRIES, False, TRIES - 1),
        ([(NOT_BEGUN, False), (GOOD, True)], [CALM], True, 0),
        ([(NOT_BEGUN, False)] * TRIES, [CALM] * TRIES, False, 0),
        ([(LOST, False)], [CALM], False, 0),
    ],
    ids=["its own fault", "then passes", "lost, then passes", "then its own fault",
         "then a contact", "late for ever", "not begun at first", "never begun", "lost"],
)  # fmt: skip
def test_the_last_try_stands(
    plays: list[tuple[dict[str, MatrixCell], bool]],
    machine: list[HostTiming],
    passes: bool,
    waits: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = Machine(list(machine))
    clock = SimpleNamespace(monotonic=lambda: world.now_s)
    monkeypatch.setattr(runner, "time", clock)
    left = list(plays)
    began: list[tuple[float, float]] = []
    ended_s = [0.0]

    def play(
        _fault: object, from_s: float, facts_s: float, *, drives: bool
    ) -> tuple[dict[str, MatrixCell], bool]:
        began.append((world.now_s, from_s))
        assert facts_s in (from_s, ended_s[-1]), "a contact while one waits belongs to a row"
        assert from_s < world.now_s or facts_s == ended_s[-1]
        world.now_s += PLAY_S
        ended_s.append(world.now_s)
        return left.pop(0)

    playing = played_by(world, play)
    cells, tried = playing._play_fairly(FAULTS[0], drives=True)
    assert not left, "each try was needed"
    assert cells is plays[-1][0]
    assert len(tried) == len(plays) - passes
    assert all(cell.ok for cell in cells.values()) is passes
    assert sum("waiting" in line for line in world.said) == waits
    judged_from_s = [at_s - from_s for at_s, from_s in began]
    assert waits == 0 or judged_from_s[-1] == 0.0, "a try that was excused is judged no more"


def played_by(world: Machine, play: Callable[..., tuple[dict[str, MatrixCell], bool]]) -> Runner:
    playing = Runner.__new__(Runner)
    parts = {
        "_adapter": adapter(), "_fair": world.fair(), "_name": "velocity", "_play": play,
        "drive_well": lambda: MatrixCell(True, "0.5 s"),
    }  # fmt: skip
    for name, part in parts.items():
        setattr(playing, name, part)
    return playing
