"""A port that goes in the middle of a trial is named as that, whatever it looks like by then."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations

import pytest

from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_run import try_base
from pons.robot.trial_words import REFUSALS
from sim.twin.pons_mcu import PonsMcuFirmware
from sim.twin.twin import FIRMWARES, Firmware
from tests.bridge.drive.test_pons_mcu import frame
from tests.pons.robot.stand import Stand
from tests.pons.robot.twin_ports import BASES
from tests.sensors.lidar.frames import ld_frame
from tools.lockstep.serial_line import LineFault
from wire import DriveState, RobotDescription

pytestmark = pytest.mark.nightly(keep=15)


STEPS = ("listen", "hand_left", "hand_right", "power_left", "power_right", "power_back", "silence")


@dataclass
class PulledStand(Stand):
    """Pull the base's cable a while after a step began, and perhaps put it in again."""

    step: str = "listen"
    after_ticks: int = 40
    back_ticks: int | None = None
    stops: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        self._since: int | None = None

    def wait(self) -> None:
        super().wait()
        if self.steps and self.steps[-1] == self.step and self._since is None:
            self._since = 0
        if self._since is None:
            return
        self._since += 1
        if self._since == self.after_ticks:
            self.line.break_down(LineFault.HUNG_UP)
        if self.back_ticks is not None and self._since == self.after_ticks + self.back_ticks:
            self.line.break_down(None)

    def require_watch(self) -> None:
        if self.stops and self.line.trouble is not None:
            raise TrialRefusal("trial_stopped")


def refused(stand: PulledStand, robot: RobotDescription) -> TrialRefusal:
    with pytest.raises(TrialRefusal) as caught:
        try_base(stand.drive, robot, stand, stand, "trial")
    return caught.value


def stands(stand: PulledStand) -> bool:
    """Return whether the wheels stand once the base's own dead-man has acted."""
    for _ in range(400):
        stand.wait()
    return max(map(abs, stand.wheels.radps)) < 0.05


@pytest.mark.parametrize("kind", sorted(BASES))
@pytest.mark.parametrize("step", STEPS)
def test_a_pulled_cable_is_the_word_at_each_step_and_the_wheels_stand(step: str, kind: str) -> None:
    stand = PulledStand(BASES[kind], step=step)
    refusal = refused(stand, BASES[kind])
    assert (refusal.code, refusal.detail[:9]) == ("trial_port", "port_gone")
    assert stands(stand)
    assert stand.wheels.fastest_radps < 8.0


@pytest.mark.parametrize("step", ["hand_left", "power_left"])
def test_a_cable_that_is_back_already_is_told_too(step: str) -> None:
    stand = PulledStand(BASES["pons_mcu"], step=step, back_ticks=230)
    refusal = refused(stand, BASES["pons_mcu"])
    assert refusal.code == "trial_port"
    assert stands(stand)


def test_a_person_who_stops_is_answered_as_one_though_the_cable_went_too() -> None:
    stand = PulledStand(BASES["pons_mcu"], step="power_left", stops=True)
    assert refused(stand, BASES["pons_mcu"]).code == "trial_stopped"


def test_a_line_that_stays_is_tried_to_the_end() -> None:
    stand = PulledStand(BASES["pons_mcu"], step="never")
    found, turned = try_base(stand.drive, BASES["pons_mcu"], stand, stand, "trial")
    assert turned is None
    assert found.dead_man_s < 0.5


SPEAKING = ("pons_mcu", "waveshare")
"""They speak unasked; the others answer their own language alone."""


def plugged_in(told: str, firmware: Firmware) -> tuple[TrialRefusal, Stand]:
    """Try a robot at whose port another base is."""
    stand = Stand(BASES[told])
    stand.wheels.firmware = firmware
    with pytest.raises(TrialRefusal) as caught:
        try_base(stand.drive, BASES[told], stand, stand, "trial")
    return caught.value, stand


@pytest.mark.parametrize(("told", "plugged"), list(permutations(sorted(BASES), 2)))
def test_a_base_of_another_kind_is_named_where_it_speaks_and_turns_no_wheel(
    told: str, plugged: str
) -> None:
    refusal, stand = plugged_in(told, FIRMWARES[plugged](BASES[plugged]))
    assert stand.wheels.fastest_radps == 0.0
    assert refusal.code in ("trial_other", "trial_silent")
    if plugged in SPEAKING:
        assert refusal.code == "trial_other"
        assert refusal.detail.startswith(f"drive {plugged}: ")


class SayingOtherwise(PonsMcuFirmware):
    """Hear as ours does, and say something else."""

    def __init__(self, words: bytes) -> None:
        super().__init__(BASES["pons_mcu"].drive)
        self.words = words

    def say(self, body: DriveState, now_s: float) -> bytes:
        return self.words


@pytest.mark.parametrize(
    ("words", "code", "named"),
    [
        (b"", "trial_silent", "no state"),
        (frame(0x82, 1, bytes(41)), "base_firmware_other", "no state"),
        (ld_frame(0.0, 0.8, [1.0] * 12, 100), "trial_other", "lidar ld19: "),
        (b"Hello world\r\n", "trial_other", "bytes of no base of kind 'pons_mcu'"),
    ],
)
def test_what_is_behind_a_port_that_gives_no_state_is_told(
    words: bytes, code: str, named: str
) -> None:
    refusal, stand = plugged_in("pons_mcu", SayingOtherwise(words))
    assert (refusal.code, stand.wheels.fastest_radps) == (code, 0.0)
    assert refusal.code in REFUSALS
    assert named in refusal.detail
