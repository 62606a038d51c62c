"""Point by a model at a real socket; the planner projects it: floor in sight or a code.

The whole way of a pixel answer: endpoint, judge, the missions' door, the pose at which the picture
was taken, depth or floor, walls and fence. Lies included.
"""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Iterator
from math import hypot, pi
from pathlib import Path
from typing import Any, cast

import pytest

from maps.grid import FREE
from planner.brain.endpoint import EndpointBrain
from planner.mission.effects import AskEyes
from planner.mission.perception_requests import EyeDoor
from planner.mission.skills.perception import ImageAnswer
from planner.perception import Detection, LookSnapshot, Sight
from planner.perception.interfaces import Eyes, MapPoint, Picture
from planner.perception.pose_buffer import Stance
from planner.perception.projection import FARTHEST_M, View, point_on_map
from planner.plan import Language
from planner.settings import ModelSettings
from planner.site import Site
from tests.conftest import ROOT
from tests.planner.brain.pictures import jpeg
from tests.pons.mock_llm.mocks import RunningMock, running_mock
from tools.lockstep.truth_detector import header_of
from wire import CameraConfig, Image, Pose2

SITE = Site.load(ROOT / "sites" / "two_room")
CAMERA = CameraConfig()
TAKEN = Pose2(1.5, 0.8, pi / 2)
"""In the kitchen, looking through the door."""
CUP = Detection("cup", 0.9, (150.0, 200.0, 170.0, 220.0), "red", None)


class Standing:
    """Be eyes with one picture, which was taken elsewhere than where the robot stands now."""

    def __init__(self, taken: Pose2) -> None:
        header = header_of(CAMERA, 7, 0.0)
        self.picture = self.looked_picture = Picture(
            Image(header=header, data=jpeg(header.width, header.height)), None, 0
        )
        look = LookSnapshot(7, 0.0, taken, header.width, header.height, (CUP,))
        self.sight = Sight(look)
        self._view = View(header, CAMERA, Stance(taken))

    async def fresh(self) -> Picture:
        return self.picture

    async def spot(self, picture: Picture, x: float, y: float) -> MapPoint:
        assert picture is self.picture
        return point_on_map(self._view, SITE, x, y, None)


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    """Serve one mock for the module's tests."""
    with running_mock() as served:
        yield served


def points(mock: RunningMock, home: Path, count: int, taken: Pose2 = TAKEN) -> list[ImageAnswer]:
    """Ask a model for a point so many times, as a mission does."""

    async def asked() -> list[ImageAnswer]:
        model = EndpointBrain(ModelSettings(url=mock.url, name="m", timeout_s=5.0), home)
        door = EyeDoor(cast("Eyes", Standing(taken)), model.looker())
        ask = AskEyes("g1", 1, Language.EN, words="the cup", point=True)
        answers = [(await door.ask(ask)).answer for _ in range(count)]
        await model.close()
        return answers

    return asyncio.run(asked())


def test_a_point_is_projected_from_where_the_picture_was_taken(
    mock: RunningMock, tmp_path: Path
) -> None:
    mock.set()
    for taken, turn in ((TAKEN, 1.0), (Pose2(1.5, 2.4, -pi / 2), -1.0)):
        (answer,) = points(mock, tmp_path, 1, taken)
        assert answer.at is not None
        x_m, y_m, z_m = answer.at
        assert x_m == pytest.approx(1.5, abs=0.05)
        assert 0.8 < turn * (y_m - taken.y_m) < 2.0, "ahead of that pose, on the floor"
        assert z_m == pytest.approx(0.0, abs=0.05)


def test_wherever_a_model_points_it_is_floor_in_sight_or_a_code(
    mock: RunningMock, tmp_path: Path
) -> None:
    mock.set(fault="hallucinated_point")
    ended: Counter[str] = Counter()
    for answer in points(mock, tmp_path, 60):
        if answer.at is None:
            ended[str(answer.failure)] += 1
            continue
        x_m, y_m, _ = answer.at
        ended["floor"] += 1
        assert SITE.grid.at(x_m, y_m) == FREE
        assert SITE.fence.allows(x_m, y_m)
        assert hypot(x_m - TAKEN.x_m, y_m - TAKEN.y_m) <= FARTHEST_M
    assert set(ended) <= {"floor", "point_on_wall", "point_off_map", "point_no_depth",
                          "point_too_far"}  # fmt: skip
    assert ended["floor"] > 3
    assert ended.total() - ended["floor"] > 10, "sky and walls"


@pytest.mark.parametrize(
    ("fault", "code"),
    [("point_out_of_range", "bad_plan"), ("refuses_pictures", "no_pictures")],
)
def test_what_is_no_point_comes_back_as_a_code(
    mock: RunningMock, fault: str, code: str, tmp_path: Path
) -> None:
    mock.set(fault=fault)
    (answer,) = points(mock, tmp_path, 1)
    expected: Any = ImageAnswer(failure=code)
    assert answer == expected
