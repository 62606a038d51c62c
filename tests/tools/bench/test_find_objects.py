"""Choose what is looked for by what a camera can tell."""

from __future__ import annotations

from random import Random

from sim.site.objects import furniture_class
from tools.bench.measure.find_objects import choose_target, color_name, places
from tools.bench.object_visibility import in_sight
from tools.train.homes import drawn_home
from wire import CameraConfig


def test_a_plant_is_asked_for_without_the_colour_that_nobody_paints() -> None:
    asked = [
        wanted
        for seed in range(40)
        if (wanted := choose_target(drawn_home("unseen", seed), Random(seed), lambda _: True))
        is not None
    ]
    assert {color for label, color in asked if label == "plant"} == {None}
    assert None not in {color for label, color in asked if label != "plant"}


def test_nobody_asks_for_what_no_picture_shows() -> None:
    home = drawn_home("unseen", 46_007)
    (hidden,) = [
        n for n, it in home.objects.items() if (it.class_id, it.color) == ("cup", "yellow")
    ]
    others = [name for name in home.objects if name != hidden]
    assert not in_sight(home, [hidden], CameraConfig(), Random(1), poses=30)  # in the sofa's arm
    assert in_sight(home, others, CameraConfig(), Random(1), poses=30)
    asked = {
        choose_target(home, Random(seed), lambda names: hidden not in names) for seed in range(200)
    }
    assert len(asked) > 3
    assert not asked & {None, ("cup", "yellow")}
    assert choose_target(home, Random(1), lambda _: False) is None


def test_a_plant_of_any_colour_may_be_furniture() -> None:
    homes = (drawn_home("unseen", seed) for seed in range(40))
    home = next(
        one
        for one in homes
        if "plant" in {furniture_class(name, it) for name, it in one.furniture.items()}
    )
    small = [it.at for it in home.objects.values() if it.class_id == "plant"]
    assert len(places(home, "plant", None)) > len(small)


def test_what_declares_no_colour_counts_by_its_paint() -> None:
    assert [color_name("ball", None), color_name("ball", "blue"), color_name("box", None)] == [
        "red",
        "blue",
        "brown",
    ]
    home = drawn_home("unseen", 116_008)
    balls = [it for it in home.objects.values() if it.class_id == "ball"]
    assert None in {it.color for it in balls}
    assert places(home, "ball", "red") == [it.at for it in balls if it.color in (None, "red")]
