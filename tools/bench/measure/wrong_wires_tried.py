"""Count the wrong wirings that `pons robot try` names rightly before anything drives.

Seeded wirings, one fault or two at once, on the stand of sim/twin/stand.py in lockstep with the
shipped drive; the lidar's beams come from the same box. Right is the code of one of the wires that
are wrong: a trial ends at the first, and the next one finds the other. Good wirings are tried too:
none of them may be refused.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict, dataclass, replace
from math import pi, tau
from random import Random
from typing import TYPE_CHECKING, Any, Final

from bridge.drive import SerialDrive
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from pons.robot.lidar_trial import try_lidar
from pons.robot.trial_parties import TrialRefusal
from pons.robot.wheel_trial import WheelTrial
from sim.twin.stand import TICK_S, WheelStand, Wires, see_box
from tools.bench.figures import none_in
from tools.bench.measure.dead_men import robot_of
from tools.bench.report import ReportRow
from tools.lockstep.drive_process import BaseEnd
from tools.lockstep.serial_line import SerialLine
from wire import Scan
from wire.lidar_config import LidarConfig

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from wire import RobotDescription

NAME = "wrong_wires_tried"
TITLE = "wrong wires: what pons robot try names"
LONG_ONLY = False
BEAMS = 360
HAND_SIGMA: Final = 0.03
"""Of three turns: a person turns a wheel to within a twelfth of a turn or so."""
FAULTS: Final[dict[str, tuple[dict[str, Any], frozenset[str]]]] = {
    "encoders swapped": ({"encoders_swapped": True}, frozenset({"hand_swapped"})),
    "left encoder reversed": ({"encoder_sign": (-1, 1)}, frozenset({"hand_backwards"})),
    "right encoder reversed": ({"encoder_sign": (1, -1)}, frozenset({"hand_backwards"})),
    "both encoders reversed": ({"encoder_sign": (-1, -1)}, frozenset({"hand_backwards"})),
    "ticks x 0.5": ({"ticks_times": 0.5}, frozenset({"hand_ticks"})),
    "ticks x 2": ({"ticks_times": 2.0}, frozenset({"hand_ticks"})),
    "motors swapped": ({"motors_swapped": True}, frozenset({"power_swapped"})),
    "left motor reversed": ({"motor_sign": (-1, 1)}, frozenset({"power_backwards"})),
    "right motor reversed": ({"motor_sign": (1, -1)}, frozenset({"power_backwards"})),
    "both motors reversed": ({"motor_sign": (-1, -1)}, frozenset({"power_backwards"})),
    "lidar mirrored": ({"lidar_mirrored": True}, frozenset({"lidar_mirrored"})),
    "lidar turned": ({"lidar_turned_rad": pi / 2}, frozenset({"lidar_turned"})),
}
"""By name: the wires, and the codes that name them."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Measure a draw of wrong wirings, and of good ones."""
    wrong = [WiringTrial(**one) for one in lab.slices("wrong", lab.count(12, 100), _slice_wrong)]
    good = [WiringTrial(**one) for one in lab.slices("good", lab.count(4, 100), _slice_good)]
    return [_row(wrong), _good_row(good)]


@dataclass(frozen=True, slots=True)
class WiringTrial:
    """Tell what one wiring was called."""

    kind: str
    wrong: tuple[str, ...]
    code: str
    """Empty where nothing was refused."""
    fastest_radps: float

    @property
    def is_right(self) -> bool:
        """Tell whether one of the wrong wires was named, or nothing where all are right."""
        if not self.wrong:
            return not self.code
        return any(self.code in FAULTS[name][1] for name in self.wrong)


def _slice_wrong(index: int) -> dict[str, Any]:
    random = Random(f"wrong {index}")
    names = random.sample(sorted(FAULTS), random.choice((1, 1, 2)))
    return asdict(try_wiring(random, tuple(names)))


def _slice_good(index: int) -> dict[str, Any]:
    return asdict(try_wiring(Random(f"good {index}"), ()))


def try_wiring(random: Random, names: tuple[str, ...]) -> WiringTrial:
    """Try a base and a lidar with these faults at once."""
    kind = random.choice(sorted(SERIAL_PROTOCOLS))
    wires = Wires()
    for name in names:
        wires = replace(wires, **FAULTS[name][0])
    party = StandParty(robot_of(kind), wires, random)
    code = ""
    try:
        WheelTrial(party.drive, party.robot, party, party, "trial").run()
        try_lidar(LidarConfig(kind="ld19", port="/dev/x"), party.look, party.ask)
    except TrialRefusal as refusal:
        code = refusal.code
    return WiringTrial(kind, names, code, party.stand.fastest_radps)


class StandParty:
    """Be time, person and lidar of one stand."""

    def __init__(self, robot: RobotDescription, wires: Wires, random: Random) -> None:
        self.robot, self._wires, self._random = robot, wires, random
        self._time_s = 1000.0
        line = SerialLine(1)
        self.stand = WheelStand(robot, wires, BaseEnd(line), self._time_s)
        protocol = SERIAL_PROTOCOLS[robot.drive.kind](robot, "trial")
        self.drive = SerialDrive(protocol, line, "trial", self.now_s)
        self._shown: float | None = None

    def now_s(self) -> float:
        """Return the time [s]."""
        return self._time_s

    def wait(self) -> None:
        """Let 10 ms pass."""
        self._time_s += TICK_S
        self.stand.tick(self._time_s)

    def ask(self, code: str) -> None:
        """Turn a wheel, as exactly as hands do, or hold the box."""
        if code.startswith("hand"):
            turns = self._random.gauss(3.0, 3.0 * HAND_SIGMA)
            self.stand.turn_by_hand(int(code == "hand_right"), min(max(turns, 2.75), 3.25))
        else:
            at = self._random.gauss(0.0, 0.1)
            self._shown = {"lidar_front": at, "lidar_left": pi / 2 + at}.get(code)

    def has_answered(self) -> bool:
        """Tell whether it is done."""
        return not self.stand.is_turned

    def tell(self, step: str, seen: str = "") -> None:
        """Hear it."""

    def require_watch(self) -> None:
        """Watch always."""

    def look(self) -> Scan:
        """Return a scan of now."""
        angles = [-pi + index * tau / BEAMS for index in range(BEAMS)]
        return Scan(
            boot_id="x",
            seq=1,
            stamp_s=1.0,
            angle_min_rad=-pi,
            angle_increment_rad=tau / BEAMS,
            range_min_m=0.05,
            range_max_m=12.0,
            ranges_m=tuple(see_box(angles, self._shown, self._wires)),
        )


def _row(trials: list[WiringTrial]) -> ReportRow:
    right = sum(one.is_right for one in trials)
    missed = Counter(f"{' + '.join(one.wrong)}: {one.code}" for one in trials if not one.is_right)
    fastest = max((one.fastest_radps for one in trials), default=float("nan"))
    note = f"{none_in(len(trials))}; wheels at most {fastest:.1f} rad/s; missed {dict(missed)}"
    value = f"{right} of {len(trials)}"
    return ReportRow("wrong wirings named rightly", "", "all", value=value, note=note)


def _good_row(trials: list[WiringTrial]) -> ReportRow:
    refused = Counter(f"{one.kind}: {one.code}" for one in trials if one.code)
    return ReportRow(
        "good wirings refused", "", "0", value=str(sum(refused.values())),
        note=f"{none_in(len(trials))}; {dict(refused)}",
    )  # fmt: skip
