"""Run sim, bridge core, mission and route in one process on a simulated clock."""
