"""Try a whole robot in one process on a simulated clock, and make things go wrong in it.

``world = LockstepWorld(site="two_room", seed=1)``, ``goal = world.say("go to the kitchen")``,
``world.run_until(lambda w: goal.ended, limit_s=60)``. See :class:`LockstepWorld` for what can be
seen and what can go wrong.
"""

from lockstep.bus import LockstepBus
from lockstep.disturbance import Disturbance
from lockstep.goal_handle import GoalHandle
from lockstep.latencies import TICK_S, Pace
from lockstep.world import TooLong, World
from tools.lockstep.together import LockstepWorld

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
