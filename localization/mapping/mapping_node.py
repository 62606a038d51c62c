"""Run the mapper as localization's process: hear the wire, place scans, publish at a steady rate.

On another day's map the robot is looked for first: it stands, a scan is searched on the whole map,
and where that is sure the mapper goes on from there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np

from localization.deskew import deskew, sweep_s
from localization.global_search import is_sure
from localization.localizer_status import make_status
from localization.mapping.live_mapper import LiveMapper
from localization.odometry_integration import OdometryTrail
from wire import Odometry, keys

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.global_search import Candidate
    from localization.mapping.keyframes import Keyframe
    from localization.mapping.scan_tracker import KeyframeLink
    from wire import LocalizerTrouble, Scan
    from wire.lidar_config import LidarConfig
    from wire.session import Session

    Floats = NDArray[np.float64]

STATE_S = 0.2
"""Between two words on what the mapper does, where nothing changed."""
FIND_S = 1.0
"""Between two searches for the robot on another day's map."""


class BuilderPort(Protocol):
    """Build the map beside the loop: in a process of its own, or in a test's time."""

    def add(self, link: KeyframeLink) -> None:
        """Take a keyframe."""

    def poses(self) -> Floats | None:
        """Return where keyframes are now, if a loop moved them since the last call."""

    def find(self, points_m: Floats) -> None:
        """Look for the pose from which a scan was taken."""

    def found(self) -> tuple[Candidate, ...] | None:
        """Return the candidates of a search, once there is an answer."""


class MappingNode:
    """Connect a mapper and its builder to the wire."""

    def __init__(
        self,
        lidar: LidarConfig,
        map_id: str,
        builder: BuilderPort,
        session: Session,
        boot_id: str,
        known: Sequence[Keyframe] = (),
    ) -> None:
        self._lidar, self._map_id, self._builder, self._known = lidar, map_id, builder, known
        self._mapper = None if known else LiveMapper(lidar, map_id)
        self._trail = OdometryTrail()
        self._candidates: tuple[Candidate, ...] = ()
        self._asked_s = float("-inf")
        self._boot_id, self._seq = boot_id, 0
        self._said = ""
        self._said_s = float("-inf")
        self._scan = session.subscriber(keys.SCAN)
        self._odom = session.subscriber(keys.ODOM)
        self._out = session.publisher(keys.LOCALIZATION)
        self._state = session.publisher(keys.LOC_STATE)

    def turn(self, now_s: float) -> None:
        """Take what came, place a scan, say where ``odom`` is."""
        odometry = [one for one in self._odom.drain().items if isinstance(one, Odometry)]
        scan = self._scan.newest()
        if self._mapper is None:
            self._look(odometry, scan, now_s)
        else:
            self._map(self._mapper, odometry, scan, now_s)
        self._say_state(now_s)

    def _map(
        self, mapper: LiveMapper, odometry: list[Odometry], scan: Scan | None, now_s: float
    ) -> None:
        for one in odometry:
            mapper.hear_odometry(one)
        if scan is not None:
            mapper.hear_scan(scan)
        poses = self._builder.poses()
        if poses is not None:
            mapper.hear_poses(poses)
        mapper.work()
        for link in mapper.take_links():
            self._builder.add(link)
        answer = mapper.answer(now_s)
        if answer is not None:
            self._out.put(answer)

    def _look(self, odometry: list[Odometry], scan: Scan | None, now_s: float) -> None:
        """Search the whole map for a scan until one place is sure."""
        for one in odometry:
            self._trail.add(one)
        found = self._builder.found()
        if found is not None:
            self._candidates = found
            if is_sure(found):
                start = np.array(found[0].pose)
                self._mapper = LiveMapper(self._lidar, self._map_id, start, self._known)
                return
        if scan is None or not now_s - self._asked_s >= FIND_S:
            return
        if self._trail.covers(scan.stamp_s, scan.stamp_s + sweep_s(scan)):
            self._asked_s = now_s
            self._builder.find(deskew(scan, self._lidar, self._trail).points_m)

    def _say_state(self, now_s: float) -> None:
        state = self._name_state(now_s)
        if state == self._said and now_s - self._said_s < STATE_S:
            return
        self._said, self._said_s = state, now_s
        self._seq += 1
        score, found = 0.0, self._candidates
        if self._mapper is not None:
            score, found = self._mapper.fit, ()  # a growing map is not searched
            if state != "tracking":
                score = min(score, self._mapper.quality(now_s))
        stamp = (self._boot_id, self._seq, now_s)
        trouble: LocalizerTrouble | None = "carried_while_mapping" if state == "lost" else None
        self._state.put(make_status(state, score, found, None, stamp, trouble))

    def _name_state(self, now_s: float) -> Literal["searching", "tracking", "coasting", "lost"]:
        if self._mapper is None:
            return "searching"
        if self._mapper.is_lost:
            return "lost"
        return "tracking" if self._mapper.is_placed(now_s) else "coasting"
