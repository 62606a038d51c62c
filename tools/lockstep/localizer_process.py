"""Be the localizer's process: the real node on the bus, its search answered after a fixed time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, cast

from localization.distance_field import DistanceField
from localization.global_search import GlobalSearch, SearchArea
from localization.localizer import Localizer
from localization.node import LocalizerNode

if TYPE_CHECKING:
    from localization.global_search import Candidate
    from localization.relocation import SearchRequest
    from lockstep.bus import Port
    from lockstep.scene import LockstepScene
    from wire import Localization
    from wire.session import Session

SEARCH_S = 0.2
"""What a search of the home and its two pipes take on a busy machine."""


class PacedSearch:
    """Search in this process, and answer a fixed time later."""

    def __init__(self, field: DistanceField, lidar_m: tuple[float, float]) -> None:
        self._search, self._lidar_m = GlobalSearch(field), lidar_m
        self._answers: list[tuple[float, int, tuple[Candidate, ...]]] = []
        self.now_s = 0.0
        self.cpu_s: list[float] = []
        """Processor time of each search."""

    @property
    def trouble(self) -> None:
        """Return no trouble: it answers always."""

    def ask(self, request: SearchRequest) -> None:
        """Search now; the answer comes when its time has."""
        near, began_s = request.around, time.thread_time()
        area = None
        if near is not None:
            at = (near.x_m, near.y_m, near.yaw_rad)
            area = SearchArea(at, request.radius_m, request.any_heading, request.outline)
        found = self._search.find(request.points_m, self._lidar_m, area)
        self.cpu_s.append(time.thread_time() - began_s)
        self._answers.append((self.now_s + SEARCH_S, request.number, found))

    def answers(self) -> list[tuple[int, tuple[Candidate, ...]]]:
        """Return the answers whose time has come."""
        due = [(number, found) for at_s, number, found in self._answers if at_s <= self.now_s]
        self._answers = [answer for answer in self._answers if answer[0] > self.now_s]
        return due


class TimedLocalizer(Localizer):
    """Measure what each turn's scan work costs."""

    def __init__(self, field: DistanceField, scene: LockstepScene) -> None:
        super().__init__(field, scene.robot.lidar, scene.site.map_id)
        self.work_cpu_s: list[float] = []
        """Processor time of each turn's scan work, the search apart."""
        self.said: Localization | None = None

    def answer(self, now_s: float) -> Localization | None:
        """Answer, and keep the newest answer."""
        said = super().answer(now_s)
        self.said = said or self.said
        return said

    def work(self, now_s: float) -> None:
        """Work, and note the processor time."""
        began_s = time.thread_time()
        super().work(now_s)
        self.work_cpu_s.append(time.thread_time() - began_s)


class LocalizerProcess:
    """Compose the localizer's node on the bus, in the stand-in's place."""

    def __init__(self, scene: LockstepScene, port: Port) -> None:
        field = DistanceField.of_map(scene.site.grid)
        lidar = scene.robot.lidar
        self.localizer = TimedLocalizer(field, scene)
        self.search = PacedSearch(field, (lidar.x_m, lidar.y_m))
        self._node = LocalizerNode(self.localizer, self.search, cast("Session", port), "loc-1")

    def turn(self, now_s: float) -> None:
        """Let the node turn."""
        self.search.now_s = now_s
        self._node.turn(now_s)
