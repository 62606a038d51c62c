"""State the margins that bridge and planner must agree on. Numbers only.

The arithmetic: the bridge's obstacle gate stops a robot whose disc, grown by OBSTACLE_MARGIN_M,
would touch a point of the scan; its fence gate stops the centre FENCE_MARGIN_M before a line of
the fence. A route through less than that asks for a way which the bridge then shuts, and a robot
that is told to go there stands and asks again. So the costmap keeps the same numbers.

A door stays passable with it: 0.90 m lose at most a cell of 0.05 m at each jamb, which leaves
0.80 m in whole cells, and the middle cell's centre is 0.375 m from an edge; a robot of 0.30 m
needs 0.35. At that middle the true jambs are 0.425 m away at the least, so that pose and path
may be 0.075 m off before the gate shuts.
"""

OBSTACLE_MARGIN_M = 0.05
FENCE_MARGIN_M = 0.15
