"""Choose what is looked for by what a camera can tell."""

from __future__ import annotations

from random import Random

from bench.measure.find_objects import chosen, places
from sim.site.things import furniture_class
from train.homes import drawn_home


def test_a_plant_is_asked_for_without_the_colour_that_nobody_paints() -> None:
    asked = [
        wanted
        for seed in range(40)
        if (wanted := chosen(drawn_home("unseen", seed), Random(seed))) is not None
    ]
    assert {color for label, color in asked if label == "plant"} == {None}
    assert None not in {color for label, color in asked if label != "plant"}


def test_a_plant_of_any_colour_may_be_furniture() -> None:
    homes = (drawn_home("unseen", seed) for seed in range(40))
    home = next(
        one
        for one in homes
        if "plant" in {furniture_class(name, it) for name, it in one.furniture.items()}
    )
    small = [it.at for it in home.objects.values() if it.class_id == "plant"]
    assert len(places(home, "plant", None)) > len(small)
    assert places(home, "plant", "red") == [
        it.at for it in home.objects.values() if (it.class_id, it.color) == ("plant", "red")
    ]
