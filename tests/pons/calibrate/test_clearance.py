"""What is chosen is faced in the end, whatever turns do; what does not fit is refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, repeat
from math import cos, inf, pi, radians, sin, sqrt, tau
from typing import cast

import pytest

from pons.calibrate import procedure
from pons.calibrate.clearance import (
    BEHIND_M,
    LONGEST_M,
    REAL_TURN_RAD,
    SHORTEST_M,
    SPARE_M,
    best_way,
    free_m,
    needed_m,
    points_of,
)
from pons.calibrate.errors import CalibrationRefusal
from pons.calibrate.procedure import CalibrationPlan
from pons.calibrate.reference import WallLook
from pons.calibrate.session import CalibrationRig
from wire import RobotDescription, Scan

ROBOT = RobotDescription()
RADIUS_M = ROBOT.base.radius_m
POST_M = 0.1
Truth = Callable[[float], float]


@dataclass
class Room:
    """Be a rig that stands in a room of four walls and posts, and sees it with a noisy lidar."""

    ahead_m: float
    """From the robot's middle to the wall at the world's heading 0; then left, behind, right."""
    left_m: float
    behind_m: float
    right_m: float
    posts: tuple[tuple[float, float], ...] = ()
    heading_rad: float = 0.0
    noise_m: float = 0.02
    looks: int = 0

    def look(self) -> WallLook:
        self.looks += 1
        count = 180
        ranges = tuple(
            self._range_m(self.heading_rad + index * tau / count)
            + self.noise_m * sin(12.9 * index + 7.7 * self.looks)
            for index in range(count)
        )
        scan = Scan(
            boot_id="sim",
            seq=self.looks,
            stamp_s=float(self.looks),
            angle_min_rad=0.0,
            angle_increment_rad=tau / count,
            range_min_m=0.1,
            range_max_m=8.0,
            ranges_m=ranges,
        )
        return WallLook(None, (scan,))

    def _range_m(self, a: float) -> float:
        x, y = cos(a), sin(a)
        far = [self.ahead_m / x if x > 0 else -self.behind_m / x if x < 0 else inf]
        far += [self.left_m / y if y > 0 else -self.right_m / y if y < 0 else inf]
        for at_x, at_y in self.posts:
            along, aside = at_x * x + at_y * y, at_y * x - at_x * y
            if along > 0.0 and abs(aside) < POST_M:
                far.append(along - sqrt(POST_M**2 - aside**2))
        return min(far)

    def free_ahead_m(self) -> float:
        return free_m(points_of(self.look().scans[-1], ROBOT), RADIUS_M)[0]


def faced(room: Room, ends: Truth, monkeypatch: pytest.MonkeyPatch) -> tuple[float, list[float]]:
    """Face the way with turns that end where ``ends`` says; return the run and the turns."""
    turns: list[float] = []

    def turn(_rig: object, _robot: object, angle_rad: float) -> None:
        turns.append(angle_rad)
        room.heading_rad += ends(angle_rad)

    monkeypatch.setattr(procedure, "turn", turn)
    return procedure._face_the_way(
        cast("CalibrationRig", room), ROBOT, CalibrationPlan(None), lambda _: None
    ), turns


def wobbly(*off_deg: float) -> Truth:
    """Return turns that end so much off, one after another, and then true."""
    off: Iterator[float] = chain(off_deg, repeat(0.0))
    return lambda angle_rad: angle_rad + radians(next(off))


TURNS: dict[str, Truth] = {
    "true": lambda a: a,
    "a tenth short": lambda a: 0.9 * a,
    "a tenth far": lambda a: 1.1 * a,
    "a fifth short": lambda a: 0.8 * a,
    "at first 8 degrees off": wobbly(-8.0, 7.0, -5.0),
    "short ones do nothing": lambda a: 0.92 * a if abs(a) >= REAL_TURN_RAD else 0.0,
}
ROOMS = {
    "a corridor to the left": lambda: Room(0.6, 3.0, 0.7, 0.75),
    "a corridor behind": lambda: Room(0.75, 0.6, 3.0, 0.6),
    "a corridor 8 degrees off": lambda: Room(0.6, 3.0, 0.7, 0.75, heading_rad=pi / 2 - 0.14),
    "posts beside the way": lambda: Room(
        0.8, 3.2, 0.7, 1.2, posts=((0.6, 1.4), (-0.6, 1.0), (-0.75, 1.9))
    ),
}


@pytest.mark.parametrize("ends", TURNS.values(), ids=TURNS)
@pytest.mark.parametrize("made", ROOMS.values(), ids=ROOMS)
def test_it_faces_what_it_chose_whatever_turns_do(
    made: Callable[[], Room], ends: Truth, monkeypatch: pytest.MonkeyPatch
) -> None:
    room = made()
    run_m, turns = faced(room, ends, monkeypatch)
    assert SHORTEST_M <= run_m <= LONGEST_M
    for _ in range(10):  # looks before each run, each with its own noise
        assert room.free_ahead_m() >= needed_m(run_m)
    assert 0 < len(turns) <= procedure.TURNS
    assert min(map(abs, turns)) >= REAL_TURN_RAD, "shorter ones may be none"


def test_what_is_ahead_and_long_enough_is_not_turned_from(monkeypatch: pytest.MonkeyPatch) -> None:
    run_m, turns = faced(Room(2.4, 0.6, 0.7, 0.6), TURNS["true"], monkeypatch)
    assert (run_m, turns) == (LONGEST_M, [])


def test_turns_that_lead_nowhere_end(monkeypatch: pytest.MonkeyPatch) -> None:
    room = ROOMS["a corridor to the left"]()
    with pytest.raises(CalibrationRefusal, match="no_room") as refused:
        faced(room, lambda _: 0.0, monkeypatch)
    assert room.looks == procedure.TURNS + 1
    assert f"{BEHIND_M + SPARE_M:.2f} m behind" in refused.value.detail


@pytest.mark.parametrize(
    ("spared", "fits"), [(0.0, False), (SPARE_M / 2, True)], ids=["none", "half"]
)
def test_a_way_ahead_has_something_to_spare_on_every_side(spared: float, fits: bool) -> None:
    beyond = spared + 0.01
    side, ahead = RADIUS_M + 0.05 + beyond, RADIUS_M + needed_m(SHORTEST_M) + beyond
    wide, behind = side + 0.2, RADIUS_M + BEHIND_M + beyond
    for room in (
        Room(ahead, wide, behind + 0.2, wide),
        Room(ahead + 0.2, side, behind + 0.2, wide),
        Room(ahead + 0.2, wide, behind, wide),
    ):
        room.noise_m = 0.0
        points = points_of(room.look().scans[-1], ROBOT)
        if fits:
            assert best_way(points, RADIUS_M, (0.0,)).run_m >= SHORTEST_M
        else:
            with pytest.raises(CalibrationRefusal, match="no_room"):
                best_way(points, RADIUS_M, (0.0,))
