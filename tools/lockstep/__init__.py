"""Run sim, bridge core, mission and route in one process on a simulated clock.

``world = LockstepWorld(site="two_room", seed=1)``, ``goal = world.say("go to the kitchen")``,
``world.run_until(lambda w: goal.ended, limit_s=60)``. See :class:`LockstepWorld` for what can be
seen and what can go wrong.
"""

from tools.lockstep.bus import LockstepBus
from tools.lockstep.disturbance import Disturbance
from tools.lockstep.goal_handle import GoalHandle
from tools.lockstep.latencies import TICK_S, Pace
from tools.lockstep.together import LockstepWorld
from tools.lockstep.world import TooLong, World

__all__ = [
    "TICK_S",
    "Disturbance",
    "GoalHandle",
    "LockstepBus",
    "LockstepWorld",
    "Pace",
    "TooLong",
    "World",
]
