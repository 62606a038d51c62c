"""Choose what is looked for by what a camera can tell."""

from __future__ import annotations

from random import Random

from bench.measure.find_objects import chosen
from train.homes import drawn_home


def test_a_plant_is_asked_for_without_the_colour_that_nobody_paints() -> None:
    asked = [
        wanted
        for seed in range(40)
        if (wanted := chosen(drawn_home("unseen", seed), Random(seed))) is not None
    ]
    assert {color for label, color in asked if label == "plant"} == {None}
    assert None not in {color for label, color in asked if label != "plant"}
