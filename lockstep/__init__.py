"""Run sim, bridge core, mission and route in one process on a simulated clock.

Faster than real, and repeatable: same site, seed and calls give the same commands. The planner
rehearses plans in it, by a process of its own (``lockstep.rehearsal_process``); tests and benches
break it (``tools.lockstep``). Nothing is imported here: a process takes the parts that it needs.
"""
