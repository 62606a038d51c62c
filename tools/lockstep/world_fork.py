"""Copy a whole world, so that many trials begin at one moment and only one has driven there.

Copies go on exactly as the first would have. What never changes is shared: the site, messages sent.
"""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from lockstep.world import World

W = TypeVar("W", bound="World")


def fork_world(world: W) -> W:
    """Return a world that goes on from here by itself.

    Both share the brain; ``think_with`` gives a copy its own.

    Raises:
        ValueError: the planner waits for a route, a plan, the disk or an answer, which would be
            told to the first world.
    """
    if world.waits:
        raise ValueError(f"a world is copied where its planner waits; {world.describe()}")
    scene = world.scene
    kept = (scene, scene.site, scene.router, scene.fence, world.sim.home)
    shared = (*kept, *world.commands, *world.statuses)
    return deepcopy(world, {id(one): one for one in shared})
