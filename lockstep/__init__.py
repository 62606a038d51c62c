"""Run sim, bridge core, mission and route in one process on a simulated clock.

``world = Together(site="two_room", seed=1)``, ``goal = world.say("go to the kitchen")``,
``world.run_until(lambda w: goal.ended, limit_s=60)``. See :class:`Together` for what can be
seen and what can go wrong.
"""

from lockstep.bus import Bus
from lockstep.disturbance import Disturbance
from lockstep.pace import TICK_S, Pace
from lockstep.said import Said
from lockstep.together import Together
from lockstep.world import TooLong, World

__all__ = ["TICK_S", "Bus", "Disturbance", "Pace", "Said", "Together", "TooLong", "World"]
