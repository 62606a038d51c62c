"""Whatever scans, odometry and the world do: the localizer is right, or says that it is not sure.

The members are those of the list of bad input for localization. The law of each: a word of a
quality on which the bridge would drive is never far off.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from random import Random

import numpy as np
import pytest

from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch
from localization.localizer import Localizer, LocalizerState
from localization.quality import POOR_QUALITY
from maps import FREE, OCCUPIED, GridMap, load_map
from maps.cell_array import cell_array
from tests.conftest import ROOT
from tests.localization.rooms import (
    CORRIDOR,
    MAP_ID,
    ROOM,
    TWINS,
    Boxes,
    field_of,
    scan_of,
)
from tests.localization.test_localizer import Drive, Ranges, fork, settle
from wire import IDENTITY, Pose2, Scan
from wire.lidar_config import LidarConfig

pytestmark = pytest.mark.nightly(keep=15)


WRONG_M = 0.25
SECONDS = 1.5
OTHER_FLOOR: Boxes = (
    (0.0, 0.0, 6.0, 0.1), (0.0, 3.9, 6.0, 4.0), (0.0, 0.0, 0.1, 4.0), (5.9, 0.0, 6.0, 4.0),
    (0.1, 0.1, 1.9, 1.2), (3.4, 2.4, 5.9, 3.9), (2.6, 0.1, 3.0, 0.6),
)  # fmt: skip
EMPTIED: Boxes = ROOM[:4]
REARRANGED: Boxes = (*ROOM[:4], (3.6, 3.1, 4.8, 3.9), (0.1, 0.1, 1.5, 0.9))
LEGS_ONLY: Boxes = (
    *ROOM[:5],
    *((x, y, x + 0.05, y + 0.05) for x in (4.6, 5.8) for y in (0.2, 0.7)),
)
SHUT: Boxes = (*ROOM, (3.9, 0.1, 4.0, 3.9))


class HostileDrive(Drive):
    """Be a robot whose lidar lies as it is told to."""

    lens: Callable[[Ranges, int], Ranges] = staticmethod(lambda ranges, _: ranges)
    stamp: Callable[[float, int], float] = staticmethod(lambda now_s, _: now_s)
    seq: Callable[[int], int] = staticmethod(lambda turn: turn)
    boot: Callable[[int], str] = staticmethod(lambda _: "lidar-1")

    def make_scan(self, ranges: Ranges) -> Scan:
        """Return what the lidar says."""
        changed = {
            "ranges_m": self.lens(ranges, self.turns),
            "stamp_s": self.stamp(self.now_s, self.turns),
            "boot_id": self.boot(self.turns),
        }
        return scan_of(ranges, self.now_s, self.seq(self.turns)).model_copy(update=changed)


@pytest.fixture(scope="module")
def settled_hostile() -> HostileDrive:
    return settle(HostileDrive())


@pytest.fixture
def drive(settled_hostile: HostileDrive) -> HostileDrive:
    return fork(settled_hostile)


def assert_honest(drive: Drive) -> None:
    wrong = [
        (word.quality, error_m)
        for word, error_m in zip(drive.said, drive.errors_m, strict=True)
        if word.quality >= POOR_QUALITY and not error_m <= WRONG_M
    ]
    assert wrong == []


def glass(ranges: Ranges, turn: int) -> Ranges:
    random = Random(turn)
    return tuple(r and (r + 2.0 if random.random() < 0.3 else r) for r in ranges)


def sunlight(ranges: Ranges, turn: int) -> Ranges:
    random = Random(turn)
    return tuple(random.uniform(0.2, 7.0) if random.random() < 0.05 else r for r in ranges)


def leaning(first: int) -> Callable[[Ranges, int], Ranges]:
    """Return the lens of somebody who leans over the lidar: 80 % of the beams end on them."""

    def lens(ranges: Ranges, turn: int) -> Ranges:
        body, breath, count = Random(1), Random(turn), len(ranges)
        near = {(first + i) % count: body.uniform(0.25, 0.4) for i in range(count * 4 // 5)}
        return tuple(
            near[i] + breath.gauss(0.0, 0.003) if i in near else r for i, r in enumerate(ranges)
        )

    return lens


LENSES: dict[str, Callable[[Ranges, int], Ranges]] = {
    "no beam": lambda _ranges, _: (),
    "one beam": lambda ranges, _: ranges[:1],
    "seven beams": lambda ranges, _: ranges[:7],
    "a count that changes": lambda ranges, turn: ranges[:: 1 + turn // 2 % 3],
    "nothing returns": lambda ranges, _: (None,) * len(ranges),
    "all equal": lambda ranges, turn: (1.0 + 0.001 * (turn % 7),) * len(ranges),
    "all at the nearest": lambda ranges, _: (0.12,) * len(ranges),
    "zeros": lambda ranges, _: (0.0,) * len(ranges),
    "mirrored": lambda ranges, _: ranges[::-1],
    "hugged": lambda ranges, t: (0.3 + 0.001 * (t % 5),) * 144 + ranges[144:],
    **{f"leaned over from {first}": leaning(first) for first in range(0, 180, 30)},
    "all at 0.3 m": lambda ranges, turn: (0.3 + 0.001 * (turn % 5),) * len(ranges),
    "a black sofa": lambda ranges, _: (None,) * 60 + ranges[60:],
    "glass": glass,
    "sunlight": sunlight,
}


@pytest.mark.parametrize("name", LENSES)
def test_a_lidar_that_lies_makes_no_confident_wrong_pose(drive: HostileDrive, name: str) -> None:
    drive.lens = LENSES[name]
    drive.run(SECONDS / 2, Pose2(0.01, 0.0, 0.02))
    drive.run(SECONDS / 2)
    assert_honest(drive)


def test_a_lidar_that_lies_from_the_start_finds_no_wrong_place() -> None:
    for name in ("mirrored", "hugged", "all equal", "seven beams"):
        drive = HostileDrive()
        drive.lens = LENSES[name]
        drive.run(SECONDS)
        assert_honest(drive)


STAMPS: dict[str, Callable[[float, int], float]] = {
    "backwards": lambda now_s, turn: now_s - 0.2 * turn,
    "an hour on": lambda now_s, _: now_s + 3600.0,
    "constant": lambda _now, _: 100.4,
    "of another clock": lambda _now, _: 4.29e9,
}


@pytest.mark.parametrize("name", STAMPS)
def test_stamps_that_lie_age_the_pose_and_nothing_else(drive: HostileDrive, name: str) -> None:
    drive.stamp = STAMPS[name]
    drive.run(2.0)
    assert_honest(drive)
    assert drive.said[-1].quality < POOR_QUALITY, "no scan of this time has come"


SEQUENCES: dict[str, Callable[[int], int]] = {
    "backwards": lambda turn: 10_000 - turn,
    "constant": lambda _: 7,
    "with gaps": lambda turn: turn * 1000,
}


@pytest.mark.parametrize("name", SEQUENCES)
def test_numbers_of_scans_that_lie_make_no_confident_wrong_pose(
    drive: HostileDrive, name: str
) -> None:
    drive.seq = SEQUENCES[name]
    drive.run(SECONDS, Pose2(0.01, 0.0, 0.02))
    assert_honest(drive)


def test_two_lidars_on_one_key_are_one_room(drive: HostileDrive) -> None:
    drive.boot = lambda turn: f"lidar-{turn // 2 % 2}"
    drive.run(SECONDS, Pose2(0.01, 0.0, 0.02))
    assert_honest(drive)


def test_a_jump_of_odometry_is_taken_back_by_scans(drive: HostileDrive) -> None:
    drive.turn(IDENTITY, Pose2(1.0, 0.0, 0.0))
    drive.run(2.0)
    assert_honest(drive)
    assert drive.errors_m[-1] < 0.05


@pytest.mark.parametrize("wheels", [Pose2(-0.02, 0.0, -0.02), IDENTITY, Pose2(0.05, 0.0, 0.0)])
def test_wheels_that_say_another_way(drive: HostileDrive, wheels: Pose2) -> None:
    """Reversed, pushed with wheels that stand, spinning: 1.2 s at 0.4 m/s."""
    for _ in range(24):
        drive.turn(Pose2(0.02, 0.0, 0.02), wheels)
    drive.run(1.0)
    assert_honest(drive)


def test_a_gyro_that_turns_while_the_robot_stands_is_not_believed(drive: HostileDrive) -> None:
    drive.yaw_rate_radps = 0.2
    drive.run(SECONDS)
    drive.run(SECONDS, Pose2(0.02, 0.0, 0.0))
    assert_honest(drive)


@pytest.mark.parametrize("boxes", [EMPTIED, REARRANGED, LEGS_ONLY, SHUT])
def test_a_room_that_changed_is_known_or_doubted(drive: HostileDrive, boxes: Boxes) -> None:
    drive.boxes = boxes
    drive.run(SECONDS / 2, Pose2(0.01, 0.0, 0.02))
    drive.run(SECONDS)
    assert_honest(drive)


def test_carried_to_another_floor_it_is_lost_and_stays_so(drive: HostileDrive) -> None:
    drive.boxes, drive.true = OTHER_FLOOR, Pose2(2.0, 2.6, -1.0)
    drive.run(3.0)
    assert drive.localizer.state is LocalizerState.LOST
    assert all(word.quality < POOR_QUALITY for word in drive.said[-30:])


def test_of_two_equal_rooms_it_says_that_it_does_not_know() -> None:
    drive, field = HostileDrive(), field_of(TWINS, 8.0, 3.0)
    drive.localizer, drive.search = Localizer(field, LidarConfig(), MAP_ID), GlobalSearch(field)
    drive.boxes, drive.true = TWINS, Pose2(2.0, 1.6, 0.3)
    drive.run(SECONDS)
    assert drive.said == []
    assert drive.localizer.state is LocalizerState.SEARCHING
    assert len(drive.localizer.candidates) >= 2


def test_along_a_bare_corridor_trust_runs_out_with_the_metres() -> None:
    drive, field = HostileDrive(), field_of(CORRIDOR, 40.0, 1.6)
    drive.localizer, drive.search = Localizer(field, LidarConfig(), MAP_ID), GlobalSearch(field)
    drive.boxes, drive.true = CORRIDOR, Pose2(12.0, 0.8, 0.0)
    drive.run(SECONDS)
    assert drive.said == [], "each place of it looks like any other"


HOME = load_map(ROOT / "sites" / "home" / "map.yaml").grid
HOME_FIELD = DistanceField.of_map(HOME)
HOME_SEARCH = GlobalSearch(HOME_FIELD)


def boxes_of(grid: GridMap) -> Boxes:
    """Return a map's obstacles as boxes, a run of a row each."""
    boxes: list[tuple[float, float, float, float]] = []
    for row, cells in enumerate(cell_array(grid) == OCCUPIED):
        edges = np.flatnonzero(np.diff(np.concatenate(([False], cells, [False])).astype(int)))
        y_m = grid.origin_y_m + row * grid.resolution_m
        for first, end in edges.reshape(-1, 2):
            x0_m, x1_m = (grid.origin_x_m + at * grid.resolution_m for at in (first, end))
            boxes.append((x0_m, y_m, x1_m, y_m + grid.resolution_m))
    return tuple(boxes)


HOME_BOXES = boxes_of(HOME)


class HomeDrive(HostileDrive):
    """Stand somewhere in the default home, whose many corners fit many things."""

    def __init__(self, seed: int) -> None:
        super().__init__()
        self.search, self.localizer = HOME_SEARCH, Localizer(HOME_FIELD, LidarConfig(), MAP_ID)
        self.boxes = HOME_BOXES
        self.true = self.wheels = self._draw_pose(Random(seed))

    def _draw_pose(self, random: Random) -> Pose2:
        while True:
            x_m = HOME.origin_x_m + random.random() * HOME.width * HOME.resolution_m
            y_m = HOME.origin_y_m + random.random() * HOME.height * HOME.resolution_m
            cell = np.array([x_m]), np.array([y_m])
            column, row = HOME.cell_of(x_m, y_m)
            is_floor = cell_array(HOME)[row, column] == FREE
            if is_floor and HOME_FIELD.distance(*cell)[0] >= 0.35:
                return Pose2(x_m, y_m, random.uniform(-3.0, 3.0))


@cache
def settled_at_home(seed: int) -> HomeDrive:
    drive = HomeDrive(seed)
    drive.run(0.5)
    assert drive.localizer.state is LocalizerState.TRACKING
    return drive


CROWDS = ("leaned over from 0", "leaned over from 90", "all at the nearest", "all at 0.3 m")


@pytest.mark.parametrize("name", CROWDS)
@pytest.mark.parametrize("seed", range(3))
def test_who_is_hugged_at_home_is_not_led_astray(seed: int, name: str) -> None:
    drive = fork(settled_at_home(seed), HOME_FIELD, HOME_SEARCH, HOME_BOXES)
    drive.lens = LENSES[name]
    drive.run(SECONDS)
    assert_honest(drive)
