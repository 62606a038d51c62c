"""Walkers walk, and whatever their manner never step into the robot."""

from __future__ import annotations

import pytest

from tools.lockstep import LockstepWorld
from tools.lockstep.walkers import PASSES_M, TOUCHES_M, Manner, Walker
from wire import Pose2


@pytest.mark.parametrize("manner", list(Manner))
def test_a_walker_never_steps_into_a_standing_robot(manner: Manner) -> None:
    world = LockstepWorld(site="home", seed=3, start=Pose2(6.0, 4.75, 0.0), ready=False)
    walker = Walker(world, "person_0", (8.0, 4.75), [(3.0, 4.75), (8.0, 4.75)], 1.0, manner)
    contacts, least_m = world.contacts, walker.gap_m
    for _ in range(800):
        world.tick()
        walker.turn()
        least_m = min(least_m, walker.gap_m)
    assert world.contacts == contacts
    assert least_m >= min(PASSES_M, TOUCHES_M)
    assert walker.x_m < 7.9, "it walks"
