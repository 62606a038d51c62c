"""Tell the stories' common parts: a robot at rest, a drive begun, a robot that is really there.

Joins the system that a person runs with the judge that watches it. Every verdict is on the truth.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from math import hypot, inf, pi, remainder
from pathlib import Path

import psutil

from planner.site import Place, Site
from tests.e2e.judge import Judge, still
from tests.e2e.polling import until
from tests.e2e.system import ENDED, TWO_ROOM, Json, System, new_home
from wire import Mode
from wire.status import Action

REST_LIMIT_S = 20.0
_BEARABLE = (Action.NONE, Action.CAP)
"""A base without a gyro is never free of a row that caps it."""
ARM_LIMIT_S = 8.0
REFUSED = 3
"""How ``pons arm`` ends when the bridge refuses, and says why."""
FAR_M = 1.0
"""A drive shorter than this is over before a story can interrupt it."""
THERE_M = 0.25
"""Reached is 0.10 m by the robot's own pose; the stand-in's noise (sigma 0.02 m) comes on top."""
FACING_RAD = 0.25
SETTLE_S = 0.5
"""Reached is judged on the encoders; the truth is heard a period later, and bodies rock."""
STOP_LIMIT_S = 3.0
"""0.3 s to notice, a status more, 0.5 m/s at 1 m/s2 and the drive's lag make 1 s; the rest is for
a busy machine that stalls us all."""
STOP_PATH_M = 0.5
"""0.5 m/s for 0.36 s and the ramp of 0.13 m make 0.31 m, whatever the machine's clock does."""


class Robot:
    """Be one running robot, watched."""

    def __init__(self, home: Path, site: Path = TWO_ROOM, **settings: str) -> None:
        self.system = System(home, site, **settings)
        self.site = Site.load(site)
        self.judge = Judge(home)

    def start(self) -> None:
        """Start it and wait until it can take a goal."""
        self.system.start()

    def close(self) -> None:
        """End it and hold that nothing is left."""
        try:
            self.system.end()
        finally:
            self.system.destroy()
            self.judge.close()

    # Rest ---------------------------------------------------------------------------------------

    def rest(self) -> None:
        """Bring it to HOLD: armed, nothing held, no open goal, standing, ready."""
        for process in self.system.processes():
            if process.status() == psutil.STATUS_STOPPED:
                process.resume()
        self.system.until_served()
        for goal in self.system.goals():
            if goal["state"] not in ENDED:
                self.system.act(goal["id"], "cancel")
        until(self._rested, REST_LIMIT_S, "rest", self.judge.describe)

    def _rested(self) -> bool:
        status = self.judge.status
        fresh = time.monotonic() - self.judge.statuses.last_s < 0.5
        if not fresh or not self.judge.standing():
            return False
        if status.mode in (Mode.ESTOPPED, Mode.FAULT):
            self.system.operate("reset")
        elif status.mode is Mode.DISARMED:
            self.system.operate("arm")
        elif status.held is not None:
            self.system.operate("resume")
        elif (
            status.mode is Mode.HOLD
            and status.owner is not None
            and all(row.action in _BEARABLE for row in status.rows)
        ):
            return self.system.http("GET", "/readyz").status == 200
        return False

    def arm(self) -> None:
        """Arm in the shell, again as a person would while a busy machine's passing row refuses."""

        def armed() -> bool:
            done = self.system.pons("arm")
            assert done.returncode in (0, REFUSED), (done.stdout, done.stderr)
            return done.returncode == 0

        until(armed, ARM_LIMIT_S, "arm", self.judge.describe)

    # Drives -------------------------------------------------------------------------------------

    def place(self, place_id: str) -> Place:
        """Return a place of the site."""
        place = self.site.place(place_id)
        assert place is not None, f"the site has no {place_id}"
        return place

    def away_m(self, place: Place) -> float:
        """Return how far the robot really is from where a place is stood at."""
        pose = self.judge.truth.base_in_map
        return hypot(place.pose.x_m - pose.x_m, place.pose.y_m - pose.y_m)

    def elsewhere(self) -> Place:
        """Return the nearest place that is worth a drive."""
        far = [place for place in self.site.places if self.away_m(place) >= FAR_M]
        return min(far, key=self.away_m)

    def farthest(self) -> Place:
        """Return the place whose drive lasts longest: a shell's order takes seconds to start."""
        return max(self.site.places, key=self.away_m)

    def drive_off(self, place: Place | None = None) -> tuple[Place, Json]:
        """Give a goal and come back once the robot really drives."""
        chosen = place or self.elsewhere()
        goal = self.system.give(f"go to the {chosen.name.en}")
        self.judge.until_moving()
        return chosen, goal

    def arrive(self, place: Place, goal: Json, limit_s: float = 40.0) -> Json:
        """Wait for the goal's end and hold that the robot is really there."""
        ended = self.system.until_goal(goal["id"], *ENDED, limit_s=limit_s)
        assert ended["state"] == "succeeded", (ended, self.judge.describe())
        self.assert_there(place)
        return ended

    # Verdicts -----------------------------------------------------------------------------------

    def assert_there(self, place: Place) -> None:
        """Hold that the robot really stands at a place, and has touched nothing."""
        self.judge.until_standing(SETTLE_S)
        pose = self.judge.truth.base_in_map
        if place.polygon is not None:
            assert place.contains(pose.x_m, pose.y_m), (place.id, self.judge.describe())
        else:
            turned = abs(remainder(pose.yaw_rad - place.pose.yaw_rad, 2 * pi))
            assert turned < FACING_RAD, (place, pose)
        assert self.away_m(place) < THERE_M, (place.id, self.judge.describe())
        self.judge.assert_no_contact()

    def assert_stood_at(self, place: Place, began_s: float) -> None:
        """Hold that the robot really stood at a place at some time since; it may have left it."""
        stood = [truth.base_in_map for _, truth in self.judge.truths.since(began_s) if still(truth)]
        near_m = [hypot(p.x_m - place.pose.x_m, p.y_m - place.pose.y_m) for p in stood]
        assert min(near_m, default=inf) < THERE_M, (place.id, self.judge.describe())

    def assert_figures(self, goal: Json, place: Place, began_s: float) -> None:
        """Hold that the record's figures agree with the truth since the goal was given."""
        outcome, pose = goal["outcome"], self.judge.truth.base_in_map
        assert outcome["code"] == "arrived"
        assert outcome["asked"]["place"] == outcome["reached"]["place"] == place.id
        reached = outcome["reached"]
        assert hypot(reached["x_m"] - pose.x_m, reached["y_m"] - pose.y_m) < THERE_M, outcome
        driven_m = self.judge.path_m(began_s)
        assert abs(outcome["metres"] - driven_m) < 0.1 + 0.1 * driven_m, (outcome, driven_m)
        assert 0.0 < outcome["seconds"] <= time.monotonic() - began_s + 0.1
        assert outcome["limited_by"]

    def assert_stops(self, from_s: float, path_m: float = STOP_PATH_M) -> float:
        """Hold that from a moment the robot stands soon and near; return when it stood."""
        stood_s = self.judge.until_standing(max(0.05, from_s + STOP_LIMIT_S - time.monotonic()))
        driven_m = self.judge.path_m(from_s, stood_s)
        assert driven_m < path_m, (driven_m, self.judge.describe())
        self.judge.assert_no_contact()
        return stood_s


@contextmanager
def resting_in(site: Path) -> Iterator[Robot]:
    """Lend a robot of its own, at rest in a site, and hold that nothing is left of it."""
    with new_home() as folder:
        robot = Robot(Path(folder), site)
        try:
            robot.start()
            robot.rest()
            yield robot
        finally:
            robot.close()
