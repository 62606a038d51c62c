"""Show horizons of real routes to the bridge's own judge, from poses as noisy as localization's."""

from __future__ import annotations

import random
from itertools import permutations
from math import atan2

import pytest

from bridge.core.authority.leg_tracking import check_horizon
from bridge.core.geometry.fence import build_fence
from planner.navigation import LegPath, RouteLimits, RouteRequest, cut
from planner.navigation.router import Router
from planner.site import Site
from wire import Pose2

SIGMA_M = 0.02
STEP_M = 0.07  # about a tick of the mission at full speed


@pytest.mark.parametrize("name", ["home", "two_room"])
def test_no_horizon_of_any_route_is_refused(name: str, request: pytest.FixtureRequest) -> None:
    site: Site = request.getfixturevalue(name)
    record = site.fence.record
    fence = build_fence(record.map_id, record.allowed, record.keep_outs)
    router, noise = Router(site, RouteLimits()), random.Random(7)
    for a, b in list(permutations(site.places, 2))[::23]:
        path = LegPath.of(router.route(RouteRequest(a.pose, b.pose)).points, b.pose.yaw_rad)
        progress_m, final = 0.0, False
        for step in range(int(path.length_m / STEP_M) + 1):
            robot = _on(path, step * STEP_M, noise)
            horizon = cut(path, robot, progress_m)
            assert check_horizon(horizon.points, robot, 0.5, fence) == ()
            assert not horizon.off_path
            assert horizon.progress_m >= progress_m
            progress_m, final = horizon.progress_m, horizon.final
        assert final


def _on(path: LegPath, at_m: float, noise: random.Random) -> Pose2:
    index = max(i for i, along_m in enumerate(path.along_m) if along_m <= at_m)
    here, there = path.points[index], path.points[min(index + 1, len(path.points) - 1)]
    return Pose2(
        here.x_m + noise.gauss(0, SIGMA_M),
        here.y_m + noise.gauss(0, SIGMA_M),
        atan2(there.y_m - here.y_m, there.x_m - here.x_m),
    )
