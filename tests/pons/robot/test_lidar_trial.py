"""What is held in front is seen in front, and left is left; else the mounting is named."""

from __future__ import annotations

from math import cos, pi, radians, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pons.robot.lidar_trial import try_lidar
from pons.robot.trial_parties import TrialRefusal
from pons.robot.trial_words import PROMPTS, REFUSALS
from wire import Scan
from wire.lidar_config import LidarConfig

BEAMS = 360
ROOM_M = 3.0
BOX_M, BOX_HALF_RAD = 0.6, radians(12)
SHOWN = {"lidar_clear": None, "lidar_front": 0.0, "lidar_left": pi / 2}


class Held:
    """Be a person with a box, and a lidar that is mounted as it is."""

    def __init__(
        self,
        mounted_rad: float = 0.0,
        *,
        mirrored: bool = False,
        x_m: float = 0.0,
        far_m: float = BOX_M,
    ) -> None:
        self.mounted_rad, self.mirrored, self.x_m, self.far_m = mounted_rad, mirrored, x_m, far_m
        self.asked: list[str] = []
        self.shown: float | None = None

    def ask(self, code: str) -> None:
        self.asked.append(code)
        self.shown = SHOWN[code]

    def look(self) -> Scan:
        ranges: list[float | None] = []
        for index in range(BEAMS):
            angle = -pi + index * tau / BEAMS
            seen = -angle if self.mirrored else angle
            ranges.append(self._range(seen + self.mounted_rad))
        return Scan(
            boot_id="x",
            seq=1,
            stamp_s=1.0,
            angle_min_rad=-pi,
            angle_increment_rad=tau / BEAMS,
            range_min_m=0.05,
            range_max_m=12.0,
            ranges_m=tuple(ranges),
        )

    def _range(self, towards_rad: float) -> float | None:
        """Return what a beam in a direction of ``base`` meets: a box round a place, or the room."""
        if self.shown is None:
            return ROOM_M
        box = self.far_m * cos(self.shown) - self.x_m, self.far_m * sin(self.shown)
        along = box[0] * cos(towards_rad) + box[1] * sin(towards_rad)
        across = abs(-box[0] * sin(towards_rad) + box[1] * cos(towards_rad))
        return along if along > 0.0 and across < self.far_m * BOX_HALF_RAD else ROOM_M


def config(**keys: object) -> LidarConfig:
    return LidarConfig.model_validate({"kind": "ld19", "port": "/dev/x", **keys})


@given(st.floats(-pi, pi), st.floats(-0.2, 0.2))
def test_a_lidar_that_is_described_truly_passes(mounted_rad: float, x_m: float) -> None:
    held = Held(mounted_rad, x_m=x_m)
    seen = try_lidar(config(yaw_rad=mounted_rad, x_m=x_m), held.look, held.ask)
    assert seen["front"] == pytest.approx(0.0, abs=0.2)
    assert seen["left"] == pytest.approx(pi / 2, abs=0.2)
    assert held.asked == list(SHOWN)
    assert set(held.asked) <= set(PROMPTS)


def refused(held: Held, **keys: object) -> TrialRefusal:
    with pytest.raises(TrialRefusal) as refusal:
        try_lidar(config(**keys), held.look, held.ask)
    assert refusal.value.code in REFUSALS
    return refusal.value


@given(st.floats(-pi, pi))
def test_a_mirrored_lidar_is_named_however_it_is_turned(mounted_rad: float) -> None:
    assert refused(Held(mounted_rad, mirrored=True)).code == "lidar_mirrored"


@pytest.mark.parametrize("turned_deg", [-170, -90, -45, 45, 90, 170])
def test_a_turned_lidar_is_named_with_the_turn_that_mends_it(turned_deg: int) -> None:
    said = refused(Held(radians(turned_deg)))
    assert said.code == "lidar_turned"
    proposed = float(said.detail.rpartition(" ")[2])
    assert abs(sin((proposed - radians(turned_deg)) / 2)) < 0.05


def test_nothing_held_up_is_said() -> None:
    assert refused(Held(far_m=2.5)).code == "lidar_nothing"
