"""A copied world goes on as the first one would have, and neither touches the other."""

from __future__ import annotations

import pytest

from tests.tools.lockstep.conftest import Ready
from tools.lockstep import LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import Mode, SimFault

Wheels = list[tuple[float, float] | None]


def turned(world: LockstepWorld, seconds: float) -> Wheels:
    world.run(seconds)
    return [(c.left_radps, c.right_radps) if c is not None else None for c in world.commands]


def test_a_copy_goes_on_to_the_bit_whatever_breaks_in_another() -> None:
    world = LockstepWorld(seed=5)
    world.say("go to the living room")
    world.run_until(lambda w: w.status.mode is Mode.ACTIVE and w.twist.v_mps > 0.2, 20.0)
    same, broken = fork_world(world), fork_world(world)
    broken.sim.break_down(SimFault.WHEEL_STUCK)
    otherwise = turned(broken, 1.5)
    expected = turned(world, 1.5)
    assert turned(same, 1.5) == expected != otherwise
    assert same.truth == world.truth != broken.truth
    assert same.statuses[-1] == world.statuses[-1]


def test_a_world_is_not_copied_while_its_planner_waits(ready: Ready) -> None:
    world = ready(seed=5)
    world.say("go to the living room")
    with pytest.raises(ValueError, match="planner waits"):
        fork_world(world)
