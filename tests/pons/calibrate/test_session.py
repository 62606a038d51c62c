"""A hand waits for what passes by itself, or by a person, and for nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import pytest

from pons.calibrate.session import PASSES_S, PERIOD_S, QUIET_S, CalibrationRig
from tests.wire.examples import EXAMPLES, STATUS
from wire import Action, DriveState, Mode, Record, RowReport, Scan
from wire.keys import Key
from wire.session import Session

PATIENCE_S = 30.0


@dataclass
class Bridge:
    """Be what a rig hears: the mode from each moment on."""

    modes: Sequence[tuple[float, Mode]]
    now_s: float = 0.0
    rows: tuple[RowReport, ...] = ()

    def wait(self) -> None:
        self.now_s += PERIOD_S

    def publisher(self, _key: object) -> Bridge:
        return self

    def put(self, _message: object) -> None:
        """Hear nothing."""

    def subscriber(self, key: Key[Record]) -> _Ear:
        return _Ear(self, key.message)


@dataclass(frozen=True)
class _Ear:
    bridge: Bridge
    kind: type[Record]

    def newest(self) -> Any:
        mode = [mode for from_s, mode in self.bridge.modes if self.bridge.now_s >= from_s][-1]
        return STATUS.model_copy(update={"mode": mode, "rows": self.bridge.rows})

    def drain(self) -> Any:
        return _Drained((EXAMPLES[self.kind],) if self.kind in {DriveState, Scan} else ())


@dataclass(frozen=True)
class _Drained:
    items: tuple[Record, ...]


def rig(*modes: tuple[float, Mode], rows: tuple[RowReport, ...] = ()) -> CalibrationRig:
    bridge = Bridge(modes, rows=rows)
    session = cast("Session", bridge)
    return CalibrationRig(session, session, lambda: bridge.now_s, bridge.wait)


@pytest.mark.parametrize("left_behind", [Mode.TELEOP, Mode.STOPPING])
def test_what_another_calibration_left_behind_passes(left_behind: Mode) -> None:
    hand = rig((0.0, left_behind), (1.0, Mode.HOLD))
    assert hand.listen().mode is Mode.HOLD
    assert hand.now_s == pytest.approx(1.0, abs=0.2)


def test_a_stick_that_is_held_is_not_waited_for_for_ever() -> None:
    hand = rig((0.0, Mode.TELEOP))
    assert hand.listen().mode is Mode.TELEOP
    assert hand.now_s <= PASSES_S + 0.2


@pytest.mark.parametrize(
    ("then", "settles", "within_s"),
    [
        (((0.0, Mode.DISARMED), (9.0, Mode.HOLD)), True, 9.0),
        (((0.0, Mode.DISARMED),), False, PATIENCE_S),
        (((0.0, Mode.FAULT), (5.0, Mode.DISARMED), (7.0, Mode.HOLD)), True, 7.0),
        (((0.0, Mode.DISARMED), (2.0, Mode.ESTOPPED)), False, 2.0),
    ],
    ids=["armed again", "nobody came", "reset and armed", "pressed"],
)
def test_a_person_is_waited_for_unless_a_stop_is_pressed(
    then: tuple[tuple[float, Mode], ...], settles: bool, within_s: float
) -> None:
    hand = rig(*then)
    assert hand.settle(PATIENCE_S) is settles
    assert within_s - 0.1 <= hand.now_s <= within_s + QUIET_S


@pytest.mark.parametrize(("evidence", "waits_s"), [("no gyro", 0.1), ("0.40 rad/s apart", QUIET_S)])
def test_a_robot_without_a_gyro_is_not_waited_for(evidence: str, waits_s: float) -> None:
    row = RowReport(
        row="YAW_DISAGREE", action=Action.CAP, for_s=9.0, evidence=evidence, binding=True
    )
    hand = rig((0.0, Mode.HOLD), rows=(row,))
    assert hand.settle(PATIENCE_S)
    assert hand.now_s == pytest.approx(waits_s, abs=0.15)
