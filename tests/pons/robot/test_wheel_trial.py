"""A good base passes; each wrong wire is named before a wheel runs wild."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_words import REFUSALS
from pons.robot.wheel_trial import SPEED_RADPS, WheelFindings, WheelTrial
from sim.twin.twin import FIRMWARES
from tests.pons.robot.stand import Stand, Wires
from wire import RobotDescription
from wire.drive_config import DRIVE_KINDS

pytestmark = pytest.mark.nightly(keep=10)


MCU = RobotDescription.model_validate(
    {"drive": {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 1496, "timeout_s": 0.2}}
)


def robot_of(kind: str) -> RobotDescription:
    needed = {"port": "/dev/x", "ticks_per_turn": 1496}
    drive = {key: needed[key] for key in DRIVE_KINDS[kind].needed}
    return RobotDescription.model_validate({"drive": {"kind": kind, **drive}})


def tried(stand: Stand) -> WheelFindings:
    return WheelTrial(stand.drive, stand.robot, stand, stand, "trial").run()


def refused(wires: Wires, **more: Any) -> tuple[str, Stand]:
    stand = Stand(MCU, wires, **more)
    with pytest.raises(TrialRefusal) as refusal:
        tried(stand)
    assert refusal.value.code in REFUSALS
    assert refusal.value.detail
    for _ in range(100):
        stand.wait()
    return refusal.value.code, stand


@pytest.mark.parametrize("kind", sorted(SERIAL_PROTOCOLS))
def test_a_good_base_passes_and_its_dead_man_is_measured(kind: str) -> None:
    stand = Stand(robot_of(kind))
    found = tried(stand)
    timeout_s = stand.robot.drive.dead_man_s
    assert timeout_s <= found.dead_man_s <= timeout_s + 0.3
    assert found.brake_s < 0.2
    assert found.hand_ratio == pytest.approx({"left": 1.0, "right": 1.0}, abs=0.02)
    assert stand.asked == ["hand_left", "hand_right"]
    assert stand.wheels.fastest_radps < 2 * SPEED_RADPS


@pytest.mark.parametrize(
    ("wires", "code"),
    [
        (Wires(encoders_swapped=True), "hand_swapped"),
        (Wires(encoder_sign=(-1, 1)), "hand_backwards"),
        (Wires(encoder_sign=(1, -1)), "hand_backwards"),
        (Wires(encoder_dead=(True, False)), "hand_none"),
        (Wires(encoder_dead=(False, True)), "hand_none"),
        (Wires(ticks_times=0.5), "hand_ticks"),
        (Wires(ticks_times=2.0), "hand_ticks"),
        (Wires(motors_swapped=True), "power_swapped"),
        (Wires(motors_swapped=True, encoders_swapped=True), "hand_swapped"),
        (Wires(motor_sign=(-1, 1)), "power_backwards"),
        (Wires(motor_sign=(1, -1)), "power_backwards"),
        (Wires(motor_dead=(True, False)), "power_none"),
        (Wires(motor_dead=(False, True)), "power_none"),
        (Wires(rolls_radps=0.2), "trial_rolls"),
        (Wires(stop_pressed=True), "trial_stop_pressed"),
        (Wires(deaf=True), "dead_man_none"),
        (Wires(late_s=0.8), "dead_man_late"),
        (Wires(coast_s=1.0), "coasts"),
    ],
    ids=str,
)
def test_what_is_wrong_is_named_and_no_wheel_runs_wild(wires: Wires, code: str) -> None:
    said, stand = refused(wires)
    assert said == code
    assert stand.wheels.fastest_radps <= 8.0
    if not (wires.deaf or wires.rolls_radps or wires.coast_s > 0.5):
        assert max(map(abs, stand.wheels.radps)) < 0.1


def test_a_person_who_turned_the_other_wheel_is_told_so() -> None:
    said, _ = refused(Wires(), hand={"hand_left": (1, 3.0)})
    assert said == "hand_swapped"


@pytest.mark.parametrize("kind", sorted(SERIAL_PROTOCOLS))
def test_a_reversed_motor_that_creeps_while_the_other_turns_is_named(kind: str) -> None:
    """Of some bases it creeps so far, held at zero, that both wheels turn in the first step."""
    with pytest.raises(TrialRefusal, match="power_backwards"):
        tried(Stand(robot_of(kind), Wires(motor_sign=(1, -1))))


def test_a_battery_at_its_end_is_charged_first() -> None:
    volts = {"battery_empty_v": 9.6, "battery_full_v": 12.6}
    robot = MCU.model_copy(update={"drive": MCU.drive.model_copy(update=volts)})
    with pytest.raises(TrialRefusal, match="trial_battery"):
        tried(Stand(robot, Wires(battery=0.02)))


def test_ticks_that_fit_are_proposed() -> None:
    stand = Stand(MCU, Wires(ticks_times=0.5))
    with pytest.raises(TrialRefusal, match=r"ticks_per_turn may be 7[45]\d"):
        tried(stand)


def test_a_base_that_is_not_there_is_silence() -> None:
    stand = Stand(MCU)
    stand.wheels.end.write = lambda data: None  # type: ignore[method-assign]
    with pytest.raises(TrialRefusal, match="trial_silent"):
        tried(stand)


def test_a_controller_that_begins_anew_ends_the_trial() -> None:
    class Reset(Stand):
        def ask(self, code: str) -> None:
            self.wheels.firmware = FIRMWARES["pons_mcu"](MCU)
            super().ask(code)

    with pytest.raises(TrialRefusal, match="trial_rebooted"):
        tried(Reset(MCU))
