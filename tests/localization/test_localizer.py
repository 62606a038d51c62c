"""The localizer's laws: fresh, honest, lost in time, found again, and never a silent jump."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from math import hypot, pi
from typing import TypeVar

import pytest

from localization.global_search import GlobalSearch, SearchArea
from localization.localizer import (
    ANSWER_S,
    OLDEST_S,
    Localizer,
    LocalizerState,
)
from localization.quality import POOR_QUALITY
from tests.localization.rooms import (
    MAP_ID,
    ROOM,
    Boxes,
    cast,
    field_of,
    odometry_of,
    scan_of,
)
from wire import (
    IDENTITY,
    STILL,
    Localization,
    Pose2,
    PoseHint,
    Scan,
    Twist2,
    between,
    compose,
    wrap,
)
from wire.lidar_config import LidarConfig

FIELD = field_of(ROOM, 6.0, 4.0)
SEARCH = GlobalSearch(FIELD)
START = Pose2(2.6, 1.7, 0.4)
ELSEWHERE = Pose2(5.0, 3.1, -2.0)
Way = Callable[[float], Pose2]
Ranges = tuple[float | None, ...]


def hint(hint_id: str, pose: Pose2, radius_m: float, *, any_heading: bool = False) -> PoseHint:
    return PoseHint(id=hint_id, pose=pose, radius_m=radius_m, any_heading=any_heading)


class Drive:
    """Be lidar, odometry and search process; one turn is 0.05 s, a scan comes with every other."""

    def __init__(self) -> None:
        self.search, self.localizer = SEARCH, Localizer(FIELD, LidarConfig(), MAP_ID)
        self.now_s = 100.0
        self.turns = 0
        self.true = self.wheels = START
        self.odom_id = "bridge-1"
        self.boxes: Boxes = ROOM
        self.blind = False
        self.searching = True
        self.said: list[Localization] = []
        self.errors_m: list[float] = []
        """Of each word that was said."""
        self.yaw_rate_radps: float | None = None

    def make_scan(self, ranges: Ranges) -> Scan:
        """Return the scan of what a lidar measures; a worse lidar is a subclass."""
        return scan_of(ranges, self.now_s, self.turns)

    def turn(self, step: Pose2 = IDENTITY, wheels: Pose2 | None = None) -> Localization | None:
        """Move by a step (wheels may say another) and let 0.05 s pass."""
        self.true = compose(self.true, step)
        self.wheels = compose(self.wheels, step if wheels is None else wheels)
        self.now_s += 0.05
        self.turns += 1
        twist = STILL if step == IDENTITY else Twist2(step.x_m / 0.05, step.yaw_rad / 0.05)
        base_in_odom = between(START, self.wheels)
        localizer = self.localizer
        localizer.hear_odometry(
            odometry_of(
                self.now_s,
                base_in_odom,
                odom_id=self.odom_id,
                twist=twist,
                gyro_radps=self.yaw_rate_radps,
            )
        )
        if self.turns % 2 == 0 and not self.blind:
            # A millimetre of noise: a lidar that repeats itself is taken for stuck.
            ranges = tuple(
                None if r is None else round(r + 0.001 * ((self.turns + i) % 3 - 1), 3)
                for i, r in enumerate(cast(self.boxes, self.true))
            )
            localizer.hear_scan(self.make_scan(ranges))
        localizer.work(self.now_s)
        request = localizer.search_request()
        if request is not None and self.searching:
            near = request.around
            area = None
            if near is not None:
                at = (near.x_m, near.y_m, near.yaw_rad)
                area = SearchArea(at, request.radius_m, request.any_heading, request.outline)
            found = self.search.find(request.points_m, (0.0, 0.0), area)
            localizer.hear_candidates(request.number, found)
        answer = localizer.answer(self.now_s)
        if answer is not None:
            self.said.append(answer)
            self.errors_m.append(self.error_m())
        return answer

    def run(self, seconds: float, step: Pose2 = IDENTITY) -> None:
        for _ in range(round(seconds / 0.05)):
            self.turn(step)

    def error_m(self) -> float:
        base = compose(self.said[-1].odom_in_map, between(START, self.wheels))
        return hypot(base.x_m - self.true.x_m, base.y_m - self.true.y_m)


D = TypeVar("D", bound=Drive)


def settle(drive: D) -> D:
    drive.run(0.5)
    assert drive.localizer.state is LocalizerState.TRACKING
    return drive


def fork(drive: D, *shared: object) -> D:
    """Return a drive of one's own that goes on from here; map and search are shared."""
    return deepcopy(drive, {id(one): one for one in (FIELD, SEARCH, *shared)})


@pytest.fixture(scope="session")
def settled_drive() -> Drive:
    """Return a drive that has found itself: that search is most of many a test. Fork it."""
    return settle(Drive())


@pytest.fixture
def drive(settled_drive: Drive) -> Drive:
    return fork(settled_drive)


def test_it_finds_itself_at_start_and_says_nothing_before() -> None:
    drive = Drive()
    assert drive.turn() is None
    drive.searching = False
    drive.run(0.5)
    assert drive.said == []
    assert drive.localizer.state is LocalizerState.SEARCHING
    drive.searching = True
    drive.run(ANSWER_S + 2.0)  # the first question was never answered
    assert drive.error_m() < 0.03
    assert drive.said[-1].quality > 0.9


def test_it_follows_a_drive_with_wheels_that_are_wrong(drive: Drive) -> None:
    for turn in range(80):
        step = Pose2(0.02, 0.0, 0.04)
        drive.turn(step, Pose2(step.x_m * 1.05, 0.0, step.yaw_rad * 0.95))
        assert drive.error_m() < 0.04, turn
    assert min(word.quality for word in drive.said) > 0.8
    assert len({word.seq for word in drive.said}) == len(drive.said)


def test_words_carry_the_newest_odometry_and_old_odometry_none(drive: Drive) -> None:
    word = drive.turn()
    assert word is not None
    assert (word.stamp_s, word.odom_id, word.map_id) == (drive.now_s, "bridge-1", MAP_ID)
    assert drive.localizer.answer(drive.now_s) is None, "nothing new"
    drive.localizer.hear_odometry(odometry_of(drive.now_s + 0.02, IDENTITY))
    assert drive.localizer.answer(drive.now_s + 0.02 + OLDEST_S + 0.01) is None


def test_without_scans_quality_fades_with_time_and_with_metres(drive: Drive) -> None:
    drive.blind = True
    drive.run(0.9)
    assert drive.said[-1].quality >= POOR_QUALITY
    drive.run(0.4)
    assert drive.said[-1].quality < POOR_QUALITY
    drive.blind = False
    drive.run(0.3)
    assert drive.said[-1].quality > 0.9, "nobody moved it: the next scan fits"
    drive.blind = True
    drive.run(0.6, Pose2(0.05, 0.0, 0.0))
    assert drive.said[-1].quality < POOR_QUALITY


def test_without_scans_nothing_is_said_to_be_tracked(drive: Drive) -> None:
    assert drive.localizer.report_state(drive.now_s) == (
        LocalizerState.TRACKING,
        drive.localizer.score,
    )
    drive.blind = True
    scores = []
    for _ in range(60):
        word = drive.turn()
        state, score = drive.localizer.report_state(drive.now_s)
        scores.append(score)
        assert word is not None
        assert (state is LocalizerState.TRACKING) == (word.quality >= POOR_QUALITY)
        assert state is LocalizerState.TRACKING or score == word.quality
    assert drive.localizer.report_state(drive.now_s)[0] is LocalizerState.COASTING
    assert scores == sorted(scores, reverse=True)
    assert scores[-1] == 0.0
    drive.blind = False
    drive.run(0.3)
    assert drive.localizer.report_state(drive.now_s) == (
        LocalizerState.TRACKING,
        drive.localizer.score,
    )


def test_carried_away_it_is_lost_within_half_a_second_and_found_within_two(drive: Drive) -> None:
    drive.true = ELSEWHERE
    began = len(drive.said)
    drive.run(2.0)
    words = drive.said[began:]
    poor = next(i for i, word in enumerate(words) if word.quality < POOR_QUALITY)
    assert poor <= 10
    assert drive.error_m() < 0.03
    assert drive.localizer.state is LocalizerState.TRACKING


def test_what_an_older_search_found_is_no_candidate_once_it_is_lost(drive: Drive) -> None:
    assert drive.localizer.candidates
    drive.searching = False
    drive.true = ELSEWHERE
    drive.run(1.0)
    assert drive.localizer.state is LocalizerState.LOST
    assert drive.localizer.candidates == ()


def test_every_displacement_is_declared_by_poor_words(drive: Drive) -> None:
    for there in (ELSEWHERE, START, Pose2(START.x_m + 0.25, START.y_m, START.yaw_rad)):
        drive.true = there
        drive.run(2.5)
        assert drive.error_m() < 0.03
    good: Localization | None = None
    at = between(START, drive.wheels)
    for word in drive.said:
        if word.quality < POOR_QUALITY:
            good = None
            continue
        if good is not None:
            before, after = compose(good.odom_in_map, at), compose(word.odom_in_map, at)
            assert hypot(after.x_m - before.x_m, after.y_m - before.y_m) <= 0.1
            assert abs(wrap(after.yaw_rad - before.yaw_rad)) <= 0.087
        good = word


def test_a_person_in_view_is_no_reason_to_be_lost(drive: Drive) -> None:
    drive.boxes = (*ROOM, (3.3, 2.2, 3.7, 2.5), (1.6, 0.9, 1.9, 1.2))
    drive.run(1.0)
    assert drive.localizer.state is LocalizerState.TRACKING
    assert drive.error_m() < 0.03
    assert drive.said[-1].quality >= POOR_QUALITY


def test_a_stuck_or_covered_lidar_says_nothing(drive: Drive) -> None:
    ranges = cast(ROOM, START)
    for _ in range(30):
        drive.now_s += 0.05
        drive.localizer.hear_odometry(odometry_of(drive.now_s, IDENTITY))
        drive.localizer.hear_scan(scan_of(ranges, drive.now_s))
        drive.localizer.work(drive.now_s)
    word = drive.localizer.answer(drive.now_s)
    assert word is not None
    assert word.quality < POOR_QUALITY
    few = (None,) * 160 + ranges[:20]
    drive.localizer.hear_scan(scan_of(few, drive.now_s))
    drive.localizer.work(drive.now_s)
    assert drive.localizer.state is LocalizerState.TRACKING, "no scan contradicts"


def test_another_odometry_goes_on_from_the_place(drive: Drive) -> None:
    drive.odom_id = "bridge-2"
    drive.run(0.5)
    assert drive.said[-1].odom_id == "bridge-2"
    assert drive.error_m() < 0.03
    assert drive.localizer.state is LocalizerState.TRACKING


@pytest.mark.parametrize("stamp_s", [0.0, 1e9, 102.0])
def test_scans_of_other_times_are_dropped(drive: Drive, stamp_s: float) -> None:
    drive.localizer.hear_scan(scan_of(cast(ROOM, Pose2(1.0, 1.5, pi)), stamp_s))
    drive.localizer.work(drive.now_s)
    assert drive.localizer.state is LocalizerState.TRACKING
    drive.run(0.3)
    assert drive.error_m() < 0.03
