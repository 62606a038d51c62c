"""Draw homes and frames: allowed, repeatable, apart, and with boxes where things are."""

from __future__ import annotations

from random import Random

import cv2
import numpy as np
import pytest

from planner.perception.detect.detections import MAX_OVERLAP
from planner.perception.detect.detector import KEY as KEY_READ
from planner.perception.detect.detector import MIN_SCORE as BELIEVED
from planner.settings.vision import VisionSettings
from sim.camera import Appearance, Renderer
from sim.camera.scene import instances
from sim.site import Home
from sim.site.classes import CLASSES as OF_THE_SIMULATOR
from sim.site.plan import solids
from tests.known import known
from tools.train.boxes import boxes, hulls, whole_box
from tools.train.budget import CLASSES, MIN_SCORE, SAME
from tools.train.evaluation import KEY as KEY_WRITTEN
from tools.train.frames import home_frames
from tools.train.homes import drawn_home
from tools.train.views import CLEAR_M, Views, targets
from wire import CameraConfig, Pose2

Whole = tuple[float, float, float, float] | None


@pytest.fixture(scope="module")
def home() -> Home:
    """Return a home that was drawn once."""
    return drawn_home("train", 5)


def test_classes_and_least_score_are_those_of_simulator_and_planner() -> None:
    assert CLASSES == OF_THE_SIMULATOR
    assert VisionSettings().min_score is None
    assert BELIEVED == MIN_SCORE
    assert KEY_READ == KEY_WRITTEN
    assert MAX_OVERLAP == SAME


def test_homes_are_repeatable_and_those_never_shown_are_others(home: Home) -> None:
    assert home == drawn_home("train", 5)
    assert home not in (drawn_home("train", 6), drawn_home("unseen", 5))
    assert targets(home)


def test_a_bare_home_holds_nothing_of_ours() -> None:
    home = drawn_home("bare", 1)
    assert home.furniture
    assert not targets(home)


def test_a_camera_stands_where_a_robot_can(home: Home) -> None:
    views, random = Views(home), Random(1)
    for _ in range(20):
        pose = views.draw_pose(random)
        assert min(s.shape.distance(pose.x_m, pose.y_m) for s in solids(home)) >= CLEAR_M


def test_frames_are_repeatable_and_boxes_lie_in_them(home: Home) -> None:
    frames = home_frames(home, "x", 2)
    again = home_frames(home, "x", 2)
    assert [frame.jpeg for frame in frames] == [frame.jpeg for frame in again]
    for frame in frames:
        picture = known(cv2.imdecode(np.frombuffer(frame.jpeg, np.uint8), cv2.IMREAD_COLOR))
        assert picture.shape == (240, 320, 3)
        low, high = frame.things[:, 1:3], frame.things[:, 3:5]
        assert (low >= 0).all()
        assert (high <= (320, 240)).all()
        assert (low < high).all()


@pytest.mark.parametrize(
    ("pixels", "whole", "asked"),
    [
        ((100, 140, 50, 90), (100.0, 50.0, 140.0, 90.0), 1),
        ((100, 104, 50, 54), None, 1),
        ((100, 103, 50, 90), None, -1),
        ((100, 110, 50, 90), (60.0, 50.0, 100.0, 90.0), 1),
        ((100, 109, 50, 90), (60.0, 50.0, 100.0, 90.0), -1),
        ((100, 140, 50, 90), (100.0, 50.0, 340.0, 190.0), -1),
    ],
)
def test_enough_of_a_thing_must_be_seen(
    pixels: tuple[int, int, int, int], whole: Whole, asked: int
) -> None:
    ids = np.zeros((240, 320), np.int32)
    x0, x1, y0, y1 = pixels
    ids[y0:y1, x0:x1] = 7
    ids[:10, :10] = 8
    labels = {7: ("mug", "cup"), 8: ("wardrobe", "none"), 9: ("nowhere", "ball")}
    rows = boxes(ids, labels, lambda thing: whole if thing == "mug" else None)
    assert [tuple(row) for row in rows] == [(CLASSES.index("cup"), x0, y0, x1, y1, asked)]


def test_an_unhidden_thing_fills_the_box_of_its_hull(home: Home) -> None:
    camera, look = CameraConfig(), Appearance()
    renderer, bounds = Renderer(home, camera, look), hulls(instances(home, look))
    views, random, shares = Views(home), Random(2), []
    for _ in range(6):
        base_in_map = views.draw_pose(random)
        frame = renderer.render(base_in_map)
        for number in np.unique(frame.ids):
            thing, class_id = renderer.labels.get(int(number), ("", "none"))
            whole = whole_box(bounds[thing], camera, base_in_map) if class_id != "none" else None
            if whole is not None:
                down, across = np.nonzero(frame.ids == number)
                seen = (across.min(), down.min(), across.max() + 1, down.max() + 1)
                assert whole[0] - 1.5 <= seen[0]
                assert seen[2] <= whole[2] + 1.5
                assert whole[1] - 1.5 <= seen[1]
                assert seen[3] <= whole[3] + 1.5
                area = (whole[2] - whole[0]) * (whole[3] - whole[1])
                shares.append((seen[2] - seen[0]) * (seen[3] - seen[1]) / max(area, 1.0))
    # Many things are half hidden; a hull that is far larger than its thing would show in all.
    assert max(shares) > 0.75


def test_what_reaches_behind_the_camera_has_no_known_box(home: Home) -> None:
    hull = next(iter(hulls(instances(home, Appearance())).values()))
    assert whole_box(hull, CameraConfig(), Pose2(hull.pose.x_m, hull.pose.y_m, 0.0)) is None
