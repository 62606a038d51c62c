"""Run sim, bridge core, mission and route in one process on a simulated clock.

``world = Together(site="two_room", seed=1)``, ``goal = world.say("go to the kitchen")``,
``world.run_until(lambda w: goal.ended, limit_s=60)``. See :class:`Together` for what can be
seen and what can go wrong.
"""

from tools.lockstep.bus import Bus
from tools.lockstep.disturbance import Disturbance
from tools.lockstep.goal_handle import GoalHandle
from tools.lockstep.latencies import TICK_S, Pace
from tools.lockstep.together import Together
from tools.lockstep.world import TooLong, World

__all__ = ["TICK_S", "Bus", "Disturbance", "GoalHandle", "Pace", "Together", "TooLong", "World"]
