"""Every class is drawn, named, and inside the outline that physics and lidar know."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sim.camera import Appearance, Frame, Renderer
from sim.site.classes import CLASSES, PERSON_HEIGHT_M, PERSON_RADIUS_M, SIZES_M
from tests.sim.camera.gallery import CAMERA, MIDDLE, hall, points
from wire import Pose2, SimThing

BOX = [5.2, 3.4, 6.4, 4.8]
STANDING = {
    "chair": {"cylinder": [5.8, 4.0, 0.25], "height_m": 0.9},
    "sofa": {"box": BOX, "height_m": 0.8},
    "table": {"box": BOX, "height_m": 0.75},
    "bed": {"box": BOX, "height_m": 0.5},
    "tv": {"box": [5.6, 3.4, 6.0, 4.8], "height_m": 0.5},
    "fridge": {"box": [5.2, 3.7, 5.9, 4.4], "height_m": 1.8},
    "plant": {"cylinder": [5.8, 4.0, 0.25], "height_m": 1.2},
    "box": {"box": [5.2, 3.7, 5.9, 4.4], "height_m": 0.5},
    "none": {"box": BOX, "height_m": 0.9},
}
ROUND = {"cylinder": [5.8, 4.0, 0.45], "height_m": 0.8}
NAMED = ("bookshelf", "bench", "washbasin", "toilet", "coat_rack", "charging_station", "counter")
FRONTS = (0, 90, 180, -90)


def shown(frame: Frame, renderer: Renderer, thing: str, class_id: str) -> Any:
    """Return the mask of the pixels that show a thing as its class."""
    ids = [key for key, label in renderer.labels.items() if label == (thing, class_id)]
    assert len(ids) == 1, renderer.labels
    return frame.ids == ids[0]


def outline(item: dict[str, Any]) -> tuple[list[float], list[float]]:
    """Return the lower and upper corner of a piece's outline."""
    if "box" in item:
        return item["box"][:2], item["box"][2:]
    x, y, radius = item["cylinder"]
    return [x - radius, y - radius], [x + radius, y + radius]


@pytest.mark.parametrize(
    ("thing", "item"),
    [
        *((f"a_{name}", {**item, "class": name}) for name, item in STANDING.items()),
        ("armchair", ROUND),
        ("round_table", ROUND),
        *((name, STANDING["none"]) for name in NAMED),
        ("pillar", ROUND),
    ],
)
def test_furniture_is_named_and_within_its_outline(thing: str, item: dict[str, Any]) -> None:
    low, high = outline(item)
    words = {"armchair": "chair", "round_table": "table"}
    class_id = item.get("class", words.get(thing, "none"))
    for yaw in FRONTS:
        renderer = Renderer(hall(furniture={thing: {**item, "yaw": yaw}}), CAMERA)
        frame = renderer.render(MIDDLE)
        at = points(frame, CAMERA, MIDDLE)[frame.ids > 0]
        assert np.all(at[:, :2] >= np.array(low) - 0.005)
        assert np.all(at[:, :2] <= np.array(high) + 0.005)
        assert at[:, 2].min() > -0.005
        assert shown(frame, renderer, thing, class_id).sum() > 60


@pytest.mark.parametrize("class_id", sorted(set(SIZES_M) - {"door"}))
def test_an_object_is_named_where_it_lies(class_id: str) -> None:
    size = SIZES_M[class_id]
    lies = {"class": class_id, "at": [4.9, 4.0], "on": 0.8}
    renderer = Renderer(hall(objects={"it": lies}), CAMERA)
    frame = renderer.render(MIDDLE)
    mask = shown(frame, renderer, "it", class_id)
    assert mask.sum() > 10
    at = points(frame, CAMERA, MIDDLE)[mask] - (4.9, 4.0, 0.8)
    half = np.array([size[0] / 2, size[1] / 2]) + 0.012  # a cup's handle has a round end
    assert np.all(np.abs(at[:, :2]) <= half)
    assert at[:, 2].min() >= -0.002
    assert at[:, 2].max() <= size[2] + 0.01


def test_a_door_hangs_in_its_wall_and_is_seen() -> None:
    objects = {"front_door": {"class": "door", "at": [8.0, 4.0]}}
    renderer = Renderer(hall(objects=objects), CAMERA)
    frame = renderer.render(MIDDLE)
    mask = shown(frame, renderer, "front_door", "door")
    at = points(frame, CAMERA, MIDDLE)[mask]
    assert np.all(at[:, 0] > 7.85)
    assert np.ptp(at[:, 1]) == pytest.approx(0.9, abs=0.1)


def test_a_person_is_a_person_within_a_cylinder() -> None:
    renderer = Renderer(hall(people={"ann": {"at": [6.5, 4.0], "yaw": 180}}), CAMERA)
    frame = renderer.render(MIDDLE)
    mask = shown(frame, renderer, "ann", "person")
    at = points(frame, CAMERA, MIDDLE)[mask] - (6.5, 4.0, 0.0)
    assert np.hypot(at[:, 0], at[:, 1]).max() < PERSON_RADIUS_M + 0.01
    assert at[:, 2].max() == pytest.approx(PERSON_HEIGHT_M, abs=0.05)


def test_labels_name_every_id_and_only_our_classes(repository: Any) -> None:
    from sim.site import load_home

    home = load_home(repository / "sites" / "home")
    renderer = Renderer(home, CAMERA)
    assert {class_id for _, class_id in renderer.labels.values()} == {*CLASSES, "none"}
    named = {thing for thing, _ in renderer.labels.values()}
    assert named >= {*home.furniture, *home.objects, *home.people}
    for room in home.rooms.values():
        frame = renderer.render(Pose2(*room.pose[:2], np.radians(room.pose[2])))
        assert set(np.unique(frame.ids)) <= {0, *renderer.labels}


def test_the_screen_is_the_television_and_its_stand_is_not() -> None:
    renderer = Renderer(hall(furniture={"tv_stand": {**STANDING["tv"], "yaw": 180}}), CAMERA)
    frame = renderer.render(MIDDLE)
    at = points(frame, CAMERA, MIDDLE)
    assert at[shown(frame, renderer, "tv_stand", "tv")][:, 2].min() > 0.49
    assert at[shown(frame, renderer, "tv_stand", "none")][:, 2].max() < 0.51


TABLE = {"table": {"box": [5.0, 3.5, 6.0, 4.5], "height_m": 0.75}}
CUP = {"red_cup": {"class": "cup", "color": "red", "at": [5.2, 4.0], "on": "table"}}


def test_things_go_where_they_are_carried_and_come_back() -> None:
    renderer = Renderer(hall(furniture=TABLE, objects=CUP), CAMERA)

    def height(*things: SimThing) -> float | None:
        frame = renderer.render(MIDDLE, things)
        at = points(frame, CAMERA, MIDDLE)[shown(frame, renderer, "red_cup", "cup")]
        return float(at[:, 2].min()) if len(at) else None

    assert height() == pytest.approx(0.75, abs=0.02)
    assert height(SimThing(name="red_cup", pose=Pose2(5.4, 4.3, 1.0))) == pytest.approx(
        0.75, abs=0.02
    )
    assert height(SimThing(name="red_cup", pose=Pose2(6.5, 2.6, 0.0))) == pytest.approx(
        0.0, abs=0.04
    )
    assert height(SimThing(name="red_cup", pose=None)) is None
    assert height(SimThing(name="unheard_of", pose=MIDDLE)) == pytest.approx(0.75, abs=0.02)


def test_spare_obstacles_appear_when_placed() -> None:
    renderer = Renderer(hall(), CAMERA)
    assert not renderer.render(MIDDLE).ids.any()
    placed = (
        SimThing(name="person_0", pose=Pose2(6.5, 4.5, 0.0)),
        SimThing(name="crate_1", pose=Pose2(6.5, 3.4, 0.0)),
    )
    frame = renderer.render(MIDDLE, placed)
    seen = {renderer.labels[key] for key in np.unique(frame.ids) if key}
    assert seen == {("person_0", "person"), ("crate_1", "box")}


def test_colours_are_what_the_home_says_and_looks_vary_the_rest() -> None:
    home = hall(furniture=TABLE, objects=CUP)
    plain = Renderer(home, CAMERA).render(MIDDLE)
    again = Renderer(home, CAMERA).render(MIDDLE)
    assert np.array_equal(plain.color, again.color)
    pictures = [plain.color]
    for seed in range(1, 5):
        renderer = Renderer(home, CAMERA, Appearance.random(seed))
        frame = renderer.render(MIDDLE)
        assert np.array_equal(frame.ids, plain.ids), "a look moves nothing"
        cup = frame.color[shown(frame, renderer, "red_cup", "cup")].astype(float)
        red, green, blue = np.median(cup, axis=0)
        assert red > 1.8 * max(green, blue)
        assert not any(np.array_equal(frame.color, other) for other in pictures)
        pictures.append(frame.color)
