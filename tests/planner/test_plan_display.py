"""What RViz may show is said as statuses come, thinned out to what one message carries."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.mission.engine import Leg
from planner.navigation import RoutePoint
from planner.plan_display import EVERY_S, PlanDisplay
from planner.site import Site
from tests.wire.examples import STATUS
from wire import PlanView, encode, keys
from wire.nav2_dialogue import MAX_SHOWN


class Shown:
    """Keep what is said, as the wire carries it."""

    def __init__(self) -> None:
        self.views: list[PlanView] = []

    def put(self, message: PlanView) -> None:
        assert len(encode(message)) <= keys.PLAN_VIEW.max_bytes
        self.views.append(message)


@pytest.mark.parametrize("count", [0, 1, 2, 255, 256, 257, 3000])
def test_a_way_of_any_length_is_shown_from_its_start_to_its_end(
    repository: Path, count: int
) -> None:
    site = Site.load(repository / "sites" / "home")
    points = tuple(RoutePoint(x / 7.0, -1.0, 0.4) for x in range(count))
    leg = Leg("m1", 1, points) if count else None
    shown, now = Shown(), [0.0]
    display = PlanDisplay(shown, lambda: leg, lambda: site.places, lambda: now[0])
    for tick in range(10):
        now[0] = tick * EVERY_S / 5
        display.offer((tick, {"type": "progress"}))
        display.offer((tick, {"type": "status", "status": STATUS}))
    first, second = shown.views
    assert (first.seq, second.seq) == (1, 2)
    assert len(first.path) <= MAX_SHOWN
    assert {place.name for place in first.places} == {place.name.en for place in site.places}
    if count:
        ends = [(round(one.x_m, 3), one.y_m) for one in (points[0], points[-1])]
        assert [first.path[0], first.path[-1]] == ends
        assert first.mission == "m1"
    else:
        assert (first.path, first.mission) == ((), None)
    display.close()
