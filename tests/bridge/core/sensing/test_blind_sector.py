"""Tell a hole in the lidar from what is black, open or far: by what turns with the robot."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, degrees, hypot, pi, radians, sin, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.sensing.blind_sector import COARSE_RAD, coarse_words, runs, watch_sectors
from bridge.core.state_senses import SectorMemory
from tests.bridge.core.scripted import World
from wire import Pose2, Scan
from wire.lidar_config import LidarConfig

PRESET_BEAMS = (180, 250, 360, 450, 667, 720, 1440)
HALF_M = 2.0
"""Of the square room in whose middle the robot begins."""


class Room:
    """Be a square room with a lidar, a hole in the lidar and black things, on a clock."""

    def __init__(
        self,
        beams: int = 360,
        first_rad: float = -pi,
        half_m: float = HALF_M,
        turns_rad: float = 0.0,
    ) -> None:
        self.beams, self.first_rad, self.half_m = beams, first_rad, half_m
        self.turns_rad = turns_rad
        """From one scan's first beam to the next one's."""
        self.hole_rad: tuple[float, float] | None = None
        """Middle and width, in ``base``."""
        self.black: tuple[float, float, float] | None = None
        """A disc from which nothing returns: x, y, radius."""
        self.leaf_rad: tuple[float, float] | None = None
        """Middle and width of a door's leaf at 0.8 m, in ``odom``."""
        self.at, self.now_s, self.way_m = Pose2(0.0, 0.0, 0.0), 50.0, 0.0
        self.memory = SectorMemory()

    def scan(self, count: int = 1) -> SectorMemory:
        for _ in range(count):
            self.now_s += 0.1
            self.first_rad = (self.first_rad + self.turns_rad + pi) % tau - pi
            self.memory = watch_sectors(self.memory, self._picture(), self.way_m, self.now_s)
        return self.memory

    def turn(self, to_deg: float, step_deg: float = 3.0) -> float:
        """Turn in place; return the widest that was ever blind ahead [degrees]."""
        most_rad = 0.0
        while abs(self.at.yaw_rad - radians(to_deg)) > 1e-6:
            left = radians(to_deg) - self.at.yaw_rad
            step = max(-radians(step_deg), min(radians(step_deg), left))
            self.at = replace(self.at, yaw_rad=self.at.yaw_rad + step)
            most_rad = max(most_rad, self.scan().ahead_rad)
        return degrees(most_rad)

    def drive(self, to_m: float, step_m: float = 0.02) -> float:
        """Drive along x; return the widest that was ever dead ahead or behind [degrees]."""
        most_rad = 0.0
        while self.at.x_m < to_m - 1e-9:
            self.at, self.way_m = replace(self.at, x_m=self.at.x_m + step_m), self.way_m + step_m
            told = self.scan()
            most_rad = max(most_rad, told.ahead_rad, told.behind_rad)
        return degrees(most_rad)

    def _picture(self) -> ScanPicture:
        step = tau / self.beams
        ranges = tuple(self._range(self.first_rad + step * k) for k in range(self.beams))
        scan = Scan(
            boot_id="l", seq=1, stamp_s=0.0, angle_min_rad=self.first_rad,
            angle_increment_rad=step, range_min_m=0.12, range_max_m=8.0, ranges_m=ranges,
        )  # fmt: skip
        return ScanPicture.from_scan(scan, self.at, LidarConfig())

    def _range(self, in_base_rad: float) -> float | None:
        if self.hole_rad is not None:
            off = (in_base_rad - self.hole_rad[0] + pi) % tau - pi
            if abs(off) <= self.hole_rad[1] / 2:
                return None
        angle = in_base_rad + self.at.yaw_rad
        if self.leaf_rad is not None:
            off = (angle - self.leaf_rad[0] + pi) % tau - pi
            if abs(off) <= self.leaf_rad[1] / 2:
                return 0.8
        c, s = cos(angle), sin(angle)
        x_m = ((self.half_m if c > 0 else -self.half_m) - self.at.x_m) / c if c else 1e9
        y_m = ((self.half_m if s > 0 else -self.half_m) - self.at.y_m) / s if s else 1e9
        if self.black is not None and self._meets_black(angle, min(x_m, y_m)):
            return None
        wall_m = min(x_m, y_m)
        return wall_m if wall_m <= 8.0 else None

    def _meets_black(self, angle: float, wall_m: float) -> bool:
        assert self.black is not None
        dx, dy, radius = self.black[0] - self.at.x_m, self.black[1] - self.at.y_m, self.black[2]
        along, away = atan2(dy, dx), hypot(dx, dy)
        off = abs((angle - along + pi) % tau - pi)
        return off < pi / 2 and away * sin(off) < radius and away * cos(off) < wall_m


@pytest.mark.parametrize("beams", PRESET_BEAMS)
@pytest.mark.parametrize("width_deg", [15, 45, 120])
def test_a_hole_of_any_width_in_any_lidar_is_found_when_it_comes(
    beams: int, width_deg: int
) -> None:
    room = Room(beams)
    assert room.scan(3).ahead_rad == 0.0
    room.hole_rad = (0.1, radians(width_deg))
    assert room.scan(2).ahead_rad == 0.0, "not within 0.2 s"
    assert degrees(room.scan(1).ahead_rad) >= min(width_deg, 110) - 6.1
    room.hole_rad = None
    assert room.scan(1).ahead_rad == 0.0, "what returns is alive"


@pytest.mark.parametrize("cuts", [2, 3, 5, 8])
@pytest.mark.parametrize("beams", PRESET_BEAMS)
@pytest.mark.parametrize("middle_rad", [0.1, pi])
def test_a_hole_is_found_where_each_scan_begins_at_another_beam(
    middle_rad: float, beams: int, cuts: int
) -> None:
    """A slow lidar gives its last 360 degrees several times a turn."""
    room = Room(beams, turns_rad=tau / cuts)
    room.hole_rad = (middle_rad, radians(40))
    first = room.scan(12)
    assert degrees(max(first.ahead_rad, first.behind_rad)) >= 40 - 8.1, "from the start"
    room.hole_rad = None
    room.scan(12)
    assert room.memory.ahead_rad == room.memory.behind_rad == 0.0
    room.hole_rad = (middle_rad, radians(40))
    later = room.scan(3)
    assert degrees(max(later.ahead_rad, later.behind_rad)) >= 40 - 8.1, "in mid-drive"


@pytest.mark.parametrize("width_deg", [15, 45, 120])
def test_a_hole_from_the_start_is_unproven_and_after_a_turn_is_dead(width_deg: int) -> None:
    room = Room()
    room.hole_rad = (0.0, radians(width_deg))
    told = room.scan()
    assert degrees(told.ahead_rad) >= min(width_deg, 118) - 6.1
    assert told.dead == 0
    room.turn(90.0)
    assert room.memory.dead != 0


def test_a_hole_behind_is_behind() -> None:
    room = Room()
    room.hole_rad = (pi, radians(60))
    told = room.scan()
    assert told.ahead_rad == 0.0
    assert degrees(told.behind_rad) >= 54.0


def test_a_black_thing_turns_past_the_robot_and_is_no_hole() -> None:
    room = Room()
    room.black = (1.0, 1.2, 0.6)
    room.scan(3)
    room.turn(350.0)
    assert room.memory.dead == 0
    assert room.turn(360.0) == 0.0
    assert room.memory.alive.bit_count() == 120
    assert room.turn(0.0, 6.0) == 0.0


def test_driving_past_a_black_thing_at_the_wall_is_free() -> None:
    room = Room(half_m=3.0)
    room.at = Pose2(-2.0, 2.2, 0.0)
    room.black = (0.0, 3.0, 0.4)
    room.turn(360.0)
    assert room.drive(2.0) == 0.0


def test_an_open_side_beyond_the_lidars_reach_is_free() -> None:
    room = Room(half_m=7.9)
    room.at = Pose2(0.0, -6.5, 0.0)
    assert room.scan(5).ahead_rad == 0.0
    assert room.turn(180.0) == 0.0
    assert room.drive(3.0, 0.05) == 0.0


def test_a_suspicion_ends_where_the_scans_do() -> None:
    room = Room()
    room.scan(3)
    room.hole_rad = (0.0, radians(45))
    room.scan()
    room.now_s += 0.4
    assert room.scan(9).dead == 0


@pytest.mark.parametrize("width_deg", [45, 60, 90, 300])
def test_a_door_that_opens_before_something_black_shows_no_hole(width_deg: int) -> None:
    room = Room()
    room.black, room.leaf_rad = (1.6, 0.0, 0.25), (0.0, radians(width_deg))
    room.scan(5)
    room.leaf_rad = None
    assert room.scan(9).dead == 0
    room.hole_rad = (1.0, radians(30))
    assert room.scan(3).dead != 0, "a hole beside it is one"


_PLACES = st.tuples(st.floats(-1.3, 1.3), st.floats(-1.3, 1.3), st.floats(0.1, 0.7))
_BEAMS = st.sampled_from((180, 250, 360))
_MOVES = st.lists(st.tuples(st.floats(0.0, 0.05), st.floats(-0.12, 0.12)), min_size=4, max_size=12)
"""Of a scan each: metres along the heading [m], then a turn [rad]."""


def _move(room: Room, move: tuple[float, float]) -> bool:
    """Move where a wall and the black disc are 0.4 m away; tell whether that was so."""
    yaw = room.at.yaw_rad
    there = Pose2(room.at.x_m + move[0] * cos(yaw), room.at.y_m + move[0] * sin(yaw), yaw + move[1])
    clear = max(abs(there.x_m), abs(there.y_m)) < room.half_m - 0.4
    if room.black is not None:
        x_m, y_m, radius = room.black
        clear = clear and hypot(there.x_m - x_m, there.y_m - y_m) > radius + 0.4
    if clear:
        room.at, room.way_m = there, room.way_m + move[0]
    return clear


@given(_BEAMS, _PLACES, _MOVES, st.integers(1, 3))
def test_no_way_past_anything_black_shows_a_hole(
    beams: int, black: tuple[float, float, float], moves: list[tuple[float, float]], times: int
) -> None:
    room = Room(beams)
    room.black = black
    if hypot(black[0], black[1]) <= black[2] + 0.4:
        return
    for move in moves * times:
        _move(room, move)
        assert room.scan().dead == 0


@given(
    _BEAMS, _MOVES, st.integers(15, 120), st.floats(-pi, pi),
    st.tuples(st.floats(-0.05, 0.05), st.floats(-0.12, 0.12)),
)  # fmt: skip
def test_a_hole_that_comes_in_any_motion_is_dead_in_three_scans(
    beams: int, moves: list[tuple[float, float]], width_deg: int, at_rad: float,
    after: tuple[float, float],
) -> None:  # fmt: skip
    room = Room(beams)
    for move in moves:
        _move(room, move)
        room.scan()
    room.hole_rad = (at_rad, radians(width_deg))
    for _ in range(3):
        _move(room, after)
        room.scan()
    assert room.memory.dead.bit_count() * 3 >= width_deg - 6
    held = room.memory.dead
    room.scan(3)
    assert room.memory.dead == held, "it stays until something returns"


@given(
    st.sampled_from((180, 360)), st.integers(15, 120), st.floats(-pi, pi),
    st.sampled_from([2.0, 30.0]), st.sampled_from([-1, 1]), st.integers(4, 6),
)  # fmt: skip
def test_a_hole_from_the_start_is_dead_after_a_turn_on_the_spot(
    beams: int, width_deg: int, at_rad: float, half_m: float, side: int, step_deg: int
) -> None:
    """Even in a hall whose walls are beyond the range but for one beside the robot."""
    room = Room(beams, half_m=half_m)
    room.at = Pose2(half_m - 1.2, 0.0, 0.0)
    room.hole_rad = (at_rad, radians(width_deg))
    room.scan()
    room.turn(side * 359.0, step_deg)
    assert room.memory.dead.bit_count() * 3 >= width_deg - 6


def test_who_boots_before_something_black_is_free_once_turned_past_it() -> None:
    room = Room()
    room.black = (0.9, 0.0, 0.4)
    assert degrees(room.scan(5).ahead_rad) > 40
    room.turn(60.0)
    room.turn(0.0)
    assert room.memory.ahead_rad == 0.0
    assert room.memory.dead == 0


def test_scans_that_come_seldom_are_judged_by_time() -> None:
    room = Room()
    room.scan(3)
    room.hole_rad = (0.0, radians(45))
    room.scan()
    room.now_s += 0.1
    assert room.scan().ahead_rad > 0.0, "5 Hz: two scans"
    room.memory = SectorMemory()
    room.hole_rad = None
    room.scan(3)
    room.hole_rad = (0.0, radians(45))
    room.now_s += 60.0
    assert room.scan().ahead_rad == 0.0, "one scan after a silence tells nothing yet"


def test_a_covered_lidar_is_another_rows_affair() -> None:
    room = Room()
    room.scan(3)
    room.hole_rad = (0.0, tau)
    assert room.scan(9).ahead_rad == 0.0


def test_a_lidar_with_another_number_of_bins_begins_anew() -> None:
    room = Room(360)
    room.scan(3)
    room.beams = 60
    assert room.scan().bins == 60
    assert room.memory.alive.bit_count() == 60


@given(st.integers(0, (1 << 24) - 1), st.integers(1, 24))
def test_runs_are_those_of_the_mask_and_no_bit_is_in_two(mask: int, least: int) -> None:
    found = runs(mask, 24, least)
    bits = [(first + k) % 24 for first, last in found for k in range((last - first) % 24 + 1)]
    assert len(bits) == len(set(bits))
    assert all(mask >> bit & 1 for bit in bits)
    assert all((last - first) % 24 + 1 >= least for first, last in found)
    if least == 1 and mask != (1 << 24) - 1:
        assert len(bits) == mask.bit_count()


def test_a_scan_of_few_beams_is_told_once() -> None:
    world = World().ready()
    told = [event for event in world.events if event.code == "scan_coarse"]
    assert [event.detail for event in told] == [coarse_words(0.08726646259971647)]
    assert "5 degrees between beams" in told[0].detail
    assert "0.09 m slips" in told[0].detail


def test_no_lidar_that_is_read_by_pons_is_called_coarse() -> None:
    assert COARSE_RAD > 6.2832 / 180
