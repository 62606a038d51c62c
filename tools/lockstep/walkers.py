"""Let people walk about in a lockstep world from goal to goal that a test names.

They walk as the simulator's own walkers do (sim.walkers): none ever steps into the robot. Who only
wants people about gives the world a domain; this is for stories that need somebody at one place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.walkers import PASSES_M, STOPS_M, TOUCHES_M, ScriptedWalker
from sim.walkers import WalkerManner as Manner
from sim.walking_floor import WalkingFloor
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lockstep.world import World

__all__ = ["PASSES_M", "STOPS_M", "TOUCHES_M", "Manner", "Walker"]
EVERY = 5
"""Ticks between two steps: 0.05 s."""


class Walker:
    """Walk from goal to goal, round and round, on the floor of the world's home."""

    def __init__(
        self,
        world: World,
        name: str,
        start: tuple[float, float],
        goals: Sequence[tuple[float, float]],
        speed_mps: float,
        manner: Manner,
        floor: WalkingFloor | None = None,
    ) -> None:
        """Stand at the start; the first goal is walked to from the first turn on.

        Args:
            world: where; ``turn`` is called after each of its ticks.
            name: a person or spare obstacle of its simulator.
            start: x, y in ``map`` [m].
            goals: likewise, in their order, again and again; none: stand.
            speed_mps: of walking.
            manner: how it meets the robot.
            floor: of the world's home; one serves several walkers.

        Raises:
            ConfigError: ``obstacle_unknown`` or ``walkers_without_floor``.
        """
        self._world, self.name, self.manner = world, name, manner
        floor = floor or WalkingFloor(world.sim.home)
        self._stands = not goals
        self._walker = ScriptedWalker(name, manner, floor, goals or [start], speed_mps, start)
        self.walks = False
        """Whether it went on in its last turn."""
        world.sim.place_thing(name, Pose2(*start, 0.0))

    @property
    def x_m(self) -> float:
        """Return where it is, x in ``map``."""
        return self._walker.x_m

    @property
    def y_m(self) -> float:
        """Return where it is, y in ``map``."""
        return self._walker.y_m

    @property
    def gap_m(self) -> float:
        """Return the distance between its rim and the robot's."""
        return self._walker.gap_m(self._world.truth, self._world.scene.robot.base.radius_m)

    def turn(self) -> None:
        """Take a step when one is due."""
        world = self._world
        if world.tick_count % EVERY != 0 or self._stands:
            return
        script = world.sim.script
        leaves = () if script is None else script.shut_leaves()
        radius_m = world.scene.robot.base.radius_m
        pose = self._walker.step(EVERY * 0.01, world.truth, radius_m, leaves)
        self.walks = pose is not None
        if pose is not None:
            world.sim.place_thing(self.name, pose)
