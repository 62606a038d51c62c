"""Read real sensors, each in its own process. Knows the wire; not the bridge, not the planner."""
