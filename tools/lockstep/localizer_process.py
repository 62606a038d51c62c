"""Be the localizer's process: scans and odometry in, its search answered after a fixed time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch
from localization.localizer import Localizer
from wire import Localization, Odometry, keys

if TYPE_CHECKING:
    from localization.global_search import Candidate
    from localization.relocation import SearchRequest
    from tools.lockstep.bus import Port
    from tools.lockstep.scene import LockstepScene

SEARCH_S = 0.2
"""What a search of the home and its two pipes take on a busy machine."""


class LocalizerProcess:
    """Connect a localizer to the bus, in the stand-in's place."""

    def __init__(self, scene: LockstepScene, port: Port) -> None:
        field = DistanceField.of_map(scene.site.grid)
        lidar = scene.robot.lidar
        self._lidar_m = (lidar.x_m, lidar.y_m)
        self.localizer = Localizer(field, lidar, scene.site.map_id)
        self._search = GlobalSearch(field)
        self._odometry = port.subscriber(keys.ODOM)
        self._scan = port.subscriber(keys.SCAN)
        self._out = port.publisher(keys.LOCALIZATION)
        self._answers: list[tuple[float, int, tuple[Candidate, ...]]] = []
        self.said: Localization | None = None
        self.work_cpu_s: list[float] = []
        """Processor time of each turn's scan work, the search apart."""
        self.search_cpu_s: list[float] = []

    def turn(self, now_s: float) -> None:
        """Take what came, use a scan, say where ``odom`` is."""
        for odometry in self._odometry.drain().items:
            if isinstance(odometry, Odometry):
                self.localizer.hear_odometry(odometry)
        scan = self._scan.newest()
        if scan is not None:
            self.localizer.hear_scan(scan)
        while self._answers and self._answers[0][0] <= now_s:
            _, number, found = self._answers.pop(0)
            self.localizer.hear_candidates(number, found)
        began_s = time.thread_time()
        self.localizer.work(now_s)
        self.work_cpu_s.append(time.thread_time() - began_s)
        request = self.localizer.search_request()
        if request is not None:
            began_s = time.thread_time()
            found = self._find(request)
            self.search_cpu_s.append(time.thread_time() - began_s)
            self._answers.append((now_s + SEARCH_S, request.number, found))
        answer = self.localizer.answer(now_s)
        if answer is not None:
            self.said = answer
            self._out.put(answer)

    def _find(self, request: SearchRequest) -> tuple[Candidate, ...]:
        near = request.around
        if near is None:
            return self._search.everywhere(request.points_m, self._lidar_m)
        pose = np.array((near.x_m, near.y_m, near.yaw_rad))
        return self._search.around(request.points_m, self._lidar_m, pose, request.radius_m)
