"""A world can be looked at through its robot's camera, things moved since included."""

from __future__ import annotations

import numpy as np

from tools.lockstep import World
from tools.lockstep.render import frame_of, names_of
from wire import Pose2


def seen(world: World) -> set[str]:
    ids = np.unique(frame_of(world.sim, world.scene.folder).ids).tolist()
    names = names_of(world.sim, world.scene.folder)
    return {names[key][0] for key in ids if key}


def test_what_stands_ahead_is_seen_until_it_is_taken_away() -> None:
    world = World(site="two_room", start=Pose2(1.5, 1.0, 0.0))
    assert seen(world) == {"counter", "red_cup"}
    world.sim.place_thing("red_cup", None)
    world.sim.place_thing("person_0", Pose2(2.1, 1.4, 0.0))
    assert "red_cup" not in seen(world)
    assert "person_0" in seen(world)
