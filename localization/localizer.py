"""Track the robot on a map: messages and time in, ``odom`` in ``map`` with its quality out.

Each scan is deskewed, aligned with the map from where odometry carried the last pose, and scored.
Three scans in a row that do not fit make the robot lost; a search of the whole map, in another
process, places it anew. Pure: told messages, search answers and the time; the node carries them.

Laws, which the bridge's rows rely on:

- A message is stamped with the newest odometry to which the pose was carried; its quality says
  whether the map agrees, and falls with time and metres since the last scan that did.
- No good message displaces the robot without a poor one before it (localization.jump_law).
- A search's or a person's word counts only once a scan after it fits too.
- Scans that odometry explains move the pose by what they tell beyond it (localization.pose_fusion).
"""

from __future__ import annotations

from enum import StrEnum
from math import radians
from typing import TYPE_CHECKING

from localization.deskew import PointCloud, deskew, drop_crowd, sweep_s
from localization.global_search import Candidate, is_sure
from localization.hint_dialogue import HintDialogue
from localization.jump_law import JumpLaw
from localization.odometry_integration import OdometryTrail
from localization.pose_fusion import PoseFusion, pose_array
from localization.quality import ENOUGH_SCORE, FADING_S, KEPT_SCORE, quality_of
from localization.relocation import (
    OpenSearch,
    PlacedBase,
    SearchRequest,
    is_elsewhere,
    known_place,
)
from localization.scan_fit import BETTER, FAR_BETTER, ScanFitter
from wire import Localization, Pose2, PoseHint, between, compose, inverse

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField
    from localization.scan_fit import ScanFit
    from wire import HintVerdict, Odometry, Scan
    from wire.lidar_config import LidarConfig

    Floats = NDArray[np.float64]

FEW_RETURNS = 30
"""A scan with fewer says nothing: a cover, fog, an empty hall."""
TURNED_RAD = radians(6.0)
"""Since the last scan: beyond it Gauss-Newton alone may settle beside the truth."""
ALIKE = 0.03
"""Between the matched pose and odometry's, the fused one counts where its score lacks no more."""
BAD_SCANS = 3
OLDEST_S = 0.25
"""Odometry older than this carries no pose; the bridge calls 0.3 s POSE_LOST."""
UNSEEN_M = 1.0
"""Of wheels without an accepted scan: farther, the pose is not looked for around itself."""
SLIP_M_PER_RAD = 1.0
"""Turns on which wheels and gyro disagree make the carried pose as doubtful as metres do."""
SEARCH_PAUSE_S, DOUBT_SEARCH_PAUSE_S = 0.5, 2.0
"""Between searches of the whole map: while lost; while a pose is kept with a poor score."""
ANSWER_S = 20.0
"""A search that has not answered by then never will; its client waits for 18 s."""
OLD_SCAN_S = 0.5


class LocalizerState(StrEnum):
    """Name what the localizer does."""

    SEARCHING = "searching"  # no pose since start
    TRACKING = "tracking"
    COASTING = "coasting"  # the newest scans did not fit, or say nothing
    LOST = "lost"


class Localizer:
    """Hold one robot's pose in one map."""

    def __init__(self, field: DistanceField, lidar: LidarConfig, map_id: str) -> None:
        self._lidar, self._map_id = lidar, map_id
        self._fitter = ScanFitter(field, (lidar.x_m, lidar.y_m))
        self._trail = OdometryTrail()
        self._odometry: Odometry | None = None
        self._scan: Scan | None = None
        self._taken: Scan | None = None
        """The newest scan that was used; its like is not used again."""
        self.state = LocalizerState.SEARCHING
        self.score = 0.0
        """Of the newest scan at the tracked pose."""
        self.candidates: tuple[Candidate, ...] = ()
        """What the newest search found, best first; none once a pose is lost, until one answers."""
        self._placed: PlacedBase | None = None
        self._trial: tuple[PlacedBase, PoseHint | None] | None = None
        self._accepted_score = 0.0
        self._accepted_at = (0.0, 0.0, 0.0)
        """Stamp [s], metres of wheels and slip [rad] at the last accepted scan."""
        self._blind_axis_m = 0.0
        self._fusion = PoseFusion()
        self._spread_at = (0.0, 0.0)
        """Metres of wheels and slip [rad] at the last scan that was fitted."""
        self._bad = 0
        self._open: OpenSearch | None = None
        self._searched_s = -SEARCH_PAUSE_S
        self._request: SearchRequest | None = None
        self._requests = 0
        self._hints = HintDialogue()
        self._used_s: float | None = None  # stamp of the newest scan that says something
        self._jump_law = JumpLaw()
        self._said_s: float | None = None
        self._seq = 0

    # Messages -------------------------------------------------------------------------------

    def hear_odometry(self, odometry: Odometry) -> None:
        """Take the bridge's odometry; another odom_id is another frame and starts anew."""
        if self._odometry is not None and odometry.odom_id != self._odometry.odom_id:
            self._change_odometry()
        self._odometry = odometry
        self._trail.add(odometry)

    def hear_scan(self, scan: Scan) -> None:
        """Keep a scan until odometry covers it; a newer one takes its place."""
        self._scan = scan

    def hear_hint(self, hint: PoseHint) -> None:
        """Take a person's word on where the robot is; the same id again is the same hint."""
        if self._hints.hear(hint, self._odometry, has_scan=self._taken is not None):
            self._open = None

    def hear_candidates(self, number: int, candidates: tuple[Candidate, ...]) -> None:
        """Take a search's answer; an answer to a question that is not open is ignored."""
        search = self._open
        if search is None or search.request.number != number:
            return
        self._open = None
        self.candidates = candidates
        best, place = candidates[0] if candidates else None, None
        if self._placed is not None and self._unseen_m() <= UNSEEN_M:
            place = known_place(self._placed, candidates, search.carried)
        fits, place = place is not None or is_sure(candidates), place or best
        if search.hint is not None:
            # A pose that scans confirm yields only to one that they confirm as well.
            least = self.score - BETTER if self.state is LocalizerState.TRACKING else ENOUGH_SCORE
            if best is None or best.score < max(ENOUGH_SCORE, least):
                fits = False
                self._hints.settle("does_not_fit", best.score if best else 0.0)
            elif not fits:  # a room that looks alike from its other end
                self._hints.settle("ambiguous", best.score)
        elif self._placed is not None and self.state is not LocalizerState.LOST:
            least, place = self.score + FAR_BETTER, best
            fits = is_elsewhere(self._placed, candidates, search.carried, least)
            self.state = LocalizerState.LOST if fits else self.state
        if fits and place is not None:
            self._trial = (PlacedBase(Pose2(*place.pose), search.carried), search.hint)

    def search_request(self) -> SearchRequest | None:
        """Return the question for the search process, once; None while there is none."""
        request, self._request = self._request, None
        return request

    # Scans ----------------------------------------------------------------------------------

    def work(self, now_s: float) -> None:
        """Use the newest scan, as soon as odometry covers it."""
        self._drop_dead_search(now_s)
        scan, newest = self._scan, self._trail.newest
        if scan is None or newest is None:
            return
        end_s = scan.stamp_s + sweep_s(scan)
        if newest.stamp_s < end_s <= newest.stamp_s + OLD_SCAN_S:
            return  # its odometry is on the way
        self._scan = None
        taken, self._taken = self._taken, scan
        fresh = newest.stamp_s - scan.stamp_s <= OLD_SCAN_S
        if not fresh or not self._trail.covers(scan.stamp_s, end_s):
            return
        if taken is not None and taken.ranges_m == scan.ranges_m:
            return  # a lidar that is stuck repeats itself to the millimetre; noise never does
        whole = deskew(scan, self._lidar, self._trail, self._fitter.range_scale.value)
        cloud = drop_crowd(whole)
        if len(cloud.points_m) >= FEW_RETURNS:
            self._use(cloud, now_s)
        elif len(whole.points_m) >= FEW_RETURNS and self._placed is not None:
            self._miss()

    def _use(self, cloud: PointCloud, now_s: float) -> None:
        self._used_s, carried = cloud.stamp_s, self._trail.at(cloud.stamp_s)
        if self._trial is not None and self._try_answer(cloud, carried):
            return
        if self._hints.pending is not None and self._open is None:
            self._ask(cloud, carried, now_s, self._hints.pending)
        if self._placed is None or self.state is LocalizerState.LOST:
            self._search(cloud, carried, now_s)
            return
        predicted = pose_array(self._placed.at(carried))
        turned_rad = abs(between(self._placed.carried, carried).yaw_rad)
        self._carry_spread(cloud, turned_rad)
        fit = self._fitter.near(cloud, predicted, self._fusion, turned=turned_rad > TURNED_RAD)
        self.score = fit.score
        if fit.score >= KEPT_SCORE:
            self._accept(cloud, self._fuse(cloud, predicted, fit), carried, fit)
            if fit.score < ENOUGH_SCORE:  # moved furniture, or somebody moved the robot
                self._search(cloud, carried, now_s, DOUBT_SEARCH_PAUSE_S)
            return
        if self._miss():
            self._search(cloud, carried, now_s)

    def _miss(self) -> bool:
        """Count a scan that does not fit, and tell whether the robot is lost."""
        self._bad += 1
        lost = self._bad >= BAD_SCANS or self._unseen_m() > UNSEEN_M
        self.state = LocalizerState.LOST if lost else LocalizerState.COASTING
        self.candidates = () if lost else self.candidates
        return lost

    def _carry_spread(self, cloud: PointCloud, turned_rad: float) -> None:
        metres, slip_rad = self._trail.counters_at(cloud.stamp_s)
        last_m, last_slip_rad = self._spread_at
        self._spread_at = metres, slip_rad
        slipped_rad = max(0.0, slip_rad - last_slip_rad)
        self._fusion.carry(max(0.0, metres - last_m), turned_rad, slipped_rad)

    def _fuse(self, cloud: PointCloud, predicted: Floats, fit: ScanFit) -> Floats:
        """Return the pose between the carried and the matched one, or the matched one.

        That is where the scan tells the two apart: then odometry was wrong.
        """
        fused = self._fusion.fuse(predicted, fit.pose, fit.information)
        if self._fitter.score(cloud, fused) >= fit.score - ALIKE:
            return fused
        self._fusion.restart()
        return fit.pose

    def _accept(self, cloud: PointCloud, pose: Floats, carried: Pose2, fit: ScanFit) -> None:
        placed = PlacedBase(Pose2(*pose.tolist()), carried)
        last, self._placed = self._placed, placed
        held = not fit.free_axis.any()
        if held or last is None or self.state is not LocalizerState.TRACKING:
            self._blind_axis_m = 0.0
        else:
            x_m, y_m = placed.in_map.x_m - last.in_map.x_m, placed.in_map.y_m - last.in_map.y_m
            self._blind_axis_m += abs(float(fit.free_axis @ (x_m, y_m)))
        self.state, self.score, self._accepted_score = LocalizerState.TRACKING, fit.score, fit.score
        self._accepted_at = (cloud.stamp_s, *self._trail.counters_at(cloud.stamp_s))
        self._bad = 0

    # Searches -------------------------------------------------------------------------------

    def _search(
        self, cloud: PointCloud, carried: Pose2, now_s: float, pause_s: float = SEARCH_PAUSE_S
    ) -> None:
        if self._open is None and now_s - self._searched_s >= pause_s:
            self._ask(cloud, carried, now_s, None)

    def _ask(self, cloud: PointCloud, carried: Pose2, now_s: float, hint: PoseHint | None) -> None:
        self._requests += 1
        self._searched_s = now_s
        self._request = SearchRequest.of_hint(self._requests, cloud.points_m, hint)
        self._open = OpenSearch(self._request, carried, now_s, hint)

    def _try_answer(self, cloud: PointCloud, carried: Pose2) -> bool:
        """Judge a search's pose by a scan that the search did not have."""
        if self._trial is None:
            return False
        (placed, hint), self._trial = self._trial, None
        fit = self._fitter.align(cloud, pose_array(placed.at(carried)))
        fits = fit.score >= ENOUGH_SCORE
        if fits:
            self._blind_axis_m = 0.0
            self._fusion.restart()
            self._accept(cloud, fit.pose, carried, fit)
        if hint is not None:
            self._hints.settle("accepted" if fits else "does_not_fit", fit.score)
        return fits

    def _drop_dead_search(self, now_s: float) -> None:
        if self._open is not None and now_s - self._open.asked_s > ANSWER_S:
            self._open = None
            self._hints.settle("no_answer")
        if self._hints.pending is not None and self._is_blind(now_s):
            self._open = self._trial = None
            self._hints.settle("no_scan")

    def _change_odometry(self) -> None:
        """Begin another frame where the last one ended: nobody says that the robot was moved."""
        newest = self._trail.newest
        if self._placed is not None and newest is not None:
            in_map = self._placed.at(newest.carried)
            self._placed = PlacedBase(in_map, Pose2(0.0, 0.0, 0.0))
        self._trail.clear()
        self._accepted_at = (self._accepted_at[0], 0.0, 0.0)
        self._spread_at = (0.0, 0.0)
        self._open = self._trial = None
        self._hints.settle("no_answer")
        self._jump_law.clear()

    # What is said ---------------------------------------------------------------------------

    @property
    def hint_answer(self) -> HintVerdict | None:
        """Return the answer to the newest hint, once there is one."""
        return self._hints.answer

    def _is_blind(self, now_s: float) -> bool:
        return self._used_s is None or not now_s - self._used_s <= FADING_S

    def report_state(self, now_s: float) -> tuple[LocalizerState, float]:
        """Return state and score as people are told them: without scans nothing is tracked."""
        if not self._is_blind(now_s):
            return self.state, self.score
        state = LocalizerState.COASTING if self.state is LocalizerState.TRACKING else self.state
        return state, min(self.score, self._quality(now_s))

    def _quality(self, at_s: float) -> float:
        unseen_s = at_s - self._accepted_at[0]
        return quality_of(self._accepted_score, unseen_s, self._unseen_m(), self._blind_axis_m)

    def _unseen_m(self) -> float:
        newest = self._trail.newest
        if newest is None:
            return 0.0
        _, metres, slip_rad = self._accepted_at
        slipped = max(0.0, newest.slip_rad - slip_rad)
        return max(0.0, newest.travelled_m - metres) + SLIP_M_PER_RAD * slipped

    def answer(self, now_s: float) -> Localization | None:
        """Return ``odom`` in ``map`` for the newest odometry; None without a pose or news."""
        newest, odometry = self._trail.newest, self._odometry
        if newest is None or odometry is None or self._placed is None:
            return None
        if not now_s - newest.stamp_s <= OLDEST_S or newest.stamp_s == self._said_s:
            return None
        quality = 0.0
        if self.state in {LocalizerState.TRACKING, LocalizerState.COASTING}:
            quality = self._quality(newest.stamp_s)
        base_in_map = self._placed.at(newest.carried)
        odom_in_map = compose(base_in_map, inverse(newest.base_in_odom))
        odom_in_map, quality = self._jump_law.apply(odom_in_map, newest.base_in_odom, quality)
        self._said_s, self._seq = newest.stamp_s, self._seq + 1
        return Localization(
            odom_id=odometry.odom_id,
            seq=self._seq,
            stamp_s=newest.stamp_s,
            odom_in_map=odom_in_map,
            quality=quality,
            map_id=self._map_id,
        )
